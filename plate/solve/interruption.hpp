#pragma once
#include <array>
#include <csignal>
#include <stdexcept>

namespace plate {

/// The run was asked to end before it was done. The message says where it was.
class Interrupted : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// While it lives, Ctrl-C and SIGTERM ask for the end at the next step of whatever is solved; a second one of them ends
/// the process at once.
class StopOnSignals {
public:
  StopOnSignals();
  ~StopOnSignals();
  StopOnSignals(const StopOnSignals&) = delete;

private:
  std::array<struct sigaction, 2> before_;
};

/// Has a signal asked for the end?
bool stop_is_asked() noexcept;

/// Throws Interrupted where a signal has asked for the end. `where` goes into the message.
void stop_if_asked(const char* where);

}  // namespace plate
