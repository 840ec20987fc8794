// Cracks oblique to the lattice, soft supports, pressure, against finite elements
// (cases/references/oblique_summary.csv).
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/plate_factors.hpp"
#include "tests/catch.hpp"
#include "tests/unit/geometry/random_plates.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

/// K1, K2, K3 of the tip in the first quadrant.
Eigen::Vector3d reference(int degrees) {
  std::ifstream file(PDPLATE_SOURCE_DIR "/cases/references/oblique_summary.csv");
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (row.size() > 11 && row[0] == "incl" + std::to_string(degrees) + "_ss" && row[1] == "pressure" &&
        row[6] == "c1+")
      return {std::stod(row[9]), std::stod(row[10]), std::stod(row[11])};
  }
  FAIL("no such row in oblique_summary.csv");
  return {};
}

/// What both formulations make of plates, as far as they go together.
struct Compared {
  double apart = 0.02;                     // of w
  std::size_t plates = 0, apart_in_w = 0;  // by more than that
  std::array<std::size_t, 2> refused{};    // by the Galerkin plate, by bonds alone
  std::size_t by_both = 0;                 // refused: parts that move freely, tips without room
  std::size_t factors = 0, resolved = 0, outside = 0,
              wrong = 0;  // of both tips; by both; beyond both estimates, beyond twice

  void add(cases::Case c) {
    std::array<std::vector<post::Srif>, 2> found;
    std::array<double, 2> w{};
    std::array<std::string, 2> why;
    ++plates;
    for (const auto* formulation : {&plate::galerkin, &plate::ordinary}) {
      c.discretization.formulation = formulation;
      const bool other = formulation == &plate::ordinary;
      try {
        const auto a = vp::assembled(c);
        const auto state = plate::static_solution(*a, c.analysis, {1e-8, 100000, {}}).solution.state;
        found[other] = post::srifs(*a, *c.srif, cases::tip_methods({c, {}}, *a), state);
        w[other] = state.row(0).cwiseAbs().maxCoeff();
      } catch (const cases::CaseError& error) {
        why[other] = error.what();
      }
    }
    if (why[0].empty() != why[1].empty()) ++refused[why[0].empty()];
    if (why[1].empty() && !why[0].empty())
      UNSCOPED_INFO("plate " << plates << " refused by the Galerkin plate: " << why[0]);
    if (!why[0].empty() && !why[1].empty()) ++by_both;
    if (!why[0].empty() || !why[1].empty()) return;
    if (std::abs(w[1] / w[0] - 1) > apart) ++apart_in_w;
    for (const auto& one : found[0]) {
      if (&one != &found[0].front() && (&one)[-1].tip == one.tip) continue;  // the recommended method alone
      const auto other = std::ranges::find(found[1], one.tip, &post::Srif::tip);
      if (other == found[1].end()) continue;
      const std::array K{one.K1 - other->K1, one.K2 - other->K2, one.K3 - other->K3};
      for (std::size_t i = 0; i < 3; ++i) {
        ++factors;
        if (!one.resolved[i] || !other->resolved[i]) continue;
        ++resolved;
        const double ratio = std::abs(K[i]) / (*one.errors[i] + *other->errors[i]);
        if (ratio > 1) ++outside;
        if (ratio > 2) {
          ++wrong;
          UNSCOPED_INFO("plate " << plates << " tip " << one.tip << " K" << i + 1 << " apart by " << K[i] << ", "
                                 << ratio << " times both estimates");
        }
      }
    }
  }

  std::string text() const {
    return std::to_string(plates) + " plates, " + std::to_string(by_both) + " refused by both, " +
           std::to_string(refused[0]) + " by the Galerkin plate, " + std::to_string(refused[1]) + " by bonds alone, " +
           std::to_string(apart_in_w) + " apart in w; " + std::to_string(factors) + " factors, " +
           std::to_string(resolved) + " resolved by both, " + std::to_string(outside) + " outside both estimates, " +
           std::to_string(wrong) + " twice that";
  }
};

cases::Case under_pressure(const geometry::Outline& outline, std::vector<geometry::Polyline> cracks, double thickness,
                           double spacing) {
  auto c = vp::free_plate(outline, spacing);
  c.section.thickness = thickness;
  c.analysis.kind = cases::Analysis::Kind::static_;
  c.cracks = std::move(cracks);
  c.supports = {vp::held(SupportKind::simply_supported, {"edge0", "edge2"})};
  c.srif.emplace();
  return c;
}

}  // namespace

