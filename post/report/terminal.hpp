#pragma once
#include <chrono>
#include <string>

namespace post {

/// Writes to standard error at once. What cannot be written, to a full disk or a closed terminal, is lost: no run ends
/// for it.
void say(const std::string& text) noexcept;

/// Tells how far a run is: a bar on a terminal, a line every ten seconds elsewhere, nothing if quiet.
class Progress {
public:
  Progress(bool quiet, std::string what);
  ~Progress();

  /// `share` of the work in [0, 1]; `text`: residual or time.
  void update(double share, const std::string& text);
  void done();

private:
  bool quiet_, terminal_;
  std::string what_;
  std::chrono::steady_clock::time_point start_, last_;
  bool open_ = false;
};

}  // namespace post
