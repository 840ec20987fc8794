// The stiffness as a matrix: no negative eigenvalue, no zero mode but the rigid motions.

#include "plate/formulation/constraints.hpp"
#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

/// Eigenvalues of diag(K)^(-1/2) K diag(K)^(-1/2), ascending: pure numbers in the order of 1.
Eigen::VectorXd scaled_eigenvalues(const Formulation& a) {
  const Eigen::Index size = 3 * vp::size(a);
  std::vector<Eigen::Index> free;
  for (Eigen::Index n = 0; n < size; ++n)
    if (!a.constraints().held(dof_by_points(n))) free.push_back(n);
  Eigen::MatrixXd K(free.size(), free.size());
  State unit = State::Zero(3, vp::size(a));
  for (std::size_t i = 0; i < free.size(); ++i) {
    unit.setZero();
    plate::at_dof(unit, plate::dof_by_points(free[i])) = 1;
    a.constraints().impose(unit);
    K.col(Eigen::Index(i)) = -vp::folded_force(a, unit).reshaped()(free);
  }
  const Eigen::VectorXd scale = K.diagonal().cwiseSqrt().cwiseInverse();
  K = scale.asDiagonal() * K * scale.asDiagonal();
  return dense::eigenvalues((K + K.transpose()) / 2);
}

/// `modes` eigenvalues are zero, all others above `least`.
void check_modes(const cases::Case& c, Eigen::Index modes, double least) {
  const Eigen::VectorXd lambda = scaled_eigenvalues(*vp::assembled(c));
  for (Eigen::Index i = 0; i < modes; ++i) CHECK(std::abs(lambda[i]) < 1e-12);  // measured: at most 1.9e-15
  CHECK(lambda[modes] > least);  // measured: at least 4e-4, by the size of the plate in spacings
}

}  // namespace

TEST_CASE("a free plate has three zero modes and no negative one: cracks, a hole, every correction") {
  for (const double nu : {-0.9, -0.5, 0.0, 0.3, 0.45, 0.499})
    for (const auto correction : vp::surface_corrections)
      for (const auto match : {TwistMatch::frame_invariant, TwistMatch::paper}) {
        auto c = vp::cracked_with_hole();
        c.section.poisson = nu;
        c.discretization.surface_correction = correction;
        c.discretization.twist_match = match;
        CAPTURE(nu, int(correction), int(match));
        check_modes(c, 3, 1e-4);
      }
}

TEST_CASE("a free plate without a crack has three zero modes for every horizon and influence") {
  for (const double ratio : {2.0, 3.015, 4.1})
    for (const auto kind : {Influence::inverse, Influence::constant}) {
      auto c = vp::free_plate(geometry::rectangle(0, 0, 1.1, 0.9), 0.1);
      c.discretization.horizon_ratio = ratio;
      c.discretization.influence = kind;
      CAPTURE(ratio, int(kind));
      check_modes(c, 3, 1e-4);
    }
}

TEST_CASE("every support leaves the zero modes that it should") {
  for (const auto& [kind, modes] : {std::pair{SupportKind::clamped, 0},
                                    {SupportKind::simply_supported, 1},
                                    {SupportKind::simply_supported_hard, 1},
                                    {SupportKind::symmetry, 2},
                                    {SupportKind::clamped_layer, 0},
                                    {SupportKind::simply_supported_layer, 0},
                                    {SupportKind::simply_supported_hard_layer, 0}}) {
    auto c = vp::cracked_with_hole();
    c.supports = {vp::held(kind, {"left"})};
    CAPTURE(int(kind));
    check_modes(c, modes, 1e-6);
  }
}

TEST_CASE("rigid motions need no force") {
  for (const auto correction : vp::surface_corrections) {
    auto c = vp::cracked_with_hole();
    c.discretization.surface_correction = correction;
    const auto a = vp::assembled(c);
    Forces force;
    a->internal_force(vp::random_state(*a, 34), force);
    const double scale = force.cwiseAbs().maxCoeff();
    for (const Eigen::Vector3d& motion : {Eigen::Vector3d(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {7, -2, 5}}) {
      const State u = vp::field(*a, [&](const geometry::Point& x) {
        return Eigen::Vector3d(motion[0] + motion[1] * x.x() + motion[2] * x.y(), motion[2], -motion[1]);
      });
      a->internal_force(u, force);
      CHECK(force.cwiseAbs().maxCoeff() < 1e-13 * u.cwiseAbs().maxCoeff() * scale);  // measured: 2e-16 of it
      CHECK(a->energies(u).cwiseAbs().sum() < 1e-26 * u.squaredNorm() * scale);      // measured: below 1e-18 in all
    }
  }
}
