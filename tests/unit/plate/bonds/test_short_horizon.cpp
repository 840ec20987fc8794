#include "plate/bonds/preconditioners.hpp"

#include "plate/bonds/family_weights.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;

namespace {

small_plate::Model held_top_and_bottom(double spacing, bool cracked) {
  const auto outline = geometry::rectangle(0, 0, 3, 2);
  std::vector<geometry::CrackPath> cracks;
  if (cracked) {
    cracks = geometry::crack_paths(outline, {{{0.8, 0.7}, {2.1, 1.2}}}, 1e-9);
    for (auto& crack : cracks)
      for (auto& vertex : crack.vertices) vertex /= spacing;
  }
  return small_plate::model(outline,
                            {{SupportKind::simply_supported, {"bottom"}, {}}, {SupportKind::clamped, {"top"}, {}}},
                            small_plate::spaced(spacing), cracks);
}

Forces pressure(const small_plate::Model& m) {
  Forces load = Forces::Zero(3, m.points());
  for (std::size_t k = 0; k < m.boundary.cloud.plate_points; ++k) load(0, Eigen::Index(k)) = m.boundary.cloud.areas[k];
  return load;
}

Section of_thickness(double h) {
  Section result = small_plate::section;
  result.thickness = h;
  return result;
}

/// A plate of another thickness than that of small_plate.
FamilyOperator with(const small_plate::Model& m, const Section& section) {
  auto families = m.plate.families();
  auto shapes = bond_shapes(families.vectors(), section, m.discretization);
  const auto& areas = m.boundary.cloud.areas;
  const auto kinds = family_kinds(families, areas, m.boundary.active);
  auto weights = position_aware(families, shapes, areas, m.boundary.active, kinds, section).weights;
  return {std::move(families), std::move(shapes), areas, std::move(weights)};
}

Eigen::MatrixXd dense_matrix(const Preconditioner& preconditioner, const Unknowns& unknowns, Eigen::Index points) {
  Eigen::MatrixXd result(unknowns.size(), unknowns.size());
  State out;
  for (Eigen::Index u = 0; u < unknowns.size(); ++u) {
    Forces unit = Forces::Zero(3, points);
    at_dof(unit, unknowns.dof[std::size_t(u)]) = 1;
    preconditioner.apply(unit, out);
    for (Eigen::Index v = 0; v < unknowns.size(); ++v) result(v, u) = at_dof(out, unknowns.dof[std::size_t(v)]);
  }
  return result;
}

}  // namespace

TEST_CASE("assembled stiffness: P^T K P, with and without dilatation") {
  const auto m = held_top_and_bottom(0.25, true);
  const Eigen::MatrixXd K = small_plate::stiffness(m.plate);
  const Eigen::MatrixXd P = small_plate::prolongation(m.boundary.constraints, K.rows());
  const auto free = unknowns(folded_diagonal(m.plate, m.boundary.constraints));
  const auto of_free = [&](bool with_dilatation) {
    return of_unknowns(folded(stiffness_matrix(m.plate, with_dilatation), m.boundary.constraints), free);
  };
  const Eigen::MatrixXd lower = of_free(true);
  const Eigen::MatrixXd found = lower.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd expected = P.transpose() * K * P;
  REQUIRE(found.rows() == expected.rows());
  CHECK((found - expected).norm() < 1e-13 * expected.norm());  // measured: 2e-16

  const Eigen::MatrixXd part = of_free(false);
  const Eigen::MatrixXd bonds = part.selfadjointView<Eigen::Lower>();
  // the dilatation is in the rest: a is negative below a Poisson's ratio of 1/3
  CHECK((expected - bonds).trace() < 0);
}

TEMPLATE_TEST_CASE(
    "local plate on all or on every second point: symmetric, positive, and near the inverse of the plate "
    "for every spacing and thickness",
    "", ShortHorizonPreconditioner, TwoLevelPreconditioner) {
  for (const double h : {0.25, 0.05}) {
    const auto m = held_top_and_bottom(0.25, true);
    const auto section = of_thickness(h);
    const auto plate = with(m, section);
    const TestType local(plate, m.boundary, section, m.discretization);
    const auto free = unknowns(folded_diagonal(plate, m.boundary.constraints));
    const Eigen::MatrixXd M = dense_matrix(local, free, m.points());
    CHECK((M - M.transpose()).norm() < 1e-12 * M.norm());  // measured: 1e-15
    CHECK(dense::eigenvalues(M).minCoeff() > 0);
  }
  for (const double spacing : {0.1, 0.05})
    for (const double h : {0.5, 0.1, 0.03}) {
      const auto m = held_top_and_bottom(spacing, true);
      const auto section = of_thickness(h);
      const auto plate = with(m, section);
      const TestType local(plate, m.boundary, section, m.discretization);
      const auto solution = conjugate_gradients(plate, m.boundary.constraints, pressure(m), {1e-8, 1000, {}}, &local);
      INFO(spacing << ' ' << h << ' ' << solution.iterations);
      CHECK(solution.converged);
      CHECK(solution.iterations <= 40);  // measured: 10 to 25, the most where the spacing is 3.3 thicknesses
      const auto diagonal = conjugate_gradients(plate, m.boundary.constraints, pressure(m), {1e-8, 100000, {}});
      CHECK(diagonal.iterations > 6 * solution.iterations);
      CHECK((solution.state - diagonal.state).norm() < 1e-6 * diagonal.state.norm());
    }
}

TEST_CASE("assembled plate: one or two iterations, many loads at once") {
  const auto m = held_top_and_bottom(0.1, true);
  const AssembledPlate factor(m.plate, m.boundary.constraints, stiffness_matrix(m.plate, true));
  const auto solution = conjugate_gradients(m.plate, m.boundary.constraints, pressure(m), {1e-9, 10, {}}, &factor);
  CHECK(solution.converged);
  CHECK(solution.iterations <= 2);
  Forces couple = Forces::Zero(3, m.points());
  couple(1, m.points() / 3) = 1;
  const auto states = factor.solve({pressure(m), couple});
  CHECK((states[0] - solution.state).norm() < 1e-8 * solution.state.norm());
  const auto second = conjugate_gradients(m.plate, m.boundary.constraints, couple, {1e-9, 10, {}}, &factor);
  CHECK((states[1] - second.state).norm() < 1e-8 * second.state.norm());
}

TEST_CASE("a stiffness that is not positive has no factor") {
  const auto m = small_plate::model(geometry::rectangle(0, 0, 1, 1), {}, small_plate::spaced(0.1));
  auto matrix = stiffness_matrix(m.plate, true);
  const auto free = unknowns(folded_diagonal(m.plate, m.boundary.constraints));
  matrix.block[0](0, 0) *= -1;
  CHECK_THROWS_AS(Factor(of_unknowns(folded(matrix, m.boundary.constraints), free)), NumericalError);
}
