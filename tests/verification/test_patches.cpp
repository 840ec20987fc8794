// Patch tests inside the plate: fields of constant curvature and of constant shear store the classical energy.

#include "geometry/lattice/cloud.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

constexpr double ratio = 3.015;

/// Curvatures kx, ky, twist kxy = w,xy and slopes of w without rotation: the parts of a patch field.
struct Patch {
  double kx, ky, kxy, gx, gy;
};

/// w = -(kx x^2 + ky y^2) / 2 - kxy x y with the rotations of the normal, and w = gx x + gy y without.
State field(const Formulation& a, const Patch& p) {
  return vp::field(a, [&](const geometry::Point& x) {
    const double slope_x = p.kx * x.x() + p.kxy * x.y(), slope_y = p.ky * x.y() + p.kxy * x.x();
    const double w = (slope_x * x.x() + slope_y * x.y()) / 2;
    return Eigen::Vector3d(w + p.gx * x.x() + p.gy * x.y(), slope_y, -slope_x);
  });
}

/// The classical energy per area with the plate's own D11, D12, D66 relative to D and D (1 - nu) / 2.
double classical(const Patch& p, const Section& s, double d11 = 1, double d12 = 1, double d66 = 1) {
  const double nu = s.poisson, D = s.bending_stiffness();
  return D / 2 * (d11 * (p.kx * p.kx + p.ky * p.ky) + 2 * nu * d12 * p.kx * p.ky + 2 * (1 - nu) * d66 * p.kxy * p.kxy) +
         s.shear_stiffness() / 2 * (p.gx * p.gx + p.gy * p.gy);
}

/// Points with all neighbours, whose neighbours have all of theirs.
std::vector<std::size_t> inner_points(const Formulation& a, double horizon) {
  std::vector<std::size_t> inner;
  for (std::size_t k = 0; k < a.cloud().size(); ++k)
    if (a.cloud().positions[k].cwiseAbs().maxCoeff() < 1 - 2 * horizon) inner.push_back(k);
  REQUIRE(inner.size() >= 9);
  return inner;
}

/// Largest relative deviation of the energy per area from `expected` over the inner points.
double energy_error(const Formulation& a, const Discretization& d, const Patch& p, double expected) {
  const Eigen::VectorXd energies = a.energies(field(a, p));
  double worst = 0;
  for (const auto k : inner_points(a, d.horizon()))
    worst = std::max(worst, std::abs(energies[Eigen::Index(k)] / a.cloud().areas[k] / expected - 1));
  return worst;
}

cases::Case plate_with(VolumeCorrection volume, double horizon_ratio = ratio) {
  auto c = vp::square(horizon_ratio > 4.5 ? 0.08 : 0.1);
  c.discretization.volume_correction = volume;
  c.discretization.horizon_ratio = horizon_ratio;
  return c;
}

/// A = I4 / (3 I22) of the lattice, I4 = sum omega xi^2 c^4 beta, I22 = sum omega xi^2 c^2 s^2 beta, spacing 1,
/// with the linear volume correction.
double lattice_anisotropy(double m) {
  double fourth = 0, mixed = 0;
  for (int x = -9; x <= 9; ++x)
    for (int y = -9; y <= 9; ++y) {
      const double r = std::hypot(x, y);
      if (r == 0 || r > m) continue;
      const double weight = m / r * std::min(1.0, m + 0.5 - r) / (r * r);
      fourth += weight * std::pow(x, 4);
      mixed += weight * x * x * y * y;
    }
  return fourth / (3 * mixed);
}

const std::vector<Patch> curvatures{{1, 0, 0, 0, 0}, {0, 1, 0, 0, 0}, {0, 0, 1, 0, 0}};
const std::vector<Patch> shears{{0, 0, 0, 1, 0}, {0, 0, 0, 0, 1}};
const std::vector<Patch> isotropic{{1, 1, 0, 0, 0}, {-2, -2, 0, 0, 0}};
const std::vector<Patch> mixed{{0.7, -0.4, 0.3, 0, 0}};

}  // namespace

