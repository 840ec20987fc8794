// Plates with fictitious nodes and multipliers: homogeneous states, edges held and loaded, against the local plate.

#include "plate/edges/boundary_conditions.hpp"
#include "plate/edges/multiplied_plate.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"
#include "tests/verification/boundary/local_plate.hpp"
#include "tests/verification/boundary/plate_bodies.hpp"

namespace bb = boundary_bodies;
using geometry::Point;
using plate::EdgeCondition;
using plate::SupportKind;

namespace {

const plate::Section section{1000, 0.3, 0.1};
constexpr double spacing = 0.1;

/// Curvatures psi_x,x; psi_y,y; psi_x,y = psi_y,x, and shear strains that are the same everywhere.
struct Homogeneous {
  double x, y, xy;
  Point shear;

  /// w, psi_x, psi_y.
  Eigen::Vector3d operator()(const Point& at) const {
    const Point psi(x * at.x() + xy * at.y(), xy * at.x() + y * at.y());
    return {psi.dot(at) / 2 + shear.dot(at), psi.x(), psi.y()};
  }
};

/// Values and section forces Q, M_nn, M_ns on an edge; of each pair one is given, by bits.
EdgeCondition condition(const Homogeneous& s, const bb::LatticeLaw& law, const Point& at, const Point& n,
                        unsigned held) {
  const Point along(-n.y(), n.x());
  const Eigen::Matrix2d M{{-law.D11 * s.x - law.D12 * s.y, -2 * law.D66 * s.xy},
                          {-2 * law.D66 * s.xy, -law.D12 * s.x - law.D11 * s.y}};
  const Eigen::Vector3d v = s(at);
  const Point psi = v.tail<2>();
  const double values[] = {v[0], psi.dot(n), psi.dot(along)},
               forces[] = {law.S * s.shear.dot(n), n.dot(M * n), along.dot(M * n)};
  EdgeCondition result{};
  for (unsigned i = 0; i < 3; ++i) {
    result.held[i] = held >> i & 1U;
    result.value[i] = result.held[i] ? values[i] : forces[i];
  }
  return result;
}

/// Bits of the left, right, lower and upper edge: w 1, psi_n 2, psi_s 4.
using Held = std::array<unsigned, 4>;

struct Found {
  Eigen::VectorXd values;
  double off, at_edges;  // at points, at edges, over the largest values
  double added;          // forces, over the moment of a curvature of 1 all round the plate
};

/// With no edge held, three unknowns of the first point.
Found patch(const plate::SurfacePlate& p, const bb::LatticeLaw& law, const Homogeneous& s, const Held& edges) {
  const auto on_edge = [&](const Point& at, const Point& n) {
    return condition(s, law, at, n, edges[n.x() < -0.5 ? 0 : n.x() > 0.5 ? 1 : n.y() < 0 ? 2 : 3]);
  };
  const auto load = [&](const Point&) {
    const Point Q = law.S * s.shear;
    return Eigen::Vector3d(0, -Q.y(), Q.x());  // theory (26)
  };
  auto problem = plate::edge_problem(p, on_edge, load);
  const Eigen::VectorXd exact = bb::at_unknowns(p, [&](const Point& at) { return s(at); });
  const Eigen::Index real = 3 * p.body.real, surface = exact.size() - real;
  std::vector<char> held(std::size_t(surface), false);
  for (const auto& one : problem.held) held[std::size_t(one.unknown - real)] = true;
  const auto made = plate::multiplied_plate(p, held);
  for (const int one : made.idle) problem.held.push_back({one, 0});
  if (edges == Held{0, 0, 0, 0})
    for (const Eigen::Index i : {0, 1, 2}) problem.held.push_back({i, exact[i]});
  Eigen::VectorXd right = Eigen::VectorXd::Zero(real + 2 * surface);
  right.head(exact.size()) = problem.right;
  Found found{edge_bodies::constrained_solution(made.stiffness, right, problem.held).values, 0, 0, 0};
  found.off = bb::off(p, found.values, [&](const Point& at) { return s(at); }).maxCoeff();
  found.added = plate::added_forces(made.stiffness, p, found.values, 1) / (4 * law.D11);
  found.at_edges =
      (found.values.segment(real, surface) - exact.tail(surface)).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
  return found;
}

const std::vector<Homogeneous> states{{1, 0, 0, {0, 0}}, {0, -1, 0, {0, 0}}, {0, 0, 1, {0, 0}}, {0, 0, 0, {0.3, -0.7}}};
const std::vector<Held> ways{{7, 7, 7, 7}, {7, 4, 2, 1}, {7, 0, 0, 0}, {5, 1, 5, 1}, {0, 0, 0, 0}};

/// A square 2 x 2 under pressure, held alike on all edges: deflection of the four points about the middle.
double in_the_middle(double thickness, SupportKind kind, double across) {
  plate::Discretization d;
  d.spacing = across, d.volume_correction = plate::VolumeCorrection::lattice_fitted;
  const auto p = edge_bodies::surface_plate({1000, 0.3, thickness}, d, {-1, -1}, {1, 1});
  const auto u = edge_bodies::multiplied_solution(
      p, [&](const Point&, const Point&) { return plate::edge_condition(kind); },
      [](const Point&) { return Eigen::Vector3d(1, 0, 0); });
  double sum = 0;
  int count = 0;
  for (int k = 0; k < p.body.real; ++k)
    if (p.at(k).cwiseAbs().maxCoeff() < 0.51 * across) sum += u[3 * k], ++count;
  return sum / count;
}

}  // namespace

TEST_CASE("multipliers: bending, twist and shear are exact, held, mixed and loaded on all edges, without multipliers") {
  const auto shares = bb::cell_shares(false);
  const auto law = bb::lattice_law(section, spacing, shares);
  const std::vector<std::pair<Point, Point>> rectangles{{{0, 0}, {1.2, 0.8}}, {{-0.02, 0.022}, {1.177, 0.84}}};
  double off = 0, at_edges = 0, added = 0;
  for (const auto& [low, high] : rectangles)
    for (const auto& s : states)
      for (const auto& held : ways) {
        const auto found = patch(bb::plate_of_shares(section, spacing, shares, low, high, {0, 0}), law, s, held);
        off = std::max(off, found.off), added = std::max(added, found.added);
        at_edges = std::max(at_edges, found.at_edges);
      }
  INFO(off << ' ' << at_edges << ' ' << added);
  CHECK(off < 1e-10);       // measured: 3.0e-12
  CHECK(at_edges < 1e-10);  // measured: 2.1e-12
  CHECK(added < 1e-9);      // measured: 3.0e-11
}

TEST_CASE("multipliers: a clamped and a hard supported square tend to the local plate with the square of the spacing") {
  for (const auto kind : {SupportKind::clamped, SupportKind::simply_supported_hard}) {
    const double exact = bb::RitzPlate({1000, 0.3, 0.1}, 2, 1, kind, kind, 7).deflection(0, 0);
    const double coarse = in_the_middle(0.1, kind, 0.1) / exact - 1, fine = in_the_middle(0.1, kind, 0.05) / exact - 1;
    INFO(coarse << ' ' << fine);
    CHECK(std::abs(fine) < 0.01);                  // measured: -0.0027, -0.0053
    CHECK(std::abs(coarse) > 4 * std::abs(fine));  // measured: 7.6, 5.1 times
  }
}
