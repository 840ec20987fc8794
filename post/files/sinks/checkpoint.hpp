#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace post {

/// What a run keeps in its folder in order to go on after it was killed: `checkpoint`, and `checkpoint.before` with
/// the one before it. A file begins with what it is of, ends with a checksum of all before, and is in its place whole
/// and on the disk or not at all.
class Checkpoints {
public:
  /// `of`: one line that says which run of which program may go on from it.
  Checkpoints(std::filesystem::path folder, std::string of) : folder_(std::move(folder)), of_(std::move(of)) {}

  /// Throws std::filesystem::filesystem_error; the last one stays then.
  void write(const std::string& memory) const;

  static constexpr std::size_t kept = 2;
  /// The memory in one of them, 0: the newest, if it is whole and of this run. What is wrong with it goes into `fault`.
  std::optional<std::string> read(std::size_t which, std::string& fault) const;
  /// The memory in the newest checkpoint that is whole and of this run, if there is one. What is wrong with others goes
  /// into `refused`.
  std::optional<std::string> read(std::vector<std::string>& refused) const;

  bool any() const;
  void remove() const;

private:
  std::filesystem::path folder_;
  std::string of_;
};

}  // namespace post
