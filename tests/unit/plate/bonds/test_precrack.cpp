#include "plate/bonds/visibility.hpp"

#include <Eigen/LU>

#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using geometry::CrackPath;
using geometry::End;
using geometry::Point;

namespace {

small_plate::Model sheet(const std::vector<Support>& supports = {}) {
  return small_plate::model(geometry::rectangle(0, 0, 14, 12), supports, small_plate::spaced(1));
}

geometry::Families remaining(const small_plate::Model& m, const std::vector<CrackPath>& paths) {
  return without_crossing_bonds(m.boundary, m.plate.families(), paths, m.discretization.horizon_ratio);
}

bool bonded(const geometry::Families& families, std::uint32_t k, std::uint32_t j) {
  for (const auto& bond : families[k])
    if (bond.neighbour == j) return true;
  return false;
}

/// Where the lines pq and ab meet, as shares of both; for segments in general position.
bool segments_cross(const Point& p, const Point& q, const Point& a, const Point& b) {
  Eigen::Matrix2d lines;
  lines << q - p, a - b;
  const Eigen::Vector2d share = lines.inverse() * (a - p);
  return share.minCoeff() > 0 && share.maxCoeff() < 1;
}

/// In general position: no point on it, no bond through a tip.
const Point bent[] = {{3.137, 4.271}, {7.613, 6.889}, {9.241, 4.153}};
const CrackPath crack{{bent[0], bent[1], bent[2]}, End::tip, End::tip};

bool same(const geometry::Families& a, const geometry::Families& b) {
  for (std::uint32_t k = 0; k < a.points(); ++k)
    for (const auto& bond : b[k])
      if (!bonded(a, k, bond.neighbour)) return false;
  return a.bonds() == b.bonds();
}

}  // namespace

TEST_CASE("without cracks nothing is severed") {
  const auto m = sheet();
  const auto rest = remaining(m, {});
  CHECK(same(rest, m.plate.families()));
}

TEST_CASE("a crack severs the bonds that cross it and no others") {
  const auto m = sheet();
  const auto& whole = m.plate.families();
  const auto rest = remaining(m, {crack});
  std::size_t cut = 0, kept = 0;
  for (std::uint32_t k = 0; k < whole.points(); ++k)
    for (const auto& bond : whole[k]) {
      const auto j = bond.neighbour;
      const Point &p = m.boundary.lattice[k], &q = m.boundary.lattice[j];
      const bool crosses = segments_cross(p, q, bent[0], bent[1]) || segments_cross(p, q, bent[1], bent[2]);
      REQUIRE(bonded(rest, k, j) == !crosses);
      ++(crosses ? cut : kept);
    }
  CHECK(cut > 100);
  CHECK(kept > 2000);
}

TEST_CASE("several cracks: each severs its own") {
  const auto m = sheet();
  const CrackPath other{{{10.3, 9.1}, {12.7, 10.9}}, End::tip, End::tip};
  const auto both = remaining(m, {crack, other});
  const auto one_by_one = without_crossing_bonds(m.boundary, remaining(m, {crack}), {other}, 3.015);
  CHECK(same(both, one_by_one));
  CHECK(both.bonds() < remaining(m, {crack}).bonds());
}

TEST_CASE("bonds to mirror images are severed by the crack's mirror images") {
  const auto m = sheet({{SupportKind::symmetry, {"left"}, {}}, {SupportKind::clamped, {"bottom"}, {}}});
  // to the left edge at y = 5, horizontal
  const CrackPath to_edge{{{0, 5}, {4.3, 5}}, End::mouth, End::tip};
  const auto& whole = m.plate.families();
  const auto rest = remaining(m, {to_edge});
  std::size_t cut = 0, images = 0;
  for (std::uint32_t k = 0; k < m.boundary.cloud.plate_points; ++k)
    for (const auto& bond : whole[k]) {
      const auto j = bond.neighbour;
      if (m.boundary.is_plate(j)) continue;
      const Point &p = m.boundary.lattice[k], &q = m.boundary.lattice[j];
      const bool across = (p.y() > 5) != (q.y() > 5);  // within a horizon of x = 0, shorter than the crack
      REQUIRE(bonded(rest, k, j) == !across);
      REQUIRE(bonded(rest, j, k) == !across);
      cut += across, ++images;
    }
  CHECK(cut > 10);
  CHECK(images > 100);
}

TEST_CASE("cut share: nothing away from the crack, the weights of the lost bonds beside it") {
  const auto m = sheet();
  const CrackPath straight{{{3, 6}, {11, 6}}, End::tip, End::tip};
  const auto& whole = m.plate.families();
  const auto share = cut_share(whole, remaining(m, {straight}), m.plate.shapes(), m.boundary.cloud.plate_points);
  REQUIRE(share.size() == 14 * 12);
  for (std::size_t k = 0; k < share.size(); ++k) {
    const double away = std::abs(m.boundary.lattice[k].y() - 6);
    CHECK(share[k] >= 0);
    CHECK(share[k] < 1);
    if (away > 3) CHECK(share[k] == 0);
  }
  // (6.5, 6.5): the lower of the 28 neighbours lie below the crack; weights horizon / length, linear at the rim
  double lost = 0, all = 0;
  for (int y = -3; y <= 3; ++y)
    for (int x = -3; x <= 3; ++x) {
      const double length = std::hypot(x, y);
      if (length == 0 || length > 3.015) continue;
      const double weight = std::min(1.0, 3.515 - length) / length;
      all += weight;
      if (y < 0) lost += weight;
    }
  const auto k = geometry::nearest_plate_point(m.boundary.cloud, {6.5, 6.5});
  CHECK(share[k] == Approx(lost / all).epsilon(1e-12));  // measured: 4e-16
}