TEST_CASE("lattice-fitted volumes: constant curvatures and shears store the classical energy") {
  for (const double m : {2.015, 3.015, 4.1, 5.3})
    for (const double nu : {-0.3, 0.0, 0.3, 0.45}) {
      auto c = plate_with(VolumeCorrection::lattice_fitted, m);
      c.section.poisson = nu;
      const auto a = vp::assembled(c);
      CAPTURE(m, nu);
      for (const auto& list : {curvatures, shears, isotropic, mixed})
        for (const Patch& p : list)
          CHECK(energy_error(*a, c.discretization, p, classical(p, c.section)) < 1e-11);  // measured: 9e-15
    }
}

TEST_CASE("lattice sums for the constants of a full family give the same inside the plate") {
  for (const auto correction : vp::surface_corrections) {
    auto c = plate_with(VolumeCorrection::lattice_fitted);
    c.discretization.full_horizon = FullHorizon::lattice;
    c.discretization.surface_correction = correction;
    const auto a = vp::assembled(c);
    for (const auto& list : {curvatures, shears})
      for (const Patch& p : list)
        CHECK(energy_error(*a, c.discretization, p, classical(p, c.section)) < 1e-11);  // measured: 8e-16
  }
}

TEST_CASE("linear volumes: shear and bending in all directions exact, the rest by the lattice's anisotropy") {
  CHECK(lattice_anisotropy(3.015) == Approx(0.99321).epsilon(1e-5));  // measured: 5e-8 off
  for (const double m : {3.015, 4.1, 5.3})
    for (const auto match : {TwistMatch::frame_invariant, TwistMatch::paper}) {
      auto c = plate_with(VolumeCorrection::linear, m);
      c.discretization.surface_correction = SurfaceCorrection::arbitrary_horizon;
      c.discretization.twist_match = match;
      const auto a = vp::assembled(c);
      const double nu = c.section.poisson, A = lattice_anisotropy(m);
      // paper: b_b from I22; frame-invariant: from (I4 + I22) / 4 = (3 A + 1) I22 / 4
      const double scale = match == TwistMatch::paper ? 1 : 4 / (3 * A + 1);
      const double excess = (1 - nu) * (match == TwistMatch::paper ? 0.75 * (A - 1) : 1.5 * (A * scale - 1));
      CAPTURE(m, int(match), A, excess);
      for (const auto& list : {shears, isotropic})
        for (const Patch& p : list)
          CHECK(energy_error(*a, c.discretization, p, classical(p, c.section)) < 1e-11);  // measured: 8e-16
      for (const Patch& p : curvatures) {
        const double expected = classical(p, c.section, 1 + excess, 1 - excess / nu, scale);
        CHECK(energy_error(*a, c.discretization, p, expected) < 1e-11);  // measured: 8e-16
      }
    }
}

TEST_CASE("constant curvature: no force inside the plate, constant shear: the couples of equilibrium") {
  for (const auto volume : {VolumeCorrection::linear, VolumeCorrection::lattice_fitted}) {
    const auto c = plate_with(volume);
    const auto a = vp::assembled(c);
    Forces force;
    for (const Patch& p : curvatures) {
      a->internal_force(field(*a, p), force);
      const double outside = force.cwiseAbs().maxCoeff();
      for (const auto k : inner_points(*a, c.discretization.horizon()))
        REQUIRE(force.col(Eigen::Index(k)).cwiseAbs().maxCoeff() < 1e-10 * outside);  // measured: 2e-16
    }
    for (const Patch& p : shears) {
      a->internal_force(field(*a, p), force);
      for (const auto k : inner_points(*a, c.discretization.horizon())) {
        // dU/d(theta_y) = Qx A, dU/d(theta_x) = -Qy A
        const Eigen::Vector3d couple =
            Eigen::Vector3d(0, p.gy, -p.gx) * c.section.shear_stiffness() * a->cloud().areas[k];
        REQUIRE((force.col(Eigen::Index(k)) - couple).norm() < 1e-11 * couple.norm());  // measured: 1e-15
      }
    }
  }
}
