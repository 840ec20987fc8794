#pragma once
#include <chrono>
#include <filesystem>
#include <string>

namespace post {

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
  ~NamedLock();
  NamedLock(NamedLock&& other) noexcept;
  NamedLock& operator=(NamedLock&&) = delete;

  /// False: another process has it.
  bool held() const { return held_; }
  /// False: the file system knows no locks.
  bool works() const { return works_; }

private:
  bool taken(const std::string& name, Use use);

  int opened_;
  bool held_ = false, works_ = true;
};

}  // namespace post
