#include "post/files/sinks/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace post {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : opened_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
      held_(opened_ < 0 || flock(opened_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) {}

FolderLock::~FolderLock() {
  if (opened_ >= 0) close(opened_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept : opened_(std::exchange(other.opened_, -1)), held_(other.held_) {}

}  // namespace post
