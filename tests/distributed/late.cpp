// Copies of other processes' points that come as late as over a slow network: LATE microseconds (default 0) after they
// were sent. At its end every process says how long it waited for them, and how often.
// mpicxx -O2 -shared -fPIC tests/distributed/late.cpp -o late.so; LATE=1000 mpirun -x LATE -x LD_PRELOAD=$PWD/late.so
// ...
#include <mpi.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

namespace {

using Clock = std::chrono::steady_clock;

std::optional<Clock::time_point> due;  // when what has begun is there
std::chrono::duration<double> waited{0};
long exchanges = 0;

void begin() {
  const char* late = std::getenv("LATE");
  due = Clock::now() + std::chrono::microseconds(late ? std::atol(late) : 0);
  ++exchanges;
}

/// Of a wait since `entered`.
void end(Clock::time_point entered) {
  if (!due) return;
  std::this_thread::sleep_until(*due);
  due.reset();
  waited += Clock::now() - entered;
}

}  // namespace

int MPI_Neighbor_alltoallv(const void* sent, const int counts[], const int begins[], MPI_Datatype type, void* received,
                           const int counts_in[], const int begins_in[], MPI_Datatype type_in, MPI_Comm comm) {
  const auto entered = Clock::now();
  begin();
  const int result = PMPI_Neighbor_alltoallv(sent, counts, begins, type, received, counts_in, begins_in, type_in, comm);
  end(entered);
  return result;
}

int MPI_Ineighbor_alltoallv(const void* sent, const int counts[], const int begins[], MPI_Datatype type, void* received,
                            const int counts_in[], const int begins_in[], MPI_Datatype type_in, MPI_Comm comm,
                            MPI_Request* request) {
  begin();
  return PMPI_Ineighbor_alltoallv(sent, counts, begins, type, received, counts_in, begins_in, type_in, comm, request);
}

int MPI_Wait(MPI_Request* request, MPI_Status* status) {
  const auto entered = Clock::now();
  const int result = PMPI_Wait(request, status);
  end(entered);
  return result;
}

int MPI_Finalize() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  char line[128];
  const int length =
      std::snprintf(line, sizeof line, "process %d waited %.4f s in %ld exchanges\n", rank, waited.count(), exchanges);
  if (write(STDERR_FILENO, line, std::size_t(length)) < 0) return MPI_ERR_OTHER;
  return PMPI_Finalize();
}
