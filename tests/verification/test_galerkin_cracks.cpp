// Cracks in the Galerkin plate against finite element references: section 4.1 of Dai et al. (2021), openings, mixed
// mode, motion.
#include <omp.h>

#include <Eigen/Geometry>
#include <fstream>
#include <sstream>

#include "plate/formulation/tip_view.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/plate_factors.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

using Row = std::vector<std::string>;

/// Rows of a file in cases/references.
std::vector<Row> rows_of(const std::string& name) {
  std::ifstream file(PDPLATE_SOURCE_DIR "/cases/references/" + name);
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  REQUIRE(rows.size() > 1);
  rows.erase(rows.begin());
  return rows;
}

/// A square of 2 x 2 with a crack from -a to a on y = 0.
cases::Case cracked(double spacing, double thickness, double a) {
  auto c = vp::square(spacing);
  c.section.thickness = thickness;
  c.discretization.formulation = &plate::galerkin;
  c.analysis.kind = cases::Analysis::Kind::static_;
  c.cracks = {{{-a, 0}, {a, 0}}};
  c.supports = {vp::held(SupportKind::simply_supported, {"bottom", "top"})};
  c.srif.emplace();
  c.srif->methods = {post::SrifMethod::virtual_crack_extension, post::SrifMethod::domain_integral};
  return c;
}

struct Solved {
  std::unique_ptr<Formulation> plate;
  State state;
  std::vector<post::Srif> srifs;
};

Solved solved(const cases::Case& c) {
  auto a = vp::assembled(c);
  auto result = plate::static_solution(*a, c.analysis, {1e-8, 1000, {}});
  REQUIRE(result.solution.converged);
  CHECK(result.solution.iterations < 20);  // measured: 8 to 13
  auto srifs = post::srifs(*a, *c.srif, cases::tip_methods({c, {}}, *a), result.solution.state);
  return {std::move(a), std::move(result.solution.state), std::move(srifs)};
}

}  // namespace

TEST_CASE("Galerkin plate: any number of threads gives the same bits of a solution") {
  const auto before = omp_get_max_threads();
  auto c = cracked(0.05, 0.1, 0.3);
  c.cracks = {{{-0.3, -0.1}, {0.25, 0.15}}};
  std::vector<State> states;
  for (const int threads : {1, 2, 2, 3}) {
    omp_set_num_threads(threads);
    states.push_back(solved(c).state);
  }
  omp_set_num_threads(before);
  for (const auto& state : states) CHECK((state.array() == states.front().array()).all());
}

TEST_CASE("Galerkin plate: K1 of thirty cracks within half a percent at spacing 1/60, and within the estimate") {
  std::size_t found = 0;
  for (const auto& row : rows_of("static_summary.csv")) {
    if (row[5] != "soft" || row[4] != "0.3") continue;
    auto c = cracked(1.0 / 60, std::stod(row[2]), std::stod(row[3]));
    if (row[0] == "bending") c.loads = {Load{EdgeMoment{.edges = {"bottom", "top"}, .value = 1}}};
    const double exact = std::stod(row[6]);
    for (const auto& srif : solved(c).srifs) {
      CAPTURE(row[0], row[1], row[3], srif.method, srif.K1 / exact - 1);
      CHECK(std::abs(srif.K1 / exact - 1) < 0.005);  // measured: 0.09 % to 0.48 % too small
      REQUIRE(srif.estimated_error);
      CHECK(std::abs(srif.K1 / exact - 1) < *srif.estimated_error);
      CHECK(std::abs(srif.K2) < 1e-6 * exact);
      ++found;
    }
  }
  CHECK(found == 120);
}

TEST_CASE("Galerkin plate: the opening behind the tip from three spacings on") {
  const auto reference = rows_of("static_cod_pressure_W2h10_2aW0.3_nu0.3_soft.csv");
  const auto exact = [&](double r) {  // linear between the rows
    for (std::size_t i = 1; i < reference.size(); ++i) {
      const double before = std::stod(reference[i - 1][0]), after = std::stod(reference[i][0]);
      if (r < before || r > after) continue;
      const double share = (r - before) / (after - before);
      return (1 - share) * std::stod(reference[i - 1][1]) + share * std::stod(reference[i][1]);
    }
    FAIL("beyond the reference");
    return 0.0;
  };
  const double h = 1.0 / 60;
  const auto s = solved(cracked(h, 0.1, 0.3));
  const auto view = s.plate->tip_view();
  const auto& seen = view->positions;
  for (const int n : {1, 2, 3, 4, 5, 8}) {
    double jump = 0;
    for (std::size_t k = 0; k < seen.size(); ++k)
      if ((seen[k] - geometry::Point(0.3 - n * h, 0)).norm() < 1e-3 * h)
        jump += (seen[k].y() > 0 ? 1 : -1) * s.state(1, Eigen::Index(k));
    CAPTURE(n, jump / exact(n * h));
    const double off = jump / exact(n * h) - 1;
    if (n == 1) CHECK(off > 0.1);  // measured: +17 %: of no use
    if (n > 2) CHECK(std::abs(off) < 0.005);
  }
}

