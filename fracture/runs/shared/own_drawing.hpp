#pragma once
#include "post/files/frame.hpp"

namespace plate {
class Formulation;
}

namespace fracture {

/// What one of the processes that share a plate draws of it: the cells about its own points, with the values of the
/// points of others that these cells have.
class OwnDrawing {
public:
  /// `plate` must outlive this.
  explicit OwnDrawing(const plate::Formulation& plate);
  /// `whole`: the cells of all points that the process sees.
  OwnDrawing(const plate::Formulation& plate, const plate::Mesh& whole);

  const plate::Mesh& mesh() const { return mesh_; }
  /// Of a frame with all points that the process sees. All processes call it at once.
  post::Frame frame(post::Frame seen) const;

private:
  const plate::Formulation& plate_;
  plate::Mesh mesh_;
  std::vector<std::uint32_t> points_;  // of the plate, in the order of the mesh
};

/// Nothing where one process holds the whole plate.
std::optional<OwnDrawing> own_drawing(const plate::Formulation& plate, const plate::Mesh& whole);

}  // namespace fracture
