#pragma once
#include "post/files/frame.hpp"

namespace plate {
class Formulation;
}

namespace fracture {

/// What one of the processes that share a plate draws and stores of it: its own points, and the cells about them, with
/// the values of the points of others that these cells have.
class OwnDrawing {
public:
  /// `plate` must outlive this.
  explicit OwnDrawing(const plate::Formulation& plate);
  /// `whole`: all points that the process sees, and their cells, where these are drawn.
  OwnDrawing(const plate::Formulation& plate, const plate::Mesh& whole);

  /// The own points come first, in the order that they have in the plate.
  const plate::Mesh& mesh() const { return mesh_; }
  /// Of a frame with all points that the process sees. All processes call it at once.
  post::Frame frame(post::Frame seen) const;
  /// The columns of own points.
  plate::State own(const plate::State& of_plate) const { return own(of_plate, own_); }

private:
  plate::State own(const plate::State& of_plate, std::size_t count) const;

  const plate::Formulation& plate_;
  plate::Mesh mesh_;
  std::size_t own_ = 0;
  std::vector<std::uint32_t> points_;  // of the plate, in the order of the mesh
};

/// Nothing where one process holds the whole plate.
std::optional<OwnDrawing> own_drawing(const plate::Formulation& plate, const plate::Mesh& whole);

}  // namespace fracture