TEST_CASE("Galerkin plate: mixed mode, along the lattice and at 45 degrees") {
  struct Wanted {
    bool inclined;
    std::array<double, 3> tensor, K;
  };
  // static_mixed_summary.csv, incl0_free Mxy and incl45_free Myy; its error is 1e-3 in K1 and K2, 2e-3 in K3
  for (const auto& [inclined, tensor, K] : {Wanted{false, {0, 0, 1}, {0, 0.165421, -0.883895}},
                                            Wanted{true, {0, 1, 0}, {0.118966, 0.0827163, -0.442137}}}) {
    auto c = cracked(0.004, 0.1, 0.1);
    const double x = inclined ? 0.1 * std::sqrt(0.5) : 0.1, y = inclined ? x : 0;
    c.cracks = {{{-x, -y}, {x, y}}};
    c.loads = {Load{EdgeMoment{.edges = {"left", "right", "bottom", "top"}, .tensor = tensor}}};
    c.supports = {{SupportKind::pinned, {}, {{-1, -1}, {1, -1}, {1, 1}}}};
    const auto s = solved(c);
    const auto& right = s.srifs.back();  // the tip at (x, y)
    CAPTURE(inclined, right.method, right.K1, right.K2, right.K3, right.estimated_error);
    CHECK(right.position.x() == Approx(x));
    CHECK(right.K1 == Approx(K[0]).epsilon(0.005).margin(1e-5));
    CHECK(right.K2 == Approx(K[1]).epsilon(0.005));
    CHECK(right.K3 == Approx(K[2]).epsilon(0.015));
  }
}

TEST_CASE("Galerkin plate: K1 of an oblique crack with points far closer together at its tips") {
  // moments of 1 on all edges: the same K1 at every angle, no K2, no K3
  for (const double at_tips : {0.003, 0.0003, 0.00002}) {
    auto c = vp::square(0.1);
    const geometry::Point end(0.3 * std::cos(2 * std::numbers::pi / 9), 0.3 * std::sin(2 * std::numbers::pi / 9));
    c.discretization.formulation = &plate::galerkin;
    c.discretization.tip_spacing = at_tips;
    c.discretization.spacing_growth = 0.2;
    c.analysis.kind = cases::Analysis::Kind::static_;
    c.cracks = {geometry::Polyline{geometry::Point(-end), end}};
    c.supports = {{SupportKind::pinned, {}, {{-1, -1}, {1, -1}, {-1, 1}}}};
    c.loads = {Load{EdgeMoment{.edges = {"left", "right", "bottom", "top"}, .value = 1}}};
    c.analysis.method = cases::Analysis::Method::direct;
    c.srif.emplace();
    c.srif->methods = {post::SrifMethod::domain_integral};
    const auto a = vp::assembled(c);
    const auto state = plate::static_solution(*a, c.analysis, {1e-8, 1000, {}}).solution.state;
    for (const auto& srif : post::srifs(*a, *c.srif, cases::tip_methods({c, {}}, *a), state)) {
      CAPTURE(at_tips, srif.K1, srif.K2, srif.K3);
      CHECK(srif.K1 == Approx(0.3915).epsilon(0.01));                   // measured: 0.56, 0.50, 0.48 % too small
      CHECK(std::abs(srif.K2) < 0.005 * 0.3915);                        // measured: 0.1 %
      CHECK(std::abs(srif.K3) * c.section.thickness < 0.005 * 0.3915);  // measured: 0.15 %
    }
  }
}

TEST_CASE("Galerkin plate: a square that is turned and far from the origin has the same K1") {
  const auto K1 = [](double degrees, const geometry::Point& shift) {
    const double angle = degrees * std::numbers::pi / 180;
    const auto place = [&](const geometry::Point& x) -> geometry::Point {
      return shift + Eigen::Rotation2Dd(angle) * x;
    };
    auto c = cracked(0.05, 0.1, 0.3);
    c.outline = geometry::placed(c.outline, place, 1);
    for (auto& x : c.cracks[0]) x = place(x);
    c.analysis.method = cases::Analysis::Method::direct;
    return solved(c).srifs[0].K1;
  };
  const double straight = K1(0, {0, 0});
  for (const double degrees : {15, 30, 60}) CHECK(K1(degrees, {0, 0}) == Approx(straight).epsilon(0.01));
  CHECK(K1(37, {2e5, -1e5}) == Approx(straight).epsilon(0.01));  // measured: 0.12 to 0.37 % at spacing 0.04
}
