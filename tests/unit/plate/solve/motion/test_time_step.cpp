#include "plate/bonds/rows/lattice_operator.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using small_plate::section;

namespace {

small_plate::Model model(const std::vector<Support>& supports, double width = 0.8) {
  return small_plate::model(geometry::rectangle(0, 0, width, 0.6), supports, small_plate::spaced(0.1));
}

small_plate::Model held_plate_of_step() {
  using enum SupportKind;
  return model({{clamped, {"left"}, {}}, {simply_supported, {"right"}, {}}});
}

Forces mass_of(const small_plate::Model& m) {
  return mass(section, m.boundary.cloud.areas, m.boundary.active, m.boundary.constraints);
}

/// Largest eigenvalue of M^-1 K on the free degrees of freedom, dense.
double largest_square(const small_plate::Model& m) {
  const Eigen::MatrixXd K = small_plate::stiffness(m.plate);
  const Eigen::MatrixXd P = small_plate::prolongation(m.boundary.constraints, K.rows());
  Eigen::VectorXd lumped = Eigen::VectorXd::Zero(K.rows());
  const double h = section.thickness;
  for (std::size_t k = 0; k < m.boundary.cloud.plate_points; ++k) {
    const double translation = section.density * h * m.boundary.cloud.areas[k];
    lumped.segment<3>(Eigen::Index(3 * k)) << translation, translation * h * h / 12, translation * h * h / 12;
  }
  const Eigen::VectorXd M = P.cwiseAbs2().transpose() * lumped;
  const Eigen::VectorXd root = M.cwiseSqrt().cwiseInverse();
  return dense::eigenvalues(dense::scaled(dense::folded(K, P), root)).maxCoeff();
}

}  // namespace

TEST_CASE("the stable step is below 2 / omega_max of the dense matrix, and not by much") {
  using enum SupportKind;
  const auto supports =
      GENERATE(std::vector<Support>{}, std::vector<Support>{{clamped, {"left"}, {}}, {simply_supported, {"right"}, {}}},
               std::vector<Support>{{clamped_layer, {"left", "top"}, {}}});
  const auto m = model(supports, 0.4);
  const double step = stable_time_step(m.plate, m.boundary.constraints, mass_of(m));
  const double limit = 2 / std::sqrt(largest_square(m));
  CHECK(step <= limit * (1 + 1e-12));
  CHECK(step >= 0.98 * limit);  // measured: 0.995, the margin
}

TEST_CASE("rotary inertia: a factor for the rotations alone, and a longer step for a thin plate") {
  const auto m = held_plate_of_step();
  const auto& b = m.boundary;
  const Forces one = mass_of(m), ten = mass(section, b.cloud.areas, b.active, b.constraints, 10);
  CHECK(ten.row(0) == one.row(0));
  CHECK((ten.bottomRows<2>() - 10 * one.bottomRows<2>()).norm() < 1e-15 * ten.norm());
  CHECK(stable_time_step(m.plate, b.constraints, ten) > 1.5 * stable_time_step(m.plate, b.constraints, one));
}
