#include "plate/formulation/pieces.hpp"

#include "geometry/lattice/cloud.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using geometry::Point;

namespace {

std::vector<Piece> pieces_of(const std::vector<Support>& supports, const std::vector<geometry::CrackPath>& cracks = {},
                             const geometry::Outline& outline = geometry::rectangle(0, 0, 1.2, 0.9)) {
  const auto m = small_plate::model(outline, supports, small_plate::spaced(0.1), cracks);
  return pieces(m.boundary, m.plate.families());
}

int free_modes(const std::vector<Support>& supports) {
  const auto all = pieces_of(supports);
  REQUIRE(all.size() == 1);
  CHECK(all[0].points == 108);
  return all[0].free_modes;
}

Support on(SupportKind kind, const std::vector<std::string>& edges) {
  return {kind, edges, {}};
}

Support pins(const std::vector<Point>& points) {
  return {SupportKind::pinned, {}, points};
}

}  // namespace

TEST_CASE("rigid motions left by supports") {
  using enum SupportKind;
  CHECK(free_modes({}) == 3);
  CHECK(free_modes({on(simply_supported, {"left"})}) == 1);  // turns about the edge
  CHECK(free_modes({on(simply_supported, {"bottom"})}) == 1);
  CHECK(free_modes({on(simply_supported, {"left", "right"})}) == 0);
  CHECK(free_modes({on(simply_supported, {"left", "bottom"})}) == 0);
  CHECK(free_modes({on(simply_supported_hard, {"left"})}) == 1);
  CHECK(free_modes({on(clamped, {"top"})}) == 0);
  CHECK(free_modes({on(symmetry, {"left"})}) == 2);  // w = 1 and w = y
  CHECK(free_modes({on(symmetry, {"left", "bottom"})}) == 1);
  CHECK(free_modes({on(symmetry, {"left", "bottom"}), pins({{0.6, 0.5}})}) == 0);
}

TEST_CASE("rigid motions left by layers") {
  using enum SupportKind;
  CHECK(free_modes({on(clamped_layer, {"left"})}) == 0);
  CHECK(free_modes({on(simply_supported_layer, {"left"})}) == 0);  // w = 0 in a strip: its slope is zero too
}

TEST_CASE("rigid motions left by pins") {
  CHECK(free_modes({pins({{0.1, 0.1}})}) == 2);
  CHECK(free_modes({pins({{0.1, 0.1}, {1.1, 0.1}})}) == 1);
  CHECK(free_modes({pins({{0.1, 0.1}, {1.1, 0.1}, {0.5, 0.8}})}) == 0);
  CHECK(free_modes({pins({{0.05, 0.05}, {0.45, 0.45}, {0.85, 0.85}})}) == 1);  // on one line
}

TEST_CASE("a crack across the plate makes two pieces, each with its own supports") {
  const geometry::CrackPath crack{{{5, -1}, {5, 10}}, geometry::End::mouth, geometry::End::mouth};
  const auto all = pieces_of({on(SupportKind::clamped, {"left"})}, {crack});
  REQUIRE(all.size() == 2);
  CHECK(all[0].points == 7 * 9);  // the larger first
  CHECK(all[0].free_modes == 3);
  CHECK((all[0].position - Point(0.55, 0.05)).norm() < 1e-12);
  CHECK(all[0].first_point == 5);
  CHECK(all[1].points == 5 * 9);
  CHECK(all[1].free_modes == 0);
  CHECK(all[1].first_point == 0);
}

TEST_CASE("a crack that ends inside does not divide the plate") {
  const geometry::CrackPath crack{{{5, -1}, {5, 7}}, geometry::End::mouth, geometry::End::tip};
  const auto all = pieces_of({}, {crack});
  REQUIRE(all.size() == 1);
  CHECK(all[0].free_modes == 3);
}

TEST_CASE("two soft edges hold a plate that is small or far away alike") {
  const auto outline = geometry::rectangle(1000, -500, 1003, -497.6);
  const auto all = pieces_of({on(SupportKind::simply_supported, {"left", "right"})}, {}, outline);
  REQUIRE(all.size() == 1);
  CHECK(all[0].points == 30 * 24);
  CHECK(all[0].free_modes == 0);
}

TEST_CASE("what has fallen off: pieces that nothing holds, of a plate that nothing holds, all but the largest") {
  const auto outline = geometry::rectangle(0, 0, 1, 1);
  for (const bool held : {true, false}) {
    Discretization d;
    d.spacing = 0.1;
    auto cloud = geometry::lattice(outline, d.spacing);
    const auto lattice_outline = geometry::to_lattice(outline, cloud.units);
    const std::vector<Support> supports =
        held ? std::vector<Support>{{SupportKind::clamped, {"left"}, {}}} : std::vector<Support>{};
    const auto b = boundary(std::move(cloud), lattice_outline, supports, d);
    const auto whole = geometry::families(b.cloud, d.horizon(), sees(b, lattice_outline, d.horizon_ratio));
    CHECK(detached_points(b, whole).empty());
    // parted at x = 0.3: the right part is the larger one
    const auto parted = geometry::without(whole, [&](std::uint32_t k, std::uint32_t j) {
      return (b.cloud.positions[k].x() < 0.3) != (b.cloud.positions[j].x() < 0.3);
    });
    CHECK(detached_points(b, parted).size() == (held ? 70 : 30));
  }
}
