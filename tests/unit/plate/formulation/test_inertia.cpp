#include "plate/formulation/inertia.hpp"

#include "geometry/cells/tessellation.hpp"
#include "geometry/shape/crack_path.hpp"
#include "tests/catch.hpp"

using namespace plate;

namespace {

const Section section{1000, 0.3, 0.2, 5.0 / 6, 3};

geometry::Tessellation cells(bool graded) {
  const geometry::Outline outline{geometry::Polygon{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {"a", "b", "c", "d"}}, {}};
  const auto paths = geometry::crack_paths(outline, {geometry::Polyline{{0.5, 0.4}, {1.2, 0.6}}}, 1e-9);
  return geometry::tessellation(outline, paths, 0.1, {}, {graded ? std::optional(0.02) : std::nullopt, {}, 0.3});
}

}  // namespace

TEST_CASE(
    "inertia: the kinetic energy of fields that cells hold is exact, on lattices and graded points, across a crack") {
  for (const bool graded : {false, true}) {
    const auto plate = cells(graded);
    REQUIRE(plate.squares.empty() == graded);
    Constraints free;
    free.resolve();
    const Inertia inertia(section, plate, free, 1.5);
    State u(3, Eigen::Index(plate.positions.size()));
    for (std::size_t k = 0; k < plate.positions.size(); ++k) {
      const auto& x = plate.positions[k];
      u.col(Eigen::Index(k)) << 1 + 2 * x.x() - x.y(), x.x(), 3;
    }
    // integrals over [0, 2] x [0, 1] of (1 + 2 x - y)^2, x^2 and 9
    const double rho_h = 3 * 0.2, rotary = 1.5 * rho_h * 0.04 / 12;
    const double of_w = 2.0 * (1 + 16.0 / 3 + 1.0 / 3 + 4 - 1 - 2), of_x = 8.0 / 3, of_y = 18;
    CHECK(u.cwiseProduct(inertia(u)).sum() == Approx(rho_h * of_w + rotary * (of_x + of_y)).epsilon(1e-12));
  }
}

TEST_CASE("inertia: symmetric, and held degrees of freedom have none") {
  const auto plate = cells(true);
  Constraints held;
  held.fix(dof(0, 0)), held.fix(dof(2, 1));
  held.resolve();
  const Inertia inertia(section, plate, held, 1);
  State u = State::Random(3, Eigen::Index(plate.positions.size())), v = State::Random(3, u.cols());
  held.impose(u), held.impose(v);
  CHECK(u.cwiseProduct(inertia(v)).sum() == Approx(v.cwiseProduct(inertia(u)).sum()));
  CHECK(at_dof(inertia(u), dof_by_points(0)) == 0);
  CHECK(at_dof(inertia(u), dof_by_points(7)) == 0);
  CHECK(u.cwiseProduct(inertia(u)).sum() > 0);
}

TEST_CASE("inertia: points that follow two others leave them their whole mass") {
  Constraints constraints;
  constraints.tie({2, 1}, {{{0, 1}, 0.25}, {{1, 1}, 0.75}});
  constraints.tie({3, 1}, {{{0, 1}, 1.5}, {{1, 1}, -0.5}});
  constraints.resolve();
  Forces mass = Forces::Constant(3, 4, 2.0);
  const Forces whole = whole_mass(mass, constraints);
  CHECK(whole.row(1).sum() == Approx(8));
  CHECK(whole(1, 2) == 0);
  Forces diagonal = mass;
  constraints.fold_diagonal(diagonal);
  CHECK(diagonal.row(1).sum() == Approx(2 * (2 + 0.0625 + 0.5625 + 2.25 + 0.25)));
  CHECK(whole.row(0) == diagonal.row(0));
}
