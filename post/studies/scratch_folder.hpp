#pragma once
#include <filesystem>
#include <string>

namespace post {

/// A folder of its own among the temporary files of the system; it goes with all that it holds.
class ScratchFolder {
public:
  /// `name`: what its name begins with. Throws std::runtime_error where none can be made.
  explicit ScratchFolder(const std::string& name);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Of all files in it.
  double bytes() const;

private:
  std::filesystem::path path_;
};

}  // namespace post
