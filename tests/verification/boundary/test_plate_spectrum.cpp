// What edges with surface nodes make of the frequencies of plates.

#include "plate/edges/surface_plate.hpp"
#include "tests/catch.hpp"
#include "tests/verification/boundary/plate_bodies.hpp"

namespace bb = boundary_bodies;
using geometry::Point;
using plate::ExpansionOrders;
using plate::FluxRule;
using plate::SupportKind;

namespace {

constexpr double horizon = 0.3;

plate::EdgeSpectrum of(double thickness, FluxRule rule, ExpansionOrders orders,
                       const std::function<SupportKind(const Point& n)>& kind) {
  const plate::Section section{1000, 0.3, thickness};
  auto p = bb::plate_of_shares(section, horizon / 3, bb::cell_shares(true), {0, 0}, {1.2, 0.8}, {0, 0});
  p.rule = rule, p.orders = orders;
  return plate::spectrum(
      p, [&](const Point&, const Point& n) { return plate::edge_condition(kind(n)); }, thickness);
}

/// Names of edge conditions and who has them.
struct Held {
  std::string name;
  std::function<SupportKind(const Point& n)> kind;
};
const std::vector<Held> all{
    {"free", [](const Point&) { return SupportKind::free; }},
    {"clamped", [](const Point&) { return SupportKind::clamped; }},
    {"soft", [](const Point&) { return SupportKind::simply_supported; }},
    {"hard", [](const Point&) { return SupportKind::simply_supported_hard; }},
    {"cantilever", [](const Point& n) { return n.x() < 0 ? SupportKind::clamped : SupportKind::free; }}};

}  // namespace

TEST_CASE("surface plate, frequencies: with the lever and orders (2, 1) no motion grows at rest, whatever the edges") {
  const std::vector<double> asymmetry[] = {{0.0054, 0.0486, 0.0064, 0.0001, 0.0350},   // horizon / thickness 0.3
                                           {0.0046, 0.3701, 0.0136, 0.0357, 0.1096}};  // 3
  for (const int thin : {0, 1})
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto s = of(thin ? horizon / 3 : horizon / 0.3, FluxRule::lever, {2, 1}, all[i].kind);
      INFO(all[i].name << (thin ? ", thin" : ", thick"));
      CHECK(s.lowest > -1e-13);  // measured: -1e-15, rigid motions
      CHECK(s.negative == 0);
      CHECK(s.asymmetry == Approx(asymmetry[thin][i]).margin(0.0002));
    }
}

TEST_CASE("surface plate, frequencies: the crossing point has motions that grow on free edges of thin plates") {
  const auto free = of(horizon / 3, FluxRule::crossing_point, {2, 1}, all[0].kind);
  CHECK(free.lowest == Approx(-0.2151).epsilon(0.001));
  CHECK(free.negative == 2);
  CHECK(of(horizon / 3, FluxRule::crossing_point, {2, 1}, all[4].kind).negative == 2);
  CHECK(of(horizon / 0.3, FluxRule::crossing_point, {2, 1}, all[0].kind).negative == 0);  // not of thick ones
}

TEST_CASE("surface plate, frequencies: orders (3, 2) have such motions in thin plates by either rule, unless free") {
  for (std::size_t i = 0; i < all.size(); ++i) {
    INFO(all[i].name);
    CHECK((of(horizon / 3, FluxRule::lever, {3, 2}, all[i].kind).negative > 0) == (i > 0));  // 0, 20, 3, 5, 4
    CHECK(of(horizon / 0.3, FluxRule::lever, {3, 2}, all[i].kind).negative == 0);
  }
}
