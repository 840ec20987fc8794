// Surface nodes on edges in any direction and on round holes: homogeneous states, frequencies, deflections.

#include <Eigen/Geometry>
#include "geometry/lattice/cloud.hpp"
#include "plate/edges/boundary_conditions.hpp"
#include "plate/edges/surface_plate.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using geometry::Outline;
using geometry::Point;
using plate::EdgeCondition;
using plate::SupportKind;
using plate::SurfacePlate;

namespace {

/// Corners turned about the origin.
Outline turned(const std::vector<Point>& corners, double degrees) {
  const Eigen::Rotation2Dd turn(degrees * 3.141592653589793 / 180);
  Outline result;
  for (const auto& x : corners) result.outer.vertices.push_back(turn * x);
  return result;
}
const std::vector<Point> square{{-0.45, -0.45}, {0.45, -0.45}, {0.45, 0.45}, {-0.45, 0.45}},
    ell{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0}, {0, 0}, {0, 0.5}, {-0.5, 0.5}};

Outline holed() {
  Outline result = geometry::rectangle(-0.81, -0.81, 0.81, 0.81);
  result.holes.push_back(geometry::Circle{{0.02, 0.01}, 0.33, "round"});
  return result;
}

Outline polygon(int edges) {
  std::vector<Point> corners;
  for (int i = 0; i < edges; ++i) {
    const double angle = 2 * 3.141592653589793 * i / edges;
    corners.push_back({0.5 * std::cos(angle), 0.5 * std::sin(angle)});
  }
  return turned(corners, 6);
}

SurfacePlate made(const Outline& outline, double h, double spacing = 0.1) {
  plate::Discretization d;
  d.spacing = spacing, d.volume_correction = plate::VolumeCorrection::lattice_fitted;
  return plate::surface_plate({1000, 0.3, h}, d, outline);
}

/// Curvatures and shear strains that are the same everywhere.
struct Homogeneous {
  double x, y, xy;
  Point shear;

  Eigen::Vector3d operator()(const Point& at) const {  // w, theta_x, theta_y
    const Point psi(x * at.x() + xy * at.y(), xy * at.x() + y * at.y());
    return {psi.dot(at) / 2 + shear.dot(at), psi.y(), -psi.x()};
  }
};

