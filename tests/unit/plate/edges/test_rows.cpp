#include "plate/edges/stiffness_rows.hpp"

#include "geometry/lattice/cloud.hpp"
#include "plate/edges/surface_plate.hpp"
#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

namespace {

const Section row_section{1000, 0.3, 0.2};

/// A square of `side` turned by an angle with the tangent 3 / 4.
geometry::Outline turned(double side) {
  geometry::Outline result;
  for (const Point& x : {Point(0, 0), Point(side, 0), Point(side, side), Point(0, side)})
    result.outer.vertices.push_back({0.8 * x.x() - 0.6 * x.y(), 0.6 * x.x() + 0.8 * x.y()});
  return result;
}

SurfacePlate made(const geometry::Outline& outline) {
  Discretization d;
  d.spacing = 0.1, d.volume_correction = VolumeCorrection::lattice_fitted;
  return surface_plate(row_section, d, outline);
}

Eigen::VectorXd values(const SurfacePlate& p, const std::function<Eigen::Vector3d(const Point&)>& field) {
  Eigen::VectorXd result(p.unknowns());
  for (int k = 0; k < p.unknowns() / 3; ++k)
    result.segment<3>(3 * k) = field(k < p.body.real ? p.at(k) : p.at_surface(k - p.body.real));
  return result;
}

}  // namespace

TEST_CASE("oblique rows: section forces of bending about an axis, of twist and of shear, times lengths") {
  const auto p = made(turned(1));
  const WeightRows rows = section_force_rows(p.body, *p.oblique, row_section, 0.1);
  const double D = row_section.bending_stiffness(), S = row_section.shear_stiffness();
  // psi = (x, 0), w = x^2 / 2: M_xx = -D, M_yy = -nu D; psi = (y, x), w = x y: M_xy = -(1 - nu) D; w = x: Q_x = S
  const Eigen::VectorXd bent = rows *
                               values(p, [](const Point&x) { return Eigen::Vector3d(x.x() * x.x() / 2, 0, -x.x()); }),
                        twisted =
                            rows *
                            values(p, [](const Point&x) { return Eigen::Vector3d(x.x() * x.y(), x.x(), -x.y()); }),
                        sheared = rows * values(p, [](const Point&x) { return Eigen::Vector3d(x.x(), 0, 0); });
  double off = 0;
  for (int s = 0; s < p.surfaces(); ++s) {
    const Point n = p.normal(s);
    const double length = p.length(s);
    const Point of_bent(-D * n.x(), -0.3 * D * n.y()), of_twisted(-0.7 * D * n.y(), -0.7 * D * n.x());
    const auto couples = [](const Point& m) { return Eigen::Vector3d(0, -m.y(), m.x()); };
    off = std::max({off, (bent.segment<3>(3 * s) / length - couples(of_bent)).norm() / D,
                    (twisted.segment<3>(3 * s) / length - couples(of_twisted)).norm() / D,
                    std::abs(sheared[3 * s] / length - S * n.x()) / S});
  }
  CHECK(off < 1e-10);  // measured: below 1e-11
}

TEST_CASE("oblique rows: what bonds beyond the edges do balances what all bonds do to the points") {
  const auto p = made(turned(1));
  const std::vector<PrescribedOfNode> clamped(std::size_t(p.surfaces()), {true, true, true});
  const auto K = oblique_stiffness(p.body, p.bonds, p.cuts, *p.oblique, row_section, clamped);
  const Eigen::VectorXd any = Eigen::VectorXd::Random(p.unknowns()), force = K * any;
  Eigen::Vector3d sum(0, 0, 0);  // about the origin
  double size = 0;
  for (int k = 0; k < p.unknowns() / 3; ++k) {
    const bool real = k < p.body.real;
    const Point at = real ? p.at(k) : p.at_surface(k - p.body.real);
    const Eigen::Vector3d f = force.segment<3>(3 * k);
    sum += f + f[0] * Eigen::Vector3d(0, at.y(), -at.x());
    size += f.norm();
  }
  CHECK(sum.norm() < 1e-12 * size);
}

TEST_CASE("oblique rows: a rotation that is held alone is a row of the stiffness") {
  const auto p = made(turned(1));
  const std::vector<PrescribedOfNode> hard(std::size_t(p.surfaces()), {true, false, true});
  const auto K = oblique_stiffness(p.body, p.bonds, p.cuts, *p.oblique, row_section, hard);
  const Eigen::VectorXd any = Eigen::VectorXd::Random(p.unknowns()), forces = K * any;
  for (int s = 0; s < p.surfaces(); ++s) {
    const Point second = turning_directions(p.normal(s))[1];
    const int row = 3 * (p.body.real + s) + 1;
    CHECK(second.dot(forces.segment<2>(row)) ==
          Approx(row_section.bending_stiffness() * second.dot(any.segment<2>(row))).margin(1e-9));
  }
}

TEST_CASE("oblique rows: corners too sharp for edges that are not clamped are refused") {
  geometry::Outline triangle;
  triangle.outer.vertices = {{-0.9, -0.54}, {0.9, -0.36}, {-0.18, 0.81}};
  const auto p = made(triangle);
  const auto count = std::size_t(p.surfaces());
  const auto stiffness = [&](const PrescribedOfNode& held) {
    return oblique_stiffness(p.body, p.bonds, p.cuts, *p.oblique, row_section, std::vector(count, held));
  };
  CHECK(stiffness({true, true, true}).nonZeros() > 0);
  CHECK_THROWS_AS(stiffness({false, false, false}), Refused);
}
