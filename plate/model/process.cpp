#include "plate/model/process.hpp"

#include <malloc.h>
#include <omp.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <string>

namespace plate {
namespace {

/// The OpenMP library reads its setting before main.
[[maybe_unused]] bool set_waiting() {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return false;
  return setenv("OMP_WAIT_POLICY", "passive", 1) == 0;
}

#ifdef PDPLATE_OWN_OPENMP
/// Sets waiting threads to sleep, before the constructors of the OpenMP library, which is part of the program.
[[gnu::constructor(101)]] void wait_without_spinning() {
  set_waiting();
}
#endif

/// Reports an uncaught exception, as of a thread that has no memory to begin with, and ends the process.
[[noreturn]] void end_in_words() {
  constexpr int failed_machine = 4;  // as of main
  const auto thrown = std::current_exception();
  const char* const unknown = "for no reason that is known";
  const char* reason = unknown;
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    reason = "the memory does not suffice";
  } catch (const std::exception& error) {
    reason = error.what();
  } catch (...) {
    reason = unknown;
  }
  dprintf(STDERR_FILENO, "failed: %s\n", reason);
  _exit(failed_machine);
}

}  // namespace

void set_up_process([[maybe_unused]] char** argv) {
#if !defined PDPLATE_OWN_OPENMP && !defined PDPLATE_PACKAGE  // there the launcher does it (cases/package/launcher.cpp)
  if (set_waiting()) execv("/proc/self/exe", argv);          // starts again; where it fails threads spin
#endif
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(end_in_words);
  constexpr rlim_t least = 1000 << 20;  // bytes; with less, OpenBLAS may wait for ever for its buffers
  if (rlimit space{}; getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur < least) {
    dprintf(STDERR_FILENO, "failed: the address space is limited to less than 1000 MB (ulimit -v)\n");
    _exit(4);
  }
  mallopt(M_MMAP_THRESHOLD, 1 << 28);
  mallopt(M_TRIM_THRESHOLD, 1 << 28);
}

int sensible_threads(int wanted) {
  constexpr rlim_t bytes = 80 << 20;  // of a thread: a stack of 8 MB, and a heap that reserves 64 MB
  rlim_t most = rlim_t(8 * omp_get_num_procs());
  if (rlimit space{}; getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
    most = std::min(most, space.rlim_cur / 2 / bytes);
  return int(std::clamp<rlim_t>(rlim_t(std::max(wanted, 1)), 1, std::max<rlim_t>(most, 1)));
}

std::string build() {
#if defined __AVX512F__
  constexpr auto kernels = " AVX-512";  // of a package that holds several
#elif defined __AVX2__
  constexpr auto kernels = " AVX2";
#else
  constexpr auto kernels = "";
#endif
  return std::to_string(std::filesystem::last_write_time("/proc/self/exe").time_since_epoch().count()) + kernels;
}

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// A number of a file of the system; nothing where there is none, as in "max".
double number_in(const char* path, double otherwise) {
  double value = 0;
  return std::ifstream(path) >> value ? value : otherwise;
}

}  // namespace

double free_memory() {
  const double limit = number_in("/sys/fs/cgroup/memory.max", unlimited);
  const double left = limit - number_in("/sys/fs/cgroup/memory.current", 0);
  std::ifstream meminfo("/proc/meminfo");
  for (std::string name, unit; meminfo >> name;) {
    double kibibytes = 0;
    if (name == "MemAvailable:" && meminfo >> kibibytes) return std::min(1024 * kibibytes, std::max(left, 0.0));
    std::getline(meminfo, unit);
  }
  return left < unlimited ? std::max(left, 0.0) : 0;
}

}  // namespace plate
