#include "plate/edges/surface_plate.hpp"

#include "plate/edges/boundary_conditions.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;
using geometry::Point;

namespace {

constexpr double size = 1.2;

/// Sum of what holds a square under pressure along w, over the load, by crossing points alone and with what free edges
/// leave over.
struct Sums {
  double crossed, assigned;
};
Sums sums(const std::function<SupportKind(const Point& n)>& kind) {
  Discretization d;
  d.spacing = 0.1;
  const SurfacePlate p = surface_plate({1000, 0.3, 0.2}, d, {0, 0}, {size, size});
  const auto [right, held] = edge_problem(
      p, [&](const Point&, const Point& n) { return edge_condition(kind(n)); },
      [](const Point&) { return Eigen::Vector3d(1, 0, 0); });
  const auto K = stiffness(p);
  const auto u = constrained_solution(K, right, held).values;
  std::vector<char> is_held(std::size_t(p.unknowns()), false);
  for (const auto& one : held) is_held[std::size_t(one.unknown)] = true;
  SurfacePlate by_crossings = p;
  by_crossings.rule = FluxRule::crossing_point;
  const StiffnessRows crossed = stiffness(by_crossings);
  const auto rows = rows_with_reactions(p, K, crossed, [&](int i) { return bool(is_held[std::size_t(i)]); });
  Sums result{0, 0};
  for (const auto& one : held)
    if (one.unknown % 3 == 0) {
      result.crossed -= crossed.row(one.unknown).dot(u) / (size * size);
      result.assigned -= rows.row(one.unknown).dot(u) / (size * size);
    }
  for (int i = 0; i < p.unknowns(); ++i)
    if (!is_held[std::size_t(i)]) CHECK((rows.row(i) - StiffnessRows(K).row(i)).norm() == 0);
  return result;
}

}  // namespace

TEST_CASE("rows with reactions: between free edges reactions are the load, but for corners of two free edges") {
  using enum SupportKind;
  const auto strip = sums([](const Point& n) { return std::abs(n.x()) > 0.5 ? clamped : free; });
  CHECK(std::abs(strip.assigned - 1) < 1e-9);  // measured: 1e-14
  CHECK(std::abs(strip.crossed - 1) > 0.005);  // measured: 0.0102
  const auto cantilever = sums([](const Point& n) { return n.x() < -0.5 ? clamped : free; });
  CHECK(std::abs(cantilever.assigned - 1) < 0.01);  // measured: 0.0034
  CHECK(std::abs(cantilever.crossed - 1) > 0.02);   // measured: 0.0423
  const auto all = sums([](const Point&) { return simply_supported; });
  CHECK(all.assigned == Approx(1).epsilon(1e-12));
}
