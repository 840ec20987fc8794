#pragma once
#include <filesystem>

#include "post/files/frame.hpp"

namespace plate {
class Ranks;
}

namespace post {

/// Frames of a plate that processes share: each writes its piece, fields_NNNN_RANK.vtu as VtkSeries does, and when all
/// are there the first writes fields_NNNN.pvtu, which names the pieces, fields.pvd, and the cracks where they change.
class VtkPieces {
public:
  /// `mesh`: what this process draws. `all` must outlive this.
  VtkPieces(const plate::Ranks& all, std::filesystem::path folder, Mesh mesh);
  /// Of the frames from now on.
  void remesh(Mesh mesh) { mesh_ = std::move(mesh); }
  /// All processes call it at once.
  void write(const Frame& frame);
  /// Goes on after frames that a run has written which was ended, by whatever number of processes; what there is of
  /// later ones goes. All processes call it at once.
  void go_on(std::vector<double> times);

private:
  const plate::Ranks& all_;
  std::filesystem::path folder_;
  Mesh mesh_;
  std::vector<double> times_;
};

}  // namespace post
