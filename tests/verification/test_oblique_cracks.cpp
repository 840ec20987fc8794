// Cracks oblique to the lattice, soft supports, pressure, against finite elements (cases/references/oblique_summary.csv).
#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "cases/results.hpp"
#include "cases/static_solution.hpp"
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
    if (row.size() > 11 && row[0] == "incl" + std::to_string(degrees) + "_ss" && row[1] == "pressure" && row[6] == "c1+")
      return {std::stod(row[9]), std::stod(row[10]), std::stod(row[11])};
  }
  FAIL("no such row in oblique_summary.csv");
  return {};
}

}  // namespace

TEST_CASE("oblique cracks: K1, K2, K3 of both tips in both formulations, and estimates that hold them") {
  for (const auto formulation : {Formulation::galerkin, Formulation::ordinary})
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
      const auto state = cases::solve_at_rest(c, a, {1e-8, 100000, {}}).solution.state;
      const Eigen::Vector3d exact = reference(degrees), scale(1, 1, c.section.thickness);
      const double largest = exact.cwiseProduct(scale).cwiseAbs().maxCoeff();
      std::size_t tip = 2;
      for (const auto& srif : cases::srifs(c, a, cases::tip_methods({c, {}}, a), state)) {
        if (srif.tip == tip) continue;  // the recommended method alone
        tip = srif.tip;
        const Eigen::Vector3d error = (Eigen::Vector3d(srif.K1, srif.K2, srif.K3) - exact).cwiseProduct(scale).cwiseAbs();
        CAPTURE(formulation == Formulation::galerkin, degrees, tip, srif.method, (error / largest).transpose());
        const bool galerkin = formulation == Formulation::galerkin;
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
  std::size_t compared = 0, resolved_by_both = 0, outside = 0;
  for (int n = 0; n < 10; ++n) {
    auto c = vp::free_plate({maker.polygon({0, 0}, 0.95, 1.2, 5, "edge"), {}}, 0.02);
    c.section.thickness = n % 2 ? 0.1 : 0.2;
    c.analysis.kind = cases::Analysis::Kind::static_;
    const double angle = maker.uniform(0, std::numbers::pi), half = maker.uniform(0.2, 0.3);
    const geometry::Point middle(maker.uniform(-0.3, 0.3), maker.uniform(-0.3, 0.3)), way(std::cos(angle), std::sin(angle));
    c.cracks = {geometry::Polyline{middle - half * way, middle + half * way}};
    c.supports = {vp::held(SupportKind::simply_supported, {"edge0", "edge2"})};
    c.srif.emplace();
    std::array<std::vector<post::Srif>, 2> found;
    std::array<double, 2> w;
    for (const auto formulation : {Formulation::galerkin, Formulation::ordinary}) {
      c.discretization.formulation = formulation;
      const auto a = vp::assembled(c);
      const auto state = cases::solve_at_rest(c, a, {1e-8, 100000, {}}).solution.state;
      const bool other = formulation == Formulation::ordinary;
      found[other] = cases::srifs(c, a, cases::tip_methods({c, {}}, a), state);
      w[other] = state.row(0).cwiseAbs().maxCoeff();
    }
    CAPTURE(n, w[0], w[1]);
    CHECK(w[1] == Approx(w[0]).epsilon(0.03));
    for (std::size_t tip = 0; tip < 2; ++tip) {
      const auto of_tip = [&](const auto& all) { return *std::ranges::find(all, tip, &post::Srif::tip); };
      const post::Srif one = of_tip(found[0]), other = of_tip(found[1]);
      const std::array K{one.K1 - other.K1, one.K2 - other.K2, one.K3 - other.K3};
      for (std::size_t i = 0; i < 3; ++i) {
        ++compared;
        if (!one.resolved[i] || !other.resolved[i]) continue;
        ++resolved_by_both;
        const double ratio = std::abs(K[i]) / (*one.errors[i] + *other.errors[i]);
        CAPTURE(tip, i, K[i], *one.errors[i], *other.errors[i]);
        CHECK(ratio < 2);
        if (ratio > 1) ++outside;
      }
    }
  }
  CAPTURE(compared, resolved_by_both, outside);
  CHECK(resolved_by_both > compared / 4);
  CHECK(20 * outside <= resolved_by_both);
}
