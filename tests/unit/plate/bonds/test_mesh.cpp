#include "plate/bonds/results.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using geometry::Point;

namespace {

Mesh mesh_of(const geometry::Outline& outline, const std::vector<Support>& supports = {},
             const std::vector<geometry::CrackPath>& cracks = {}, std::vector<double> cut = {}) {
  const auto m = small_plate::model(outline, supports, small_plate::spaced(1), cracks);
  return mesh(m.boundary, outline, cracks, std::move(cut), small_plate::section.thickness);
}

/// What a corner shows of values at the points.
template <typename Values>
double shown(const Mesh& mesh, const Mesh::Corner& corner, double Mesh::Source::*weight, const Values& values) {
  double sum = 0;
  for (const auto& source : corner.sources) sum += source.*weight * values(mesh.positions[source.point]);
  return sum;
}

}  // namespace

TEST_CASE("mesh: the points of the plate come first, with squares between them") {
  const Mesh found = mesh_of(geometry::rectangle(0, 0, 7, 5), {{SupportKind::clamped, {"left"}, {}}});
  CHECK(found.positions.size() == 35);  // no fictitious points
  CHECK(found.areas.size() == 35);
  CHECK(found.spacing == 1);
  CHECK(found.thickness == small_plate::section.thickness);
  CHECK(found.quads.size() == 6 * 4);
  for (const auto& quad : found.quads) {
    CHECK(found.positions.at(quad[1]) - found.positions.at(quad[0]) == Point(1, 0));
    CHECK(found.positions.at(quad[2]) - found.positions.at(quad[1]) == Point(0, 1));
  }
  CHECK(mesh_of(geometry::rectangle(0, 0, 2, 1), {}, {}, {0.25, 0.5}).cut == std::vector<double>{0.25, 0.5});
}

TEST_CASE("mesh: corners show linear fields exactly, and means of their neighbours") {
  auto outline = geometry::rectangle(0, 0, 12.3, 11);
  outline.holes.push_back(geometry::Circle{{6.2, 5.1}, 2.2, "hole"});
  const geometry::CrackPath crack{{{1.5, 8.2}, {8.3, 9.1}}, geometry::End::tip, geometry::End::tip};
  const Mesh found = mesh_of(outline, {}, {crack});
  REQUIRE(found.corners.size() > 60);
  const auto linear = [](const Point& x) { return 3 + x.x() - 2 * x.y(); };
  std::size_t exact = 0;
  for (const auto& corner : found.corners) {
    CHECK(shown(found, corner, &Mesh::Source::mean, [](const Point&) { return 1.5; }) == Approx(1.5));
    CHECK(shown(found, corner, &Mesh::Source::linear, [](const Point&) { return 1.5; }) == Approx(1.5));
    for (const auto& source : corner.sources) CHECK(source.mean > 0);
    exact += std::abs(shown(found, corner, &Mesh::Source::linear, linear) - linear(corner.position)) < 1e-9;
  }
  CHECK(exact == found.corners.size());
}

TEST_CASE("mesh: both faces of a crack show their own side") {
  const geometry::CrackPath crack{{{-1, -1.3}, {9, 8.7}}, geometry::End::mouth, geometry::End::mouth};  // y = x - 0.3
  const geometry::CrackPath inside{{{0.3, 0}, {8, 7.7}}, geometry::End::mouth, geometry::End::mouth};
  const auto outline = geometry::rectangle(0, 0, 8, 8);
  const auto m = small_plate::model(outline, {}, small_plate::spaced(1), {crack});
  const Mesh found = mesh(m.boundary, outline, {inside}, {}, 1);
  const auto above = [](const Point& x) { return x.y() > x.x() - 0.3 ? 1.0 : 0.0; };
  std::size_t upper = 0, lower = 0;
  for (const auto& corner : found.corners) {
    const double side = shown(found, corner, &Mesh::Source::linear, above);
    if (std::abs(corner.position.y() - corner.position.x() + 0.3) < 1e-9) {
      CHECK((std::abs(side) < 1e-12 || std::abs(side - 1) < 1e-12));
      ++(side > 0.5 ? upper : lower);
    } else {
      CHECK(side == Approx(above(corner.position)).margin(1e-12));
    }
  }
  CHECK(upper == lower);
  CHECK(upper >= 8);
}