TEST_CASE("oblique cracks: K1, K2, K3 of both tips in both formulations, and estimates that hold them") {
  for (const auto* formulation : {&plate::galerkin, &plate::ordinary})
    for (const int degrees : {10, 25, 40}) {
      auto c = vp::square(0.02);
      c.discretization.formulation = formulation;
      c.analysis.kind = cases::Analysis::Kind::static_;
      const double angle = degrees * std::numbers::pi / 180;
      const geometry::Point end(0.3 * std::cos(angle), 0.3 * std::sin(angle));
      c.cracks = {geometry::Polyline{geometry::Point(-end), end}};
      c.supports = {vp::held(SupportKind::simply_supported, {"bottom", "top"})};
      c.srif.emplace();
      const auto a = vp::assembled(c);
      const auto state = plate::static_solution(*a, c.analysis, {1e-8, 100000, {}}).solution.state;
      const Eigen::Vector3d exact = reference(degrees), scale(1, 1, c.section.thickness);
      const double largest = exact.cwiseProduct(scale).cwiseAbs().maxCoeff();
      std::size_t tip = 2;
      for (const auto& srif : post::srifs(*a, *c.srif, cases::tip_methods({c, {}}, *a), state)) {
        if (srif.tip == tip) continue;  // the recommended method alone
        tip = srif.tip;
        const Eigen::Vector3d error =
            (Eigen::Vector3d(srif.K1, srif.K2, srif.K3) - exact).cwiseProduct(scale).cwiseAbs();
        CAPTURE(formulation == &plate::galerkin, degrees, tip, srif.method, (error / largest).transpose());
        const bool galerkin = formulation == &plate::galerkin;
        CHECK(error[0] < (galerkin ? 0.006 : 0.02) * largest);   // measured: 0.5, 1.9 %
        CHECK(error[1] < (galerkin ? 0.002 : 0.007) * largest);  // measured: 0.11, 0.6 %
        // measured: 0.8 %; with bonds 2.8 %, and 8 % where the program says that it is not resolved
        if (srif.resolved[2]) CHECK(error[2] < (galerkin ? 0.01 : 0.035) * largest);
        if (galerkin) CHECK(srif.resolved == std::array{true, true, true});
        for (std::size_t i = 0; i < 3; ++i) {
          REQUIRE(srif.errors[i]);
          CHECK(error[Eigen::Index(i)] < *srif.errors[i] * scale[Eigen::Index(i)]);
        }
      }
    }
}

TEST_CASE("random polygons with a crack anywhere: both formulations agree within their estimates") {
  random_plates::Maker maker(15);
  Compared found{0.03};
  for (int n = 0; n < 10; ++n) {
    const geometry::Outline outline{maker.polygon({0, 0}, 0.95, 1.2, 5, "edge"), {}};
    const double angle = maker.uniform(0, std::numbers::pi), half = maker.uniform(0.2, 0.3);
    const geometry::Point middle(maker.uniform(-0.3, 0.3), maker.uniform(-0.3, 0.3)),
        way(std::cos(angle), std::sin(angle));
    found.add(under_pressure(outline, {{middle - half * way, middle + half * way}}, n % 2 ? 0.1 : 0.2, 0.02));
  }
  INFO(found.text());
  CHECK(found.refused == std::array<std::size_t, 2>{});
  CHECK(found.apart_in_w == 0);
  CHECK(found.resolved > found.factors / 4);
  CHECK(20 * found.outside <= found.resolved);
  CHECK(found.wrong == 0);
}

// Some minutes: build/tests/tests_verification "five hundred*"
TEST_CASE(
    "five hundred random plates with holes and one to three cracks: both formulations agree, or one says that it does "
    "not know",
    "[.]") {
  random_plates::Maker maker(500);
  Compared found;
  while (found.plates < 500) {
    const auto plate = maker.plate();
    if (plate.cracks.empty() || plate.outline.outer.vertices.size() < 3) continue;
    found.add(under_pressure(plate.outline, plate.cracks, found.plates % 2 ? 0.1 : 0.2, 0.02));
  }
  WARN(found.text());                           // in w bonds say themselves that they are off
  CHECK(20 * found.refused[0] < found.plates);  // where a ligament narrower than a spacing holds a part
  CHECK(20 * found.outside <= found.resolved);
  CHECK(100 * found.wrong <= found.resolved);
}
