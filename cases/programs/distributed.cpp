#include <mpi.h>
#include <unistd.h>

#include <cstdio>

#include "cases/programs/command_line.hpp"
#include "plate/distributed/mpi_communicator.hpp"
#include "plate/distributed/petsc_inverse.hpp"
#include "plate/model/halo_exchange.hpp"
#include "plate/model/process.hpp"

namespace {

/// Keeps what a process other than the first says: it speaks only where it fails and the first does not.
class Listener {
public:
  explicit Listener(bool listens) {
    if (!listens) return;
    if (!std::freopen("/dev/null", "w", stdout)) std::fclose(stdout);
    stderr = open_memstream(&said_, &length_);
  }
  void speak() const {
    if (!said_) return;
    std::fflush(stderr);
    sleep(1);  // what all have found the first has said by now, and ended them
    if (write(STDERR_FILENO, said_, length_) < 0) return;
  }

private:
  char* said_ = nullptr;
  std::size_t length_ = 0;
};

}  // namespace

/// The program on the processes of MPI: mpirun -n 4 pdplate_distributed run CASE.toml. What ends one of them with an
/// exit code ends all with it.
int main(int argc, char** argv) {
  plate::set_up_process(argv);  // may start the process again, which MPI must not see
  int level = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  if (level < MPI_THREAD_FUNNELED) {
    std::fputs("failed: this MPI allows no threads\n", stderr);
    MPI_Abort(MPI_COMM_WORLD, 4);
  }
  {
    const plate::Petsc petsc;
    const plate::MpiCommunicator processes(MPI_COMM_WORLD);
    const plate::CountedCommunicator all(processes);
    const Listener listener(all.rank() > 0);
    const int code = cases::command_line(argc, argv, all);
    if (code != 0) {
      listener.speak();
      std::fflush(nullptr);
      MPI_Abort(MPI_COMM_WORLD, code);
    }
  }
  MPI_Finalize();
  return 0;
}
