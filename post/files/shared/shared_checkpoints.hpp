#pragma once
#include "plate/model/ranks/ranks.hpp"
#include "post/files/shared/cell_values.hpp"
#include "post/files/sinks/checkpoint.hpp"

namespace post {

/// What processes that share a plate keep in its folder, in order to go on as any number of them: the first of them
/// what all know (Checkpoints), each the numbers of its points, checkpoint.N.RANK, N from 0 to 2 in turn, so that the
/// last two stay whole while the next is written. The checksums of these are in the first's. All call everything at
/// once; the folder is one that all of them see.
class SharedCheckpoints {
public:
  /// `all` must outlive this.
  SharedCheckpoints(const plate::Ranks& all, std::filesystem::path folder, std::string of);

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
  /// What the checkpoint says of its parts, and the memory behind it.
  struct Main {
    std::size_t turn = 0;
    std::vector<std::string> checksums;
    std::string memory;
  };
  static Main main_of(const std::string& text);
  std::filesystem::path part(std::size_t turn, std::size_t rank) const;
  std::string fault_of_parts(const Main& main) const;
  std::vector<std::string> told(const std::string& own) const;

  const plate::Ranks* all_;
  std::filesystem::path folder_;
  Checkpoints first_;
  std::size_t turn_ = 0;  // of the next
};

}  // namespace post
