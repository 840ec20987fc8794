#include "plate/edges/stiffness_rows.hpp"

#include "plate/edges/surface_plate.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;

namespace {

const Section thin_section{200, 0.25, 0.3};

Discretization lattice() {
  Discretization d;
  d.spacing = 0.5;
  return d;
}

/// Values of all nodes, fictitious ones too.
Eigen::VectorXd everywhere(const LatticeBody& b, double spacing,
                           const std::function<Eigen::Vector3d(double, double)>& f) {
  Eigen::VectorXd u(3 * b.count());
  for (int k = 0; k < b.count(); ++k) {
    const Eigen::Vector3d x = spacing * b.position(k);
    u.segment<3>(3 * k) = f(x.x(), x.y());
  }
  return u;
}

}  // namespace

TEST_CASE("actions of a surface plate: rigid motions cause none") {
  const auto bonds = lattice_bonds(thin_section, lattice());
  const auto b = box_body({5, 4}, bonds.reach);
  for (const auto rule : {FluxRule::lever, FluxRule::crossing_point}) {
    const auto a = actions(b, bonds, rule);
    const auto u = everywhere(b, 0.5, [](double x, double y) { return Eigen::Vector3d(1 + 2 * x - y, -1, -2); });
    const Eigen::VectorXd theta = a.dilatation * u;
    CHECK(theta.cwiseAbs().maxCoeff() < 1e-12);                                   // measured: 3e-16
    CHECK((a.of_values * u).cwiseAbs().maxCoeff() < 1e-10 * thin_section.young);  // measured: 3e-14
  }
}

TEST_CASE("actions of a surface plate: what goes in through the faces is what the real nodes are pulled with") {
  const auto bonds = lattice_bonds(thin_section, lattice());
  const auto b = box_body({5, 4}, bonds.reach);
  const auto a = actions(b, bonds, FluxRule::crossing_point);
  const auto u = everywhere(b, 0.5, [](double x, double y) { return Eigen::Vector3d(x * x * y, 0.3 * y * y, -x * y); });
  const Eigen::VectorXd f = a.of_values * u;
  double pulled = 0, through = 0, size = 0;
  for (int i = 0; i < int(f.size()); i += 3) {
    (i < 3 * b.real ? pulled : through) += (i < 3 * b.real ? -1 : 1) * f[i];
    size = std::max(size, std::abs(f[i]));
  }
  // bonds between fictitious nodes across corners pass through two faces, in and out again: once each
  CHECK(pulled == Approx(through).margin(1e-9 * size));
}

TEST_CASE("actions of a surface plate: constant bending is a moment through every face, and nothing inside") {
  auto d = lattice();
  d.volume_correction = VolumeCorrection::lattice_fitted;
  const auto bonds = lattice_bonds(thin_section, d);
  const auto b = box_body({5, 4}, bonds.reach);
  const double D = thin_section.bending_stiffness();
  for (const auto rule : {FluxRule::lever, FluxRule::crossing_point}) {
    const auto a = actions(b, bonds, rule);
    // psi = (x, 0): theta_y = -x
    const auto u = everywhere(b, 0.5, [](double x, double) { return Eigen::Vector3d(x * x / 2, 0, -x); });
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(b.count());  // dilatation of unit curvature: 2
    double dilatation = 0;
    for (const auto& bond : bonds.bonds) dilatation += bond.D * bond.length * bond.my * bond.my;
    const Eigen::VectorXd f = a.of_values * u + a.of_dilatation * (dilatation * one);
    CHECK(f.head(3 * b.real).cwiseAbs().maxCoeff() < 1e-11 * D);  // measured: 9e-15
    for (int s = 0; s < int(b.surface.size()); ++s) {
      const auto& face = b.surface[std::size_t(s)];
      const Eigen::Vector3d through = f.segment<3>(3 * (b.real + s)) / 0.5;
      // M_nn = -D on faces across x, -nu D on those across y
      const Eigen::Vector3d expected = face.axis == 0 ? Eigen::Vector3d(0, 0, -face.side * D)
                                                      : Eigen::Vector3d(0, face.side * thin_section.poisson * D, 0);
      CHECK((through - expected).norm() < 1e-10 * D);  // measured: 1e-14
    }
  }
}
