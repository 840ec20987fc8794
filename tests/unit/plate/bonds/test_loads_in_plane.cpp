#include "plate/bonds/loads_in_plane.hpp"

#include <numbers>

#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/supports.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using geometry::Point;

namespace {

constexpr double horizon_ratio = 3.015;

/// Sum of forces along x and y, and their moment about the origin.
Eigen::Vector3d resultant(const Boundary& b, const Forces& forces) {
  Eigen::Vector3d sum(0, 0, 0);
  for (Eigen::Index k = 0; k < forces.cols(); ++k) {
    const Point& x = b.cloud.positions[std::size_t(k)];
    const Point force(forces(2, k), -forces(1, k));
    sum += Eigen::Vector3d(force.x(), force.y(), x.x() * force.y() - x.y() * force.x());
  }
  return sum;
}

Boundary boundary_of(const geometry::Outline& outline, double spacing) {
  auto cloud = geometry::lattice(outline, spacing);
  const auto cells = geometry::to_lattice(outline, cloud.units);
  return boundary(std::move(cloud), cells, {}, small_plate::spaced(spacing), {}, {}, PlateLaw::membrane);
}

geometry::Outline slanted() {
  return {{{{0, 0}, {1.1, 0.2}, {1.0, 0.9}, {-0.2, 0.8}}, {"a", "b", "c", "d"}},
          {geometry::Circle{{0.5, 0.5}, 0.15, "hole"}}};
}

}  // namespace

TEST_CASE("tractions on edges in any direction have their force and moment") {
  const auto outline = slanted();
  const auto b = boundary_of(outline, 0.05);
  for (const auto& edge : geometry::straight_edges(outline)) {
    CAPTURE(edge.name);
    EdgeTraction load{{edge.name}, 2, -0.7};
    const auto forces = forces_in_plane({load}, b, outline, {}, horizon_ratio);
    const Point way = edge.to - edge.from, middle = (edge.from + edge.to) / 2, force = load.on({way.y(), -way.x()});
    const Eigen::Vector3d expected(force.x(), force.y(), middle.x() * force.y() - middle.y() * force.x());
    CHECK((resultant(b, forces) - expected).norm() < 1e-9 * expected.norm());
    CHECK(forces.row(0).isZero(0));
  }
}

TEST_CASE("a uniform stress on all edges is in balance") {
  for (const auto& tensor : {std::array{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}) {
    EdgeTraction load{{"a", "b", "c", "d", "hole"}};
    load.tensor = tensor;
    const auto outline = slanted();
    const auto b = boundary_of(outline, 0.05);
    const auto forces = forces_in_plane({load}, b, outline, {}, horizon_ratio);
    CHECK(resultant(b, forces).norm() < 1e-3 * forces.cwiseAbs().sum());  // a circle by chords
  }
}

TEST_CASE("tractions stay on their side of a crack from the edge") {
  const auto outline = geometry::rectangle(0, 0, 1, 1);
  const auto b = boundary_of(outline, 0.05);
  const auto cracks = geometry::crack_paths(outline, {{{0.5, 1.0}, {0.5, 0.6}}}, 1e-9);
  EdgeTraction load{{"top"}, 1};
  const auto forces = forces_in_plane({load}, b, outline, cracks, horizon_ratio);
  double left = 0;
  for (std::size_t k = 0; k < b.cloud.plate_points; ++k)
    if (b.cloud.positions[k].x() < 0.5) left -= forces(1, Eigen::Index(k));
  CHECK(left == Approx(0.5));
}

TEST_CASE("a force in the plane keeps its size and its place, and a body force its sum") {
  const auto outline = geometry::rectangle(0, 0, 1, 1);
  const auto b = boundary_of(outline, 0.05);
  for (const Point& at : {Point(0.51, 0.32), Point(0.999, 0.5), Point(1, 1)}) {
    const auto forces = forces_in_plane({PointForce{.position = at, .vector = {2, -3}}}, b, outline, {}, horizon_ratio);
    const Eigen::Vector3d expected(2, -3, -3 * at.x() - 2 * at.y());
    CHECK((resultant(b, forces) - expected).norm() < 1e-9);
  }
  const auto forces = forces_in_plane({BodyForce{{2, -3}}}, b, outline, {}, horizon_ratio);
  CHECK((resultant(b, forces) - Eigen::Vector3d(2, -3, -2.5)).norm() < 1e-9);
  CHECK(forces_in_plane({Pressure{1}}, b, outline, {}, horizon_ratio).isZero(0));
}

TEST_CASE("tractions along what a support of the edge holds are left to it") {
  const auto outline = slanted();
  const auto b = boundary_of(outline, 0.05);
  const EdgeTraction load{{"a"}, 2, -0.7};
  const auto with = [&](SupportKind kind) {
    Support support;
    support.kind = kind, support.edges = {"a"};
    return forces_in_plane({load}, b, outline, {}, horizon_ratio, {support});
  };
  const auto free = forces_in_plane({load}, b, outline, {}, horizon_ratio);
  CHECK(with(SupportKind::clamped).isZero(0));
  CHECK((with(SupportKind::symmetry) + with(SupportKind::simply_supported_hard) - free).norm() < 1e-12 * free.norm());
  CHECK(with(SupportKind::symmetry).norm() < 0.5 * free.norm());
}
