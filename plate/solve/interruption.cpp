#include "plate/solve/interruption.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <string>

#include "plate/formulation/constraints.hpp"
#include "plate/model/reduction.hpp"

namespace plate {
namespace {

constexpr std::array signals{SIGINT, SIGTERM};
constexpr char notice[] = "\nstopping at the next step; once more to stop at once\n";

volatile std::sig_atomic_t asked = 0;  // the signal

std::mutex mutex;
int living = 0;
std::array<struct sigaction, signals.size()> before;

/// Handles a signal: the first one asks for the end, the same signal again ends the process. A launcher may pass on a
/// different signal as well.
void ask(int signal) {
  if (asked == signal) {
    std::signal(signal, SIG_DFL);
    raise(signal);
    return;
  }
  const int error = errno;
  if (asked == 0) [[maybe_unused]]
    const auto written = write(STDERR_FILENO, notice, sizeof notice - 1);
  asked = signal;
  errno = error;
}

}  // namespace

StopOnSignals::StopOnSignals() {
  const std::lock_guard lock(mutex);
  if (living++ > 0) return;
  struct sigaction action {};
  action.sa_handler = ask;  // without SA_RESTART: who waits for another process hears of it
  for (std::size_t i = 0; i < signals.size(); ++i) {
    sigaction(signals[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) sigaction(signals[i], &action, nullptr);  // ignored by whoever started this
  }
}

StopOnSignals::~StopOnSignals() {
  const std::lock_guard lock(mutex);
  if (--living > 0) return;
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before[i], nullptr);
  asked = 0;
}

bool stop_is_asked() noexcept {
  return asked != 0;
}

void stop_if_asked(const char* where, const Constraints& constraints) {
  if (largest_of(constraints, stop_is_asked()) > 0) throw Interrupted(std::string("asked to stop in ") + where);
}

void stop_if_asked(const char* where) {
  stop_if_asked(where, Constraints());
}

}  // namespace plate
