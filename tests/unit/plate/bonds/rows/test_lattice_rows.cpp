#include "plate/bonds/rows/lattice_operator.hpp"

#include <omp.h>

#include "plate/bonds/family_weights.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using geometry::Point;

namespace {

/// The plate of `m` with the cracks cut, position-aware, in the form for rows of points.
LatticeOperator cracked(const small_plate::Model& m, const geometry::Outline& outline,
                        const std::vector<geometry::Polyline>& cracks) {
  const auto paths = geometry::to_lattice(geometry::crack_paths(outline, cracks, 1e-9), m.boundary.cloud.units);
  auto families = geometry::without(m.plate.families(), [&](std::uint32_t k, std::uint32_t j) {
    return std::any_of(paths.begin(), paths.end(), [&](const auto& path) {
      return geometry::separates(path, m.boundary.lattice[k], m.boundary.lattice[j]);
    });
  });
  auto shapes = bond_shapes(families.vectors(), small_plate::section, m.discretization);
  const auto& areas = m.boundary.cloud.areas;
  const auto kinds = family_kinds(families, areas, m.boundary.active);
  auto weights = position_aware(families, shapes, areas, m.boundary.active, kinds, small_plate::section).weights;
  return LatticeOperator(FamilyOperator(std::move(families), std::move(shapes), areas, std::move(weights)));
}

/// Largest difference to the family list over the largest force.
double difference(const LatticeOperator& lattice, unsigned seed) {
  const FamilyOperator list = lattice;
  const State u = small_plate::random_state(Eigen::Index(lattice.points()), seed);
  Forces fast, plain;
  lattice.internal_force(u, fast);
  list.internal_force(u, plain);
  return (fast - plain).cwiseAbs().maxCoeff() / plain.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("rows of points and the family list give the same forces: holes, supports, cracks at any angle") {
  auto outline = geometry::rectangle(0, 0, 5, 4);
  outline.holes.push_back(geometry::Circle{{3.7, 2.9}, 0.43, "hole"});
  const auto m = small_plate::model(outline,
                                    {{SupportKind::clamped, {"left"}, {}},
                                     {SupportKind::clamped_layer, {"right"}, {}},
                                     {SupportKind::simply_supported, {"top"}, {}}},
                                    small_plate::spaced(0.1));
  for (const std::vector<geometry::Polyline>& cracks : {std::vector<geometry::Polyline>{},
                                                        {{{1, 2}, {2.5, 2}}},
                                                        {{{1, 1}, {2.4, 2.1}}},
                                                        {{{1, 1}, {2, 2}, {2.6, 2}}, {{0, 3}, {1, 3}}}}) {
    const auto lattice = cracked(m, outline, cracks);
    const auto& rows = lattice.rows();
    CAPTURE(cracks.size(), rows.folded_share(), rows.row_share(), rows.packet_share());
    CHECK(difference(lattice, 21) < 1e-14);  // measured: 5e-16
    CHECK(rows.row_share() > 0.3);
    CHECK(rows.row_share() < 1);
    CHECK(rows.folded_share() > 0.1);
    CHECK(rows.packet_share() < 0.6);
  }
}

TEST_CASE("rows of points and the family list give the same forces for every disc of bonds") {
  const auto outline = geometry::rectangle(0, 0, 4, 3);
  for (const double ratio : {2.015, 2.3, 2.9, 3.015, 3.2, 3.7, 4.015, 5.015}) {
    auto d = small_plate::spaced(0.1);
    d.horizon_ratio = ratio;
    const auto lattice = cracked(small_plate::model(outline, {{SupportKind::clamped, {"left"}, {}}}, d), outline, {});
    INFO(ratio);
    CHECK(difference(lattice, 25) < 1e-14);                       // as above
    CHECK((lattice.rows().folded_share() > 0.2) == (ratio < 5));  // beyond: pairs
  }
}

TEST_CASE(
    "rows of every length against the width of a vector") {  // with sanitizers: nothing is read beyond what is kept
  for (int columns = 28; columns <= 45; ++columns) {
    const auto outline = geometry::rectangle(0, 0, 0.1 * columns, 2);
    const auto lattice = cracked(
        small_plate::model(outline, {{SupportKind::clamped, {"bottom"}, {}}}, small_plate::spaced(0.1)), outline, {});
    INFO(columns);
    CHECK(lattice.rows().folded_share() > 0.1);
    CHECK(difference(lattice, 26) < 1e-14);  // as above
  }
}

TEST_CASE("plates narrower than a vector, and a single point") {
  for (const auto& outline : {geometry::rectangle(0, 0, 0.5, 3), geometry::rectangle(0, 0, 0.1, 0.1)}) {
    const auto m = small_plate::model(outline, {}, small_plate::spaced(0.1));
    const auto lattice = cracked(m, outline, {});
    if (lattice.points() > 1) CHECK(difference(lattice, 22) < 1e-14);
    Forces force;
    lattice.internal_force(State::Ones(3, Eigen::Index(lattice.points())), force);
    CHECK(force.allFinite());
  }
}

TEST_CASE(
    "single precision: close to double, and no foundation under a deflection that is large against its differences") {
  const auto outline = geometry::rectangle(0, 0, 6, 5);
  const auto m = small_plate::model(outline, {{SupportKind::clamped, {"left", "top"}, {}}}, small_plate::spaced(0.1));
  const auto lattice = cracked(m, outline, {{{1, 1}, {2.4, 2.1}}});
  const auto single = lattice.single_rows();
  State u = small_plate::random_state(Eigen::Index(lattice.points()), 24);
  Forces exact;
  Values<float> force;
  lattice.internal_force(u, exact);
  single.internal_force(u.cast<float>(), force);
  CHECK((force.cast<double>() - exact).norm() < 3e-6 * exact.norm());  // measured: 4e-7

  u.setZero();
  for (Eigen::Index k = 0; k < u.cols(); ++k) u(0, k) = std::sin(0.5 * m.boundary.cloud.positions[std::size_t(k)].x());
  lattice.internal_force(u, exact);
  single.internal_force(u.cast<float>(), force);
  const double stiffness = lattice.diagonal().row(0).maxCoeff();
  const double foundation = (force.row(0).cast<double>() - exact.row(0)).mean() / (stiffness * u.row(0).mean());
  CHECK(std::abs(foundation) < 2e-9);  // measured: 7e-10; 6e-9 where the sum of the weights is rounded
}

TEST_CASE("rows of points: the same bits for any number of threads") {
  const auto outline = geometry::rectangle(0, 0, 4, 4);
  const auto m = small_plate::model(outline, {}, small_plate::spaced(0.1));
  const auto lattice = cracked(m, outline, {{{1, 1}, {2.4, 2.1}}});
  const State u = small_plate::random_state(m.points(), 23);
  const int before = omp_get_max_threads();
  Forces one, three;
  omp_set_num_threads(1);
  lattice.internal_force(u, one);
  omp_set_num_threads(3);
  lattice.internal_force(u, three);
  omp_set_num_threads(before);
  CHECK(one == three);
}
