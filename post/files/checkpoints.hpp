#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/lattice/cloud.hpp"

namespace plate {
class Communicator;
}

namespace post {

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

/// A checkpoint that one of the ranks could not write.
class CheckpointNotWritten : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Checkpoints of a run in its folder, from which it goes on after it was killed, by any number of ranks. The first
/// rank writes what all ranks know to `checkpoint`; `checkpoint.before` is the previous one. Such a file begins with
/// the line that identifies its run and ends with a checksum of all before. Each rank writes the values of its points
/// to checkpoint.N.RANK, N from 0 to 2 in turn, so that the last two checkpoints stay complete while the next is
/// written. The checksums of these files are in that of the first rank. Every file is in its place complete and on the
/// disk, or not at all. Collective: every rank must call read() and write(). All ranks must see the folder.
class Checkpoints {
public:
  /// `all` must outlive this. `of`: one line that says which run of which program may go on from it.
  Checkpoints(const plate::Communicator& all, std::filesystem::path folder, std::string of)
      : all_(&all), folder_(std::move(folder)), of_(std::move(of)) {}
  /// Collective: true where `here` is true on any rank.
  bool agreed(bool here) const;

  /// Throws CheckpointNotWritten in all processes where one cannot write; the last one stays then.
  void write(const std::string& memory, const CellValues& own);

  struct Found {
    std::string memory;
    std::vector<std::filesystem::path> parts;  // with the points of all
  };
  /// The newest that is whole and of this run. What is wrong with others goes into `refused`, in all processes.
  std::optional<Found> read(std::vector<std::string>& refused);

  /// True where a run has not ended.
  bool any() const;
  /// True where keep_last() has kept one.
  bool kept() const;
  /// Keeps the last one as `checkpoint.end`, and no other: the run has ended, and a longer one may go on from it.
  void keep_last() const;
  void remove() const;

private:
  void remove_but(const std::string& kept) const;

  const plate::Communicator* all_;
  std::filesystem::path folder_;
  std::string of_;
  std::size_t turn_ = 0;  // of the next
};

}  // namespace post
