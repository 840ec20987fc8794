#pragma once
#include <memory>

#include "plate/formulation/mesh.hpp"
#include "plate/model/state.hpp"
#include "post/files/frame.hpp"

namespace plate {
class Formulation;
}

namespace cases {

/// Part of a distributed plate that one rank draws and stores: the points that it owns, and the cells about them, with
/// the values of the ghosts that these cells have.
class OwnedMesh {
public:
  /// Constructs from `whole`: all points that the rank knows, and their cells, where these are drawn. `plate` must
  /// outlive this.
  OwnedMesh(const plate::Formulation& plate, const plate::Mesh& whole);

  /// Mesh whose owned points come first, in the order that they have in the plate.
  const plate::Mesh& mesh() const { return mesh_; }
  /// Reduces a frame with all points that the rank knows to those of mesh(). Collective.
  post::Frame frame(post::Frame seen) const;
  /// Columns of owned points.
  plate::State own(const plate::State& of_plate) const { return own(of_plate, own_); }

private:
  plate::State own(const plate::State& of_plate, std::size_t count) const;

  const plate::Formulation& plate_;
  plate::Mesh mesh_;
  std::size_t own_ = 0;
  std::vector<std::uint32_t> points_;  // of the plate, in the order of the mesh
};

/// Mesh of the owned points; nothing where one process holds the whole plate.
std::unique_ptr<OwnedMesh> owned_mesh(const plate::Formulation& plate, const plate::Mesh& whole);

}  // namespace cases
