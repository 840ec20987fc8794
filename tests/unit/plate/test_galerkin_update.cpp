#include <catch2/catch.hpp>

#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;
using geometry::Point;

namespace {

std::uint32_t at(const geometry::Tessellation& cells, const Point& x) {
  for (std::uint32_t k = 0; k < cells.positions.size(); ++k)
    if ((cells.positions[k] - x).norm() < 1e-6) return k;
  FAIL("no such point");
  return 0;
}

/// The point that a crack with its tip at `tip` would run to next.
std::uint32_t ahead(const geometry::Tessellation& cells, std::uint32_t tip, const Point& direction) {
  const auto families = geometry::cell_families(cells);
  std::uint32_t best = tip;
  double straightest = 0;
  for (const auto& [j, vector] : families[tip])
    if (families.vectors()[vector].norm() > 1.3 * cells.units.spacing) {
      continue;  // the diagonal of a square is no side
    } else if (const double cosine = families.vectors()[vector].normalized().dot(direction); cosine > straightest)
      straightest = cosine, best = j;
  return best;
}

struct Grown {
  geometry::Tessellation cells;
  GalerkinFamilies before, after;
  std::vector<geometry::Parting> partings;
};

/// A crack that grows by `steps` sides.
Grown grown(geometry::Tessellation cells, const Point& tip, const Point& direction, int steps) {
  Grown result{{}, galerkin_families(cells), galerkin_families(cells), {}};
  geometry::CellParting parting(cells);
  auto k = at(cells, tip);
  for (int i = 0; i < steps; ++i) {
    const auto next = ahead(cells, k, direction);
    result.partings.push_back(parting.part(k, next));
    update(result.after, cells, parting, result.partings.back());
    k = next;
  }
  result.cells = std::move(cells);
  return result;
}

}  // namespace

TEST_CASE("a crack grown side by side is the crack drawn at that length") {
  const auto plain = geometry::rectangle(0, 0, 1.2, 0.8);
  const auto g = grown(gp::cells(plain, 0.1, {{{0, 0.4}, {0.4, 0.4}}}), {0.4, 0.4}, {1, 0}, 3);
  const auto drawn = gp::cells(plain, 0.1, {{{0, 0.4}, {0.7, 0.4}}});
  const auto families = galerkin_families(drawn);
  REQUIRE(g.cells.positions.size() == drawn.positions.size());
  CHECK(g.cells.borders.size() == drawn.borders.size());
  // the numbers of the points differ: energies of the same field do not
  const auto field = [](const geometry::Tessellation& cells) {
    const auto seen = geometry::seen_positions(cells);
    State u(3, Eigen::Index(seen.size()));
    for (Eigen::Index k = 0; k < u.cols(); ++k) {
      const Point& x = seen[std::size_t(k)];
      const double face = x.y() > 0.4 && x.x() < 0.7 - 1e-9 ? 1 : 0;
      u.col(k) << std::sin(3 * x.x()) * x.y() + 0.1 * face * (0.7 - x.x()), x.x() * x.y() + 0.2 * face,
          std::cos(2 * x.y());
    }
    return u;
  };
  const GalerkinOperator one(g.after, gp::section), other(families, gp::section);
  CHECK(one.energies(field(g.cells)).sum() == Approx(other.energies(field(drawn)).sum()).epsilon(1e-12));
}

TEST_CASE("growth touches few families, and they stay consistent") {
  const auto plain = geometry::rectangle(0, 0, 1.2, 0.8);
  for (const auto& [cells, tip, direction] :
       {std::tuple{gp::cells(plain, 0.05, {{{0.3, 0.4}, {0.6, 0.4}}}), Point(0.6, 0.4), Point(1, 0)},
        std::tuple{gp::cells(plain, 0.05, {{{0.3, 0.3}, {0.6, 0.43}}}), Point(0.6, 0.43), Point(0.9, 0.4)},
        std::tuple{gp::cells(gp::with_hole(), 0.05, {{{0.8, 0.42}, {0.9, 0.42}}}), Point(0.9, 0.42), Point(1, 0)}}) {
    const auto g = grown(cells, tip, direction, 4);
    const auto residuals = consistency_residuals(g.after, g.cells);
    CHECK(residuals.first < 1e-13);
    CHECK(residuals.second < 1e-13);
    for (const auto& parting : g.partings) {
      CHECK(parting.origins.size() == 1);
      CHECK(parting.touched.size() < 20);  // measured: 13 and 14, all corners of the cells about the two points
    }
    // area stays where it was: momentum with the velocities of the origin, and the work of pressure
    std::vector<double> at_origin(g.before.areas.size(), 0);
    std::vector<std::uint32_t> origin(g.before.areas.size());
    for (std::uint32_t k = 0; k < origin.size(); ++k) origin[k] = k;
    for (const auto& parting : g.partings)
      for (const auto k : parting.origins) origin.push_back(origin[k]);
    for (std::size_t k = 0; k < g.after.areas.size(); ++k) at_origin[origin[k]] += g.after.areas[k];
    for (std::size_t k = 0; k < at_origin.size(); ++k) CHECK(at_origin[k] == Approx(g.before.areas[k]).epsilon(1e-13));
  }
}

TEST_CASE("cells are parted at sides between two of them only") {
  auto cells = gp::cells(geometry::rectangle(0, 0, 1.2, 0.8), 0.1);
  geometry::CellParting parting(cells);
  CHECK_THROWS_AS(parting.part(at(cells, {0.1, 0}), at(cells, {0.2, 0})), std::invalid_argument);
  CHECK_THROWS_AS(parting.part(at(cells, {0.1, 0.1}), at(cells, {0.2, 0.2})), std::invalid_argument);
  const auto points = cells.positions.size();
  CHECK(parting.part(at(cells, {0, 0.4}), at(cells, {0.1, 0.4})).origins.size() == 1);  // from an edge: a mouth opens
  CHECK(cells.positions.size() == points + 1);
}
