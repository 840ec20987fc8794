#pragma once
#include <stdexcept>

namespace plate {

class Constraints;

/// The run was asked to end before it was done. The message says where it was.
class Interrupted : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Lets Ctrl-C and SIGTERM ask for the end at the next step of the solution while an object lives; the same signal
/// again ends the process at once.
class StopOnSignals {
public:
  StopOnSignals();
  ~StopOnSignals();
  StopOnSignals(const StopOnSignals&) = delete;
};

/// True where a signal has asked for the end.
bool stop_is_asked() noexcept;

/// Throws Interrupted where a signal has asked any rank for the end, of those that share a plate with these
/// constraints; collective. `where` goes into the message.
void stop_if_asked(const char* where, const Constraints& constraints);
void stop_if_asked(const char* where);  // this process alone

}  // namespace plate