/// Largest error of real and surface nodes; `held`: bits of w, psi_n, psi_s, by the quarter into which the normal
/// points.
double patch(const SurfacePlate& p, const plate::Section& section, const Homogeneous& s,
             const std::array<unsigned, 4>& held) {
  const double D = section.bending_stiffness(), nu = section.poisson, S = section.shear_stiffness();
  const Eigen::Matrix2d M{{-D * (s.x + nu * s.y), -D * (1 - nu) * s.xy}, {-D * (1 - nu) * s.xy, -D * (s.y + nu * s.x)}};
  const auto condition = [&](const Point& at, const Point& n) {
    const Point along(-n.y(), n.x());
    const Eigen::Vector3d v = s(at);
    const Point psi(-v[2], v[1]);
    const double values[] = {v[0], psi.dot(n), psi.dot(along)},
                 forces[] = {S * s.shear.dot(n), n.dot(M * n), along.dot(M * n)};
    const unsigned bits = held[std::size_t(2 * (n.y() > 0) + (n.x() > 0))];
    EdgeCondition result{};
    for (unsigned i = 0; i < 3; ++i) {
      result.held[i] = bits >> i & 1U;
      result.value[i] = result.held[i] ? values[i] : forces[i];
    }
    return result;
  };
  const Point Q = S * s.shear;
  auto problem = plate::edge_problem(p, condition, [&](const Point&) { return Eigen::Vector3d(0, -Q.y(), Q.x()); });
  Eigen::VectorXd exact(p.unknowns());
  for (int k = 0; k < p.unknowns() / 3; ++k)
    exact.segment<3>(3 * k) = s(k < p.body.real ? p.at(k) : p.at_surface(k - p.body.real));
  if (problem.held.empty())
    for (const Eigen::Index i : {0, 1, 2}) problem.held.push_back({i, exact[i]});
  const auto found =
      edge_bodies::constrained_solution(plate::stiffness_under(p, condition), problem.right, problem.held);
  return (found.values - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("surface plate, oblique edges: bending, twist and shear are exact, held, mixed and loaded") {
  const std::vector<Homogeneous> states{{1, -0.6, 0.4, {0.3, -0.7}}, {0, 0, 1, {0, 0}}};
  double worst = 0;
  for (const auto& outline : {turned(square, 45), turned(square, 17.3), turned(ell, 26.565), holed(), polygon(20)}) {
    const auto p = made(outline, 0.3);
    for (const auto& s : states)
      for (const auto& held : {std::array{7U, 7U, 7U, 7U}, std::array{7U, 5U, 2U, 1U}, std::array{0U, 0U, 0U, 0U}})
        worst = std::max(worst, patch(p, {1000, 0.3, 0.3}, s, held));
  }
  INFO(worst);
  CHECK(worst < 1e-9);  // measured: 2.1e-12
}

TEST_CASE("surface plate, oblique edges: no motion grows at rest within what the program accepts") {
  using enum SupportKind;
  double lowest = 1;
  for (const auto& outline : {turned(square, 22), turned(ell, 17.3), polygon(20)})
    for (const auto& [held, ratio] : {std::pair{free, 0.3},
                                      {free, 1.0},
                                      {clamped, 0.3},
                                      {clamped, 3.0},
                                      {simply_supported, 0.3},
                                      {simply_supported, 2.0},
                                      {simply_supported_hard, 0.3},
                                      {simply_supported_hard, 3.0}}) {
      const auto kind = held;
      const double h = 0.3 / ratio;
      const auto s = plate::spectrum(
          made(outline, h), [&](const Point&, const Point&) { return plate::edge_condition(kind); }, h);
      INFO(ratio << ' ' << int(kind) << ' ' << s.lowest << ' ' << s.asymmetry);
      CHECK(s.negative == 0);
      lowest = std::min(lowest, s.lowest);
    }
  INFO(lowest);
  CHECK(lowest > -1e-12);  // measured: -1e-15, rigid motions
}

TEST_CASE("surface plate, oblique edges: free edges of thin plates have motions that grow") {
  int negative = 0;
  for (const double degrees : {22.0, 31.0})
    negative += plate::spectrum(
                    made(turned(ell, degrees), 0.1),
                    [](const Point&, const Point&) { return plate::edge_condition(SupportKind::free); }, 0.1)
                    .negative;
  CHECK(negative > 0);
}

TEST_CASE("surface plate, oblique edges: deflection of a turned square under pressure, clamped and hard supported") {
  struct Row {
    double degrees, spacing;
    SupportKind kind;
    double error;  // percent
  };
  const double tangent = 36.86989764584402;  // 3 / 4
  for (const auto& [degrees, spacing, kind, error] :
       {Row{tangent, 2.8 / 27, SupportKind::clamped, 0.8337}, Row{tangent, 2.8 / 41, SupportKind::clamped, 0.6081},
        Row{tangent, 2.8 / 55, SupportKind::clamped, 0.3936},
        Row{tangent, 2.8 / 55, SupportKind::simply_supported_hard, -0.8547}}) {
    const auto p = made(turned({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, degrees), 0.1, spacing);
    const auto held = kind;
    const auto found = edge_bodies::solution(
        p, [&](const Point&, const Point&) { return plate::edge_condition(held); },
        [](const Point&) { return Eigen::Vector3d(1, 0, 0); });
    int centre = 0;
    for (int k = 1; k < p.body.real; ++k)
      if (p.at(k).norm() < p.at(centre).norm()) centre = k;
    REQUIRE(p.at(centre).norm() < 1e-9);
    const double D = plate::Section{1000, 0.3, 0.1}.bending_stiffness();
    const double local = (held == SupportKind::clamped ? 1.32726e-3 : 4.11497e-3) * 16 / D;  // Ritz, Navier
    CHECK(100 * (found.values[3 * centre] / local - 1) == Approx(error).margin(0.01));
  }
}
