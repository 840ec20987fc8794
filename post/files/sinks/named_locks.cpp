#include "post/files/sinks/named_locks.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <thread>
#include <utility>

#include "post/files/digest.hpp"

namespace post {
namespace {

constexpr auto pause = std::chrono::milliseconds(20);

/// The byte that stands for a name: of 10,000 names two fall together once in 10^10 files.
off_t byte_of(const std::string& name) {
  constexpr int spare = 2;  // offsets are not negative, and their ends neither
  return off_t(std::stoull(digest(name), nullptr, 16) >> spare);
}

}  // namespace

NamedLock::NamedLock(const std::filesystem::path& file, const std::string& name, Use use,
                     std::chrono::milliseconds patience)
    : opened_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (opened_ < 0) throw std::system_error(errno, std::generic_category(), "cannot open " + file.string());
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!(held_ = taken(name, use)) && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(pause);
}

bool NamedLock::taken(const std::string& name, Use use) {
  struct flock wanted = {};
  wanted.l_type = use == Use::alone ? F_WRLCK : F_RDLCK;
  wanted.l_whence = SEEK_SET;
  wanted.l_start = byte_of(name);
  wanted.l_len = 1;
  if (fcntl(opened_, F_OFD_SETLK, &wanted) == 0) return true;
  works_ = errno == EAGAIN || errno == EACCES || errno == EINTR;
  return !works_;
}

NamedLock::~NamedLock() {
  if (opened_ >= 0) close(opened_);
}

NamedLock::NamedLock(NamedLock&& other) noexcept
    : opened_(std::exchange(other.opened_, -1)), held_(other.held_), works_(other.works_) {}

}  // namespace post
