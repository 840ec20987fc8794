#include "plate/bonds/family_operator.hpp"

#include <omp.h>

#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;

namespace {

/// Edges, a hole, mirror images on one side, a layer on another.
small_plate::Model varied() {
  auto outline = geometry::rectangle(0, 0, 0.9, 0.8);
  outline.holes.push_back(geometry::Circle{{0.5, 0.4}, 0.13, "hole"});
  return small_plate::model(outline,
                            {{SupportKind::clamped, {"left"}, {}}, {SupportKind::clamped_layer, {"right"}, {}}},
                            small_plate::spaced(0.1));
}

double energy(const FamilyOperator& op, const State& state) {
  return op.energies(state).sum();
}

}  // namespace

TEST_CASE("internal force is minus the derivative of the energy") {
  const auto m = varied();
  const State u = small_plate::random_state(m.points(), 11);
  Forces force;
  m.plate.internal_force(u, force);
  double worst = 0;
  for (Eigen::Index n = 0; n < u.size(); ++n) {
    State plus = u, minus = u;
    plate::at_dof(plus, plate::dof_by_points(n)) += 1;  // any step: the energy is quadratic
    plate::at_dof(minus, plate::dof_by_points(n)) -= 1;
    worst = std::max(worst, std::abs(plate::at_dof(force, plate::dof_by_points(n)) +
                                     (energy(m.plate, plus) - energy(m.plate, minus)) / 2));
  }
  CHECK(force.cwiseAbs().maxCoeff() > 1);
  CHECK(worst < 1e-11 * force.cwiseAbs().maxCoeff());  // measured: 2e-15
}

TEST_CASE("energy is half the work of the force") {
  const auto m = varied();
  const State u = small_plate::random_state(m.points(), 12);
  Forces force;
  m.plate.internal_force(u, force);
  CHECK(energy(m.plate, u) == Approx(-force.cwiseProduct(u).sum() / 2).epsilon(1e-12));  // measured: 3e-16
}

TEST_CASE("stiffness is symmetric, its diagonal and its bound as promised") {
  const auto m = varied();
  const Eigen::MatrixXd K = small_plate::stiffness(m.plate);
  CHECK((K - K.transpose()).norm() < 1e-13 * K.norm());  // measured: 5e-18
  const Forces diagonal = m.plate.diagonal();
  CHECK((diagonal.reshaped() - K.diagonal()).norm() < 1e-13 * K.diagonal().norm());  // measured: 1e-16

  const State u = small_plate::random_state(m.points(), 13).cwiseAbs();
  Forces bound;
  m.plate.absolute_product(u, bound);
  const Eigen::VectorXd exact = K.cwiseAbs() * u.reshaped();
  CHECK((bound.reshaped() - exact).minCoeff() > -1e-12 * exact.maxCoeff());
  CHECK(bound.sum() < 2 * exact.sum());  // not needlessly wide. Measured: 1.08
}

TEST_CASE("rigid motions need no force, a free plate has no other such state") {
  const auto m = small_plate::model(geometry::rectangle(0, 0, 0.6, 0.5), {}, small_plate::spaced(0.1));
  Forces force;
  for (const Eigen::Vector3d& motion : {Eigen::Vector3d(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {3, -2, 5}}) {
    State u(3, m.points());
    for (Eigen::Index k = 0; k < u.cols(); ++k) {
      const auto& x = m.boundary.cloud.positions[std::size_t(k)];
      u.col(k) << motion[0] + motion[1] * x.x() + motion[2] * x.y(), motion[2], -motion[1];
    }
    m.plate.internal_force(u, force);
    CHECK(force.cwiseAbs().maxCoeff() < 1e-12);  // measured: 6e-14, forces of a unit deflection: 100
  }
  const Eigen::VectorXd lambda = dense::eigenvalues(small_plate::stiffness(m.plate));
  CHECK((lambda.array() < 1e-10 * lambda.maxCoeff()).count() == 3);
}

TEST_CASE("the same bits for any number of threads") {
  const auto m = varied();
  const State u = small_plate::random_state(m.points(), 14);
  const int before = omp_get_max_threads();
  Forces one, three;
  omp_set_num_threads(1);
  m.plate.internal_force(u, one);
  omp_set_num_threads(3);
  m.plate.internal_force(u, three);
  omp_set_num_threads(before);
  CHECK(one == three);
}
