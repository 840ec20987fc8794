#include "post/report/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cstdio>

namespace post {

void say(const std::string& text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
  std::clearerr(stderr);
}

namespace {

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

}  // namespace

Progress::Progress(bool quiet, std::string what)
    : quiet_(quiet),
      terminal_(isatty(fileno(stderr))),
      what_(std::move(what)),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

Progress::~Progress() {
  done();
}

void Progress::update(double share, const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (quiet_ || seconds(now - last_) < (terminal_ ? 0.2 : 10)) return;
  last_ = now;
  const double spent = seconds(now - start_);
  const std::string left = share > 0.001 ? fmt::format("{:.0f} s left", spent / share - spent) : "";
  if (!terminal_) {
    say(fmt::format("{}: {:3.0f} %, {}, {:.0f} s, {}\n", what_, 100 * share, text, spent, left));
    return;
  }
  const int width = 30, full = std::clamp(static_cast<int>(share * width), 0, width);
  say(fmt::format("\r{} [{}{}] {:3.0f} %  {}  {:.0f} s, {}\x1b[K", what_, std::string(std::size_t(full), '#'),
                  std::string(std::size_t(width - full), '.'), 100 * share, text, spent, left));
  open_ = true;
}

void Progress::done() {
  if (open_) say("\r\x1b[K");
  open_ = false;
}

}  // namespace post
