#include "cases/runs/owned_mesh.hpp"

#include <optional>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"

namespace cases {
namespace {

using geometry::Point;

constexpr auto none = std::uint32_t(-1);

/// A part of a mesh, with numbers of its own.
class MeshPart {
public:
  explicit MeshPart(const plate::Mesh& whole)
      : whole_(whole), number_(whole.positions.size() + whole.corners.size(), none) {
    mesh.spacing = whole.spacing, mesh.thickness = whole.thickness;
  }

  template <typename Cell>
  void take(const Cell& cell, std::vector<Cell>& cells) {
    for (const auto vertex : cell)
      if (number_[vertex] == none)
        number_[vertex] = 0, (vertex < whole_.positions.size() ? points : corners_).push_back(vertex);
    cells.push_back(cell);
  }
  /// A point that may be in no cell.
  void take(std::uint32_t point) {
    if (number_[point] == none) number_[point] = 0, points.push_back(point);
  }
  /// Numbers what has been taken, and takes what its corners need.
  void finish() {
    const auto drawn = points.size();
    for (const auto corner : corners_)
      for (const auto& source : whole_.corners[corner - whole_.positions.size()].sources) take(source.point);
    mesh.others = points.size() - drawn;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      number_[points[i]] = i;
      mesh.positions.push_back(whole_.positions[points[i]]), mesh.areas.push_back(whole_.areas[points[i]]);
      mesh.cut.push_back(whole_.cut[points[i]]);
      if (!whole_.numbers.empty()) mesh.numbers.push_back(whole_.numbers[points[i]]);
    }
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      number_[corners_[i]] = std::uint32_t(points.size()) + i;
      mesh.corners.push_back(whole_.corners[corners_[i] - whole_.positions.size()]);
      for (auto& source : mesh.corners.back().sources) source.point = number_[source.point];
    }
    for (auto& cell : mesh.quads)
      for (auto& vertex : cell) vertex = number_[vertex];
    for (auto& cell : mesh.triangles)
      for (auto& vertex : cell) vertex = number_[vertex];
  }

  plate::Mesh mesh;
  std::vector<std::uint32_t> points;

private:
  const plate::Mesh& whole_;
  std::vector<std::uint32_t> number_, corners_;  // of the global vertices
};

bool before(const Point& a, const Point& b) {
  return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
}

/// Values of the plate's points with those of others' points from their owners, three rows at most.
template <typename Rows>
void fetch(const plate::Formulation& plate, Rows&& values) {
  auto all = plate::zero_state(plate.points());
  all.topLeftCorner(values.rows(), values.cols()) = values;
  plate.constraints().fetch(all);
  values = all.topLeftCorner(values.rows(), values.cols());
}

}  // namespace

OwnedMesh::OwnedMesh(const plate::Formulation& plate, const plate::Mesh& whole) : plate_(plate) {
  MeshPart part(whole);
  for (std::uint32_t k = 0; k < plate.cloud().plate_points; ++k)
    if (plate.boundary().owns(k)) part.take(k);
  own_ = part.points.size();
  const auto& lattice = plate.boundary().lattice;
  const auto own = [&](const auto& cell) {  // whose the lowest of its points is, of these the one to the left
    std::optional<std::uint32_t> first;
    for (const auto k : cell)
      if (k < whole.positions.size() && (!first || before(lattice[k], lattice[*first]))) first = k;
    return first ? plate.boundary().owns(*first) : plate.here(whole.corners[cell[0] - whole.positions.size()].position);
  };
  for (const auto& cell : whole.quads)
    if (own(cell)) part.take(cell, part.mesh.quads);
  for (const auto& cell : whole.triangles)
    if (own(cell)) part.take(cell, part.mesh.triangles);
  part.finish();
  mesh_ = std::move(part.mesh), points_ = std::move(part.points), mesh_.own = own_;
}

std::unique_ptr<OwnedMesh> owned_mesh(const plate::Formulation& plate, const plate::Mesh& whole) {
  return plate.distributed() ? std::make_unique<OwnedMesh>(plate, whole) : nullptr;
}

plate::State OwnedMesh::own(const plate::State& of_plate, std::size_t count) const {
  plate::State result(plate::unknowns_per_point, Eigen::Index(count));
  for (std::size_t i = 0; i < count; ++i) result.col(Eigen::Index(i)) = of_plate.col(Eigen::Index(points_[i]));
  return result;
}

post::Frame OwnedMesh::frame(post::Frame seen) const {
  auto& resultants = seen.resultants;
  post::Frame result{seen.time, seen.step, own(seen.state, points_.size()), {}, {}, std::move(seen.cracks)};
  if (auto& in_plane = seen.in_plane) {
    fetch(plate_, in_plane->force);
    result.in_plane =
        post::InPlaneFields{in_plane->displacement(Eigen::all, points_), in_plane->force(Eigen::all, points_)};
  }
  if (resultants.von_mises.size() == 0) return result;
  fetch(plate_, resultants.moments);
  fetch(plate_, resultants.shear);
  fetch(plate_, resultants.von_mises.transpose());
  fetch(plate_, resultants.top);
  if (resultants.bottom.cols() > 0) fetch(plate_, resultants.bottom);
  const auto count = Eigen::Index(points_.size());
  result.resultants = plate::resultants_of(count);
  result.resultants.top = resultants.top(Eigen::all, points_);
  if (resultants.bottom.cols() > 0) result.resultants.bottom = resultants.bottom(Eigen::all, points_);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = Eigen::Index(points_[std::size_t(i)]);
    result.resultants.moments.col(i) = resultants.moments.col(k);
    result.resultants.shear.col(i) = resultants.shear.col(k);
    result.resultants.von_mises[i] = resultants.von_mises[k];
    result.damage.push_back(seen.damage[std::size_t(k)]);
  }
  return result;
}

}  // namespace cases
