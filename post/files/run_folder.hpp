#pragma once
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace post {

/// 64-bit FNV-1a of a text, as hexadecimal: the same settings have the same digest on every machine.
inline std::string digest(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const unsigned char c : text) hash = (hash ^ c) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

/// A file descriptor that closes itself.
class Descriptor {
public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

  operator int() const { return number_; }

private:
  int number_;
};

/// A folder that stays the same one while it gets another name; it is found by its path where no file can be opened any
/// more.
class OpenedFolder {
public:
  explicit OpenedFolder(const std::filesystem::path& path)
      : path_(path), opened_(::open(path.empty() ? "." : path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {}

  bool has(const std::filesystem::path& name) const { return ::faccessat(opened_, at(name).c_str(), F_OK, 0) == 0; }
  void remove(const std::filesystem::path& name) const { ::unlinkat(opened_, at(name).c_str(), 0); }

private:
  std::filesystem::path at(const std::filesystem::path& name) const {
    return opened_ >= 0 ? name.filename() : std::filesystem::absolute(path_) / name.filename();
  }

  std::filesystem::path path_;
  Descriptor opened_;
};

/// Keeps a folder for one run, as long as it lives or its process does. File systems that know no locks let all in.
class FolderLock {
public:
  /// Locks a folder that exists.
  explicit FolderLock(const std::filesystem::path& folder);

  /// False: another run has it.
  bool held() const { return held_; }

private:
  Descriptor opened_;
  bool held_;
};

/// A name in a file of locks, kept by one process or shared by several until this ends or its process and all that it
/// has forked do; on several machines too where their file system carries locks (fcntl) between them. The file stays.
/// File systems that know no locks let all in.
class NamedLock {
public:
  enum class Use { alone, together };
  /// `file` is made where there is none. Tries again for as long as `patience`: children of a process that was killed
  /// take a moment to follow it. Throws std::system_error where the file cannot be opened.
  NamedLock(const std::filesystem::path& file, const std::string& name, Use use,
            std::chrono::milliseconds patience = std::chrono::milliseconds(0));

  /// False: another process has it.
  bool held() const { return held_; }
  /// False: the file system knows no locks.
  bool works() const { return works_; }

private:
  bool taken(const std::string& name, Use use);

  Descriptor opened_;
  bool held_ = false, works_ = true;
};

// Content of the folder that a run is to write to.

/// Names in a folder that holds something but no results of a run; empty where a run may write.
std::vector<std::string> strangers(const std::filesystem::path& folder);

/// True where the folder is of a run of this case, as text.
bool is_of(const std::filesystem::path& folder, const std::string& resolved);

/// Folders of runs that belong to it.
enum class Parts { go, stay };

/// Removes all that a run has written into a folder, by name; everything else stays. Returns the number of files.
std::size_t remove_earlier(const std::filesystem::path& folder, Parts parts = Parts::go);

/// A folder of its own among the temporary files of the system; it goes with all that it holds.
class ScratchFolder {
public:
  /// `name`: what its name begins with. Throws std::runtime_error where none can be made.
  explicit ScratchFolder(const std::string& name);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Size of all files in it [bytes].
  double bytes() const;

private:
  std::filesystem::path path_;
};

}  // namespace post
