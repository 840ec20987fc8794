#pragma once
#include <filesystem>

namespace post {

/// Keeps a folder for one run, as long as it lives or its process does. File systems that know no locks let all in.
class FolderLock {
public:
  /// Of a folder that exists.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;

  /// False: another run has it.
  bool held() const { return held_; }

private:
  int opened_;
  bool held_;
};

}  // namespace post
