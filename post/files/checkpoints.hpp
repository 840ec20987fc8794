#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/lattice/cloud.hpp"
#include "plate/model/communicator.hpp"

namespace post {

/// Checkpoints of a run in its folder, from which it goes on after it was killed: `checkpoint`, and `checkpoint.before`
/// with the previous one. A file begins with the line that identifies its run and ends with a checksum of all before.
/// It is in its place complete and on the disk, or not at all.
class Checkpoints {
public:
  /// `of`: one line that says which run of which program may go on from it.
  Checkpoints(std::filesystem::path folder, std::string of) : folder_(std::move(folder)), of_(std::move(of)) {}

  /// Throws std::filesystem::filesystem_error; the last one stays then.
  void write(const std::string& memory) const;

  static constexpr std::size_t kept = 2;
  /// The memory in one of them, 0: the newest, if it is whole and of this run. What is wrong with it goes into
  /// `problem`.
  std::optional<std::string> read(std::size_t which, std::string& problem) const;
  /// The memory in the newest checkpoint that is whole and of this run, if there is one. What is wrong with others goes
  /// into `refused`.
  std::optional<std::string> read(std::vector<std::string>& refused) const;

  bool any() const;
  void remove() const;

private:
  std::filesystem::path folder_;
  std::string of_;
};

/// Numbers of the points of one process, by the cells of the lattice in which they are.
struct CellValues {
  std::size_t width = 0;              // numbers of a point
  std::vector<geometry::Cell> cells;  // [points]
  std::vector<double> values;         // [points x width], point by point
};

/// Writes a file that is whole and on the disk, or not there, and returns its checksum. Throws
/// std::filesystem::filesystem_error.
std::string write_cells(const std::filesystem::path& path, const CellValues& values);

/// The checksum of a file; empty where it cannot be read.
std::string checksum_of(const std::filesystem::path& path);

/// Visits the points of a file one by one without holding them, where it has any of `wanted`. Returns the numbers of
/// each point. Throws std::runtime_error where it is none of these files.
std::size_t read_cells(const std::filesystem::path& path, const geometry::CellBox& wanted,
                       const std::function<void(const geometry::Cell& cell, std::span<const double> values)>& visit);

/// Checkpoints of a plate that several ranks share, in its folder; any number of ranks can go on from them. The first
/// rank writes what all ranks know (Checkpoints). Each rank writes the values of its points to checkpoint.N.RANK, N
/// from 0 to 2 in turn, so that the last two stay complete while the next is written. The checksums of these files are
/// in that of the first rank. Collective: every rank must call each member function. All ranks must see the folder.
class DistributedCheckpoints {
public:
  /// `all` must outlive this.
  DistributedCheckpoints(const plate::Communicator& all, std::filesystem::path folder, std::string of);
  const plate::Communicator& communicator() const { return *all_; }

  /// Throws std::filesystem::filesystem_error in all processes where one cannot write; the last one stays then.
  void write(const std::string& memory, const CellValues& own);

  struct Found {
    std::string memory;
    std::vector<std::filesystem::path> parts;  // with the points of all
  };
  /// The newest that is whole and of this run. What is wrong with others goes into `refused`, in all processes.
  std::optional<Found> read(std::vector<std::string>& refused);

  void remove() const;

private:
  /// Content of the main checkpoint: turn and checksums of its parts, and the memory after them.
  struct Main {
    std::size_t turn = 0;
    std::vector<std::string> checksums;
    std::string memory;
  };
  static Main main_of(const std::string& text);
  std::filesystem::path part(std::size_t turn, std::size_t rank) const;
  std::string error_in_parts(const Main& main) const;
  std::vector<std::string> told(const std::string& own) const;

  const plate::Communicator* all_;
  std::filesystem::path folder_;
  Checkpoints first_;
  std::size_t turn_ = 0;  // of the next
};

}  // namespace post
