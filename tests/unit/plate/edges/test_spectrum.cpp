#include "plate/edges/surface_plate.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;
using geometry::Point;

namespace {

EdgeSpectrum of(SupportKind kind, FluxRule rule) {
  Discretization d;
  d.spacing = 0.1;
  auto p = surface_plate({1000, 0.3, 0.1}, d, {0, 0}, {0.8, 0.6});
  p.rule = rule;
  return spectrum(
      p, [&](const Point&, const Point&) { return edge_condition(kind); }, 0.1);
}

}  // namespace

TEST_CASE("spectrum of a surface plate: three rigid motions of a free one, which are rounding") {
  const auto free = of(SupportKind::free, FluxRule::lever);
  CHECK(std::abs(free.lowest) < 1e-13);  // measured: 4e-16
  CHECK(free.negative == 0);
  CHECK(free.asymmetry < 0.2);  // measured: 0.049
}

TEST_CASE("spectrum of a surface plate: a clamped one resists every motion, but is not symmetric") {
  const auto clamped = of(SupportKind::clamped, FluxRule::lever);
  CHECK(clamped.lowest > 1e-3);    // measured: 0.015
  CHECK(clamped.asymmetry > 0.1);  // measured: 0.36
}

TEST_CASE("spectrum of a surface plate: shares by crossing points have motions that grow on free edges") {
  const auto free = of(SupportKind::free, FluxRule::crossing_point);
  CHECK(free.negative > 0);
  CHECK(free.lowest < -0.1);  // measured: -0.27
}
