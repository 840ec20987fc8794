#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

namespace post {

/// A folder that stays the same one while it gets another name; it is found by its path where no file can be opened any
/// more.
class HeldFolder {
public:
  explicit HeldFolder(const std::filesystem::path& path)
      : path_(path), opened_(::open(path.empty() ? "." : path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {}
  ~HeldFolder() {
    if (opened_ >= 0) ::close(opened_);
  }
  HeldFolder(const HeldFolder&) = delete;
  HeldFolder& operator=(const HeldFolder&) = delete;

  bool has(const std::filesystem::path& name) const { return ::faccessat(opened_, at(name).c_str(), F_OK, 0) == 0; }
  void remove(const std::filesystem::path& name) const { ::unlinkat(opened_, at(name).c_str(), 0); }

private:
  std::filesystem::path at(const std::filesystem::path& name) const {
    return opened_ >= 0 ? name.filename() : std::filesystem::absolute(path_) / name.filename();
  }

  std::filesystem::path path_;
  int opened_;
};

}  // namespace post
