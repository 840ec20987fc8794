#include "plate/solve/interruption.hpp"

#include <unistd.h>

#include <string>

namespace plate {
namespace {

constexpr std::array signals{SIGINT, SIGTERM};
constexpr char notice[] = "\nstopping at the next step; once more to stop at once\n";

volatile std::sig_atomic_t asked = 0;
int nesting = 0;

void ask(int signal) {
  if (asked) {
    std::signal(signal, SIG_DFL);
    raise(signal);
    return;
  }
  asked = 1;
  [[maybe_unused]] const auto written = write(STDERR_FILENO, notice, sizeof notice - 1);
}

}  // namespace

StopOnSignals::StopOnSignals() {
  if (nesting++ == 0) asked = 0;
  struct sigaction action {};
  action.sa_handler = ask;  // without SA_RESTART: who waits for another process hears of it
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &before_[i]);
}

StopOnSignals::~StopOnSignals() {
  --nesting;
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
}

bool stop_is_asked() noexcept {
  return asked != 0;
}

void stop_if_asked(const char* where) {
  if (asked) throw Interrupted(std::string("asked to stop in ") + where);
}

}  // namespace plate
