// Plates with notches and holes on surface nodes and fictitious nodes: homogeneous states, frequencies.

#include "plate/edges/boundary_conditions.hpp"
#include "plate/edges/multiplied_plate.hpp"
#include "plate/edges/surface_plate.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"
#include "tests/verification/boundary/plate_bodies.hpp"

namespace bb = boundary_bodies;
using geometry::Point;
using plate::EdgeCondition;
using plate::SupportKind;
using plate::SurfacePlate;

namespace {

constexpr double thickness = 0.1;
const plate::Section section{1000, 0.3, thickness};

/// 10 x 10 spacings of 0.1 less 5 x 5; edges `x`, `y` [spacings] off the lattice.
geometry::Outline ell(double x, double y) {
  const double a = 0.5 + 0.1 * x, b = 0.5 + 0.1 * y, c = 1 + 0.1 * y, d = 1 + 0.1 * x;
  return {{{{0, 0}, {c, 0}, {c, b}, {a, b}, {a, d}, {0, d}}, {"bottom", "right", "up", "beside", "top", "left"}}, {}};
}

/// 14 x 14 spacings with a hole of 6 x 6.
geometry::Outline holed(double x, double y) {
  auto outline = geometry::rectangle(0, 0, 1.4 + 0.1 * x, 1.4 + 0.1 * y);
  const double a = 0.4 + 0.1 * x, b = 0.4 + 0.1 * y, c = 1 - 0.1 * y, d = 1 - 0.1 * x;
  outline.holes.push_back(geometry::Polygon{{{a, b}, {c, b}, {c, d}, {a, d}}, {"low", "right", "up", "left"}});
  return outline;
}

SurfacePlate made(const geometry::Outline& outline, double h = thickness) {
  plate::Discretization d;
  d.spacing = 0.1, d.volume_correction = plate::VolumeCorrection::lattice_fitted;
  return plate::surface_plate({1000, 0.3, h}, d, outline);
}

/// Curvatures and shear strains that are the same everywhere.
struct Homogeneous {
  double x, y, xy;
  Point shear;

  Eigen::Vector3d operator()(const Point& at) const {
    const Point psi(x * at.x() + xy * at.y(), xy * at.x() + y * at.y());
    return {psi.dot(at) / 2 + shear.dot(at), psi.x(), psi.y()};
  }
};
const std::vector<Homogeneous> states{{1, 0, 0, {0, 0}}, {0, -1, 0, {0, 0}}, {0, 0, 1, {0, 0}}, {0, 0, 0, {0.3, -0.7}}};

/// Of the local plate; `held`: bits of w, psi_n, psi_s.
EdgeCondition condition(const Homogeneous& s, const Point& at, const Point& n, unsigned held) {
  const double D = section.bending_stiffness(), nu = section.poisson;
  const Point along(-n.y(), n.x());
  const Eigen::Matrix2d M{{-D * (s.x + nu * s.y), -D * (1 - nu) * s.xy}, {-D * (1 - nu) * s.xy, -D * (s.y + nu * s.x)}};
  const Eigen::Vector3d v = s(at);
  const Point psi = v.tail<2>();
  const double values[] = {v[0], psi.dot(n), psi.dot(along)},
               forces[] = {section.shear_stiffness() * s.shear.dot(n), n.dot(M * n), along.dot(M * n)};
  EdgeCondition result{};
  for (unsigned i = 0; i < 3; ++i) {
    result.held[i] = held >> i & 1U;
    result.value[i] = result.held[i] ? values[i] : forces[i];
  }
  return result;
}

/// Largest error of a state by surface nodes and by fictitious nodes; edges left, right, low, up hold by bits.
Eigen::Vector2d patch(const SurfacePlate& p, const Homogeneous& s, const std::array<unsigned, 4>& edges) {
  const auto on_edge = [&](const Point& at, const Point& n) {
    return condition(s, at, n, edges[n.x() < -0.5 ? 0 : n.x() > 0.5 ? 1 : n.y() < 0 ? 2 : 3]);
  };
  const Point Q = section.shear_stiffness() * s.shear;
  auto problem = plate::edge_problem(p, on_edge, [&](const Point&) { return Eigen::Vector3d(0, -Q.y(), Q.x()); });
  const auto field = [&](const Point& at) { return s(at); };
  const Eigen::VectorXd exact = bb::at_unknowns(p, field);
  const Eigen::Index real = 3 * p.body.real;
  std::vector<char> held(std::size_t(exact.size() - real), false);
  for (const auto& one : problem.held) held[std::size_t(one.unknown - real)] = true;
  if (problem.held.empty())
    for (const Eigen::Index i : {0, 1, 2}) problem.held.push_back({i, exact[i]});
  const auto multiplied = plate::multiplied_plate(p, held);
  auto all_held = problem.held;
  for (const int one : multiplied.idle) all_held.push_back({one, 0});
  Eigen::VectorXd right = Eigen::VectorXd::Zero(multiplied.stiffness.rows());
  right.head(exact.size()) = problem.right;
  const auto off = [&](const plate::SparseStiffness& K, const Eigen::VectorXd& load, const auto& known) {
    return bb::off(p, edge_bodies::constrained_solution(K, load, known).values, field).maxCoeff();
  };
  return {off(plate::stiffness(p), problem.right, problem.held), off(multiplied.stiffness, right, all_held)};
}

}  // namespace

TEST_CASE("surface plate, notches and holes: bending, twist and shear are exact, edges anywhere, multipliers too") {
  Eigen::Vector2d worst(0, 0);
  for (const auto& outline : {ell(0, 0), ell(0.3, 0.4), holed(0, 0), holed(0.3, 0.2)}) {
    const auto p = made(outline);
    for (const auto& s : states)
      for (const auto& edges : {std::array{7U, 7U, 7U, 7U}, std::array{7U, 4U, 2U, 1U}, std::array{0U, 0U, 0U, 0U}})
        worst = worst.cwiseMax(patch(p, s, edges));
  }
  INFO(worst.transpose());
  CHECK(worst.maxCoeff() < 1e-10);  // measured: 3.8e-11, 7.4e-12
}

TEST_CASE("surface plate, notches: no motion grows at rest, whatever the edges, within what the program accepts") {
  using enum SupportKind;
  double lowest = 1;
  const auto check = [&](const geometry::Outline& outline, double ratio, SupportKind kind) {
    const double h = 0.3 / ratio;
    const auto s = plate::spectrum(
        made(outline, h), [&](const Point&, const Point&) { return plate::edge_condition(kind); }, h);
    INFO(ratio << ' ' << int(kind) << ' ' << s.lowest << ' ' << s.asymmetry);
    CHECK(s.negative == 0);
    lowest = std::min(lowest, s.lowest);
  };
  for (const auto& outline : {ell(0, 0), ell(0.3, 0.4), ell(-0.1, -0.2)})
    for (const auto kind : {free, clamped, simply_supported, simply_supported_hard})
      for (const double ratio : {0.3, 2.0}) check(outline, ratio, kind);
  for (const auto kind : {free, clamped, simply_supported, simply_supported_hard}) check(ell(0, 0), 3, kind);
  CHECK(lowest > -1e-12);  // measured: -2e-15, rigid motions
}
