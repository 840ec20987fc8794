// What a network would cost on which copies of other processes' points come LATE microseconds (default 0) after they
// were sent: at its end every process says for how long it would have waited for them, by its own processor time, of
// which other programs take nothing, and how often. One thread each:
//
//   mpicxx -std=c++20 -O2 -shared -fPIC tests/distributed/late.cpp -o late.so
//
//   LATE=1000 OMP_NUM_THREADS=1 mpirun -x LATE -x LD_PRELOAD=$PWD/late.so -n 2 pdplate_distributed run CASE.toml
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>

namespace {

double now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

std::optional<double> due;  // when what has begun would be there [s]
double waited = 0;          // [s]
long exchanges = 0;

void begin() {
  const char* late = std::getenv("LATE");
  due = now() + 1e-6 * (late ? std::atof(late) : 0);
  ++exchanges;
}

void end() {
  if (due) waited += std::max(0.0, *due - now());
  due.reset();
}

}  // namespace

int MPI_Neighbor_alltoallv(const void* sent, const int counts[], const int begins[], MPI_Datatype type, void* received,
                           const int counts_in[], const int begins_in[], MPI_Datatype type_in, MPI_Comm comm) {
  begin();
  end();
  return PMPI_Neighbor_alltoallv(sent, counts, begins, type, received, counts_in, begins_in, type_in, comm);
}

int MPI_Ineighbor_alltoallv(const void* sent, const int counts[], const int begins[], MPI_Datatype type, void* received,
                            const int counts_in[], const int begins_in[], MPI_Datatype type_in, MPI_Comm comm,
                            MPI_Request* request) {
  begin();
  return PMPI_Ineighbor_alltoallv(sent, counts, begins, type, received, counts_in, begins_in, type_in, comm, request);
}

int MPI_Wait(MPI_Request* request, MPI_Status* status) {
  end();
  return PMPI_Wait(request, status);
}

int MPI_Finalize() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  char line[128];
  const int length = std::snprintf(line, sizeof line, "process %d would have waited %.4f s in %ld exchanges\n", rank,
                                   waited, exchanges);
  if (write(STDERR_FILENO, line, std::size_t(length)) < 0) return MPI_ERR_OTHER;
  return PMPI_Finalize();
}
