// Loads in the plane at which plates buckle, and frequencies under such loads. References: closed forms of Mindlin's
// plate, else own programs: Ritz's method with Legendre polynomials, 6 digits; cracked squares by hp finite
// elements, 5.
#include "plate/solve/buckling.hpp"

#include <Eigen/Geometry>
#include <numbers>

#include "cases/driver/prepared.hpp"
#include "cases/runs/analyses.hpp"
#include "cases/runs/membrane.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
using geometry::Point;
namespace vp = verified_plate;

namespace {

constexpr double pi = std::numbers::pi;

/// A rectangle of the sides a and 1, turned [degrees], under membrane forces in units of pi^2 D; points across: n.
cases::Case loaded(double a, double h, SupportKind kind, const std::array<double, 3>& N, int n, double degrees = 0) {
  auto c = vp::square(1.0 / n);
  const Eigen::Rotation2Dd turn(degrees * pi / 180);
  c.outline.outer.vertices = {turn * Point(0, 0), turn * Point(a, 0), turn * Point(a, 1), turn * Point(0, 1)};
  c.section = {1, 0.3, h, 5.0 / 6, 1};
  c.discretization.formulation = &plate::galerkin;
  c.analysis.kind = cases::Analysis::Kind::buckling;
  const auto held = vp::held_all_round(kind);
  c.supports = {held, vp::held(SupportKind::in_plane, {})};
  const Point middle = turn * Point(a / 2, 0.5), way = turn * Point(1.0 / n, 0);
  c.supports[1].points = {middle, middle + way};
  Eigen::Matrix2d tensor;
  tensor << N[0], N[2], N[2], N[1];
  tensor = turn * tensor * turn.inverse();
  EdgeTraction traction{held.edges};
  const double unit = pi * pi * c.section.bending_stiffness();
  traction.tensor = std::array{unit * tensor(0, 0), unit * tensor(1, 1), unit * tensor(0, 1)};
  c.loads = {{traction}};
  return c;
}

std::vector<BucklingMode> modes_of(const cases::Case& c, std::size_t count = 1) {
  const auto found = discretise(c);
  REQUIRE(found.membrane);
  return buckling(*found.plate, prestress(*found.membrane), count, 1e-9);
}

}  // namespace

TEST_CASE("buckling: squares under compression and shear", "[in_plane]") {
  using enum SupportKind;
  struct Square {
    SupportKind kind;
    std::array<double, 3> N;
    double factor;  // h = 0.05
  };
  const std::vector<Square> squares{{simply_supported_hard, {-1, 0, 0}, 3.9443864},
                                    {simply_supported_hard, {-1, -1, 0}, 3.9443864 / 2},
                                    {simply_supported_hard, {0, 0, 1}, 8.9016552},
                                    {clamped, {-1, 0, 0}, 9.5586812},
                                    {clamped, {-1, -1, 0}, 5.0865546},
                                    {clamped, {0, 0, 1}, 13.349245}};
  for (const auto& [kind, N, factor] : squares)
    for (const double degrees : {0.0, 30.0}) {
      INFO("kind " << int(kind) << ", N " << N[0] << " " << N[1] << " " << N[2] << ", turned by " << degrees);
      const double coarse = modes_of(loaded(1, 0.05, kind, N, 40, degrees)).at(0).factor / factor - 1;
      const auto fine = modes_of(loaded(1, 0.05, kind, N, 80, degrees)).at(0);
      const double error = fine.factor / factor - 1;
      CAPTURE(coarse, error);
      CHECK(std::abs(error) < 0.003);
      CHECK(std::log2(coarse / error) > 1.7);  // the order of convergence
      CHECK(fine.residual < 1e-6);
      CHECK(fine.shape.row(0).maxCoeff() == 1);
    }
}

TEST_CASE("buckling: shear lowers the factor of thick plates as Mindlin's plate has it", "[in_plane]") {
  for (const double h : {0.01, 0.1, 0.2}) {
    const auto c = loaded(1, h, SupportKind::simply_supported_hard, {-1, 0, 0}, 50);
    const double shear = 5.0 / 6 * c.section.young / 2.6 * h;
    CAPTURE(h);
    CHECK(modes_of(c).at(0).factor ==
          Approx(4 / (1 + 2 * pi * pi * c.section.bending_stiffness() / shear)).epsilon(0.003));
  }
}

TEST_CASE("buckling: bonds come to the same squares", "[in_plane]") {
  using enum SupportKind;
  struct Square {
    SupportKind kind;
    std::array<double, 3> N;
    double factor, error;  // error: largest with 40 points a side
  };
  const std::vector<Square> squares{{simply_supported_hard, {-1, 0, 0}, 3.9443864, 0.01},       // 0.62 %
                                    {simply_supported_hard, {-1, -1, 0}, 3.9443864 / 2, 0.01},  // 0.82 %
                                    {simply_supported_hard, {0, 0, 1}, 8.9016552, 0.04},        // 3.1 %
                                    {clamped, {-1, 0, 0}, 9.5586812, 0.035},                    // 2.6 %
                                    {clamped, {-1, -1, 0}, 5.0865546, 0.025}};                  // 1.8 %
  for (const auto& [kind, N, factor, error] : squares) {
    INFO("kind " << int(kind) << ", N " << N[0] << " " << N[1] << " " << N[2]);
    std::array<double, 2> errors{};
    for (const int n : {20, 40}) {
      auto c = loaded(1, 0.05, kind, N, n);
      c.discretization.formulation = &plate::ordinary;
      c.joined_with_plane = true;
      errors[n == 40] = modes_of(c).at(0).factor / factor - 1;
    }
    CHECK(std::abs(errors[1]) < error);
    CHECK(errors[0] > 2 * errors[1]);  // 3.7 to 6.1
  }
}

TEST_CASE("buckling: rectangles of five aspect ratios", "[in_plane]") {
  const std::vector<std::pair<double, double>> rectangles{
      {0.5, 6.0371973}, {1, 3.9443864}, {1.5, 4.2569165}, {2, 3.9443864}, {3, 3.9443864}};
  for (const auto& [a, factor] : rectangles) {
    INFO("a/b = " << a);
    const auto c = loaded(a, 0.05, SupportKind::simply_supported_hard, {-1, 0, 0}, a < 1 ? 80 : 50);
    CHECK(std::abs(modes_of(c).at(0).factor / factor - 1) < 0.003);
  }
}

TEST_CASE("buckling: the flanks of a crack buckle in tension, and a cracked plate earlier in compression",
          "[in_plane]") {
  struct Crack {
    double share;           // 2 a / W, h / W = 0.005
    double tension, along;  // factors of N_yy = 1 and N_xx = -1, the crack along x
    int points;             // across, in tension
    double tip_spacing, growth, error;
  };
  const std::vector<Crack> cracks{{0.1, 626.8, 3.94888, 50, 0.001, 0.04, 0.006},      // 0.52 %
                                  {0.3, 63.167, 3.62104, 50, 0.001, 0.04, 0.0035},    // 0.28 %
                                  {0.5, 19.7858, 3.19409, 100, 0.0025, 0.1, 0.0035},  // 0.29 %
                                  {0.7, 8.3403, 2.86061, 100, 0.003, 0.1, 0.003},     // 0.22 %
                                  {0.9, 3.7802, 2.68741, 100, 0.001, 0.1, 0.003}};    // 0.15 %
  for (const auto& [share, tension, along, points, tip_spacing, growth, error] : cracks)
    for (const bool pulled : {true, false}) {
      auto c = loaded(1, 0.005, SupportKind::simply_supported_hard,
                      pulled ? std::array{0.0, 1.0, 0.0} : std::array{-1.0, 0.0, 0.0}, pulled ? points : 50);
      c.supports[1].points = {{0, 0.5}, {0.04, 0.5}};
      c.cracks = {{{0.5 - share / 2, 0.5}, {0.5 + share / 2, 0.5}}};
      c.discretization.tip_spacing = pulled ? tip_spacing : 0.004,
      c.discretization.spacing_growth = pulled ? growth : 0.1;
      const auto modes = modes_of(c);
      const double factor = pulled ? tension : along, off = modes.at(0).factor / factor - 1;
      const auto estimate = cases::errors_of_buckling(c, modes).at(0);
      INFO("2a/W = " << share << ", pulled " << pulled << ", off by " << off);
      CHECK(std::abs(off) < (pulled ? error : 0.0035));  // along the crack: 0.31, 0.35 % of 0.7, 0.9
      REQUIRE(estimate);
      CHECK(*estimate > std::abs(off) * factor);
      CHECK(*estimate < 0.03 * factor);
    }
}

TEST_CASE("buckling: errors are within their estimates", "[in_plane]") {
  using enum SupportKind;
  const auto check = [](const cases::Case& c, double factor) {
    const auto modes = modes_of(c, 2);
    const auto errors = cases::errors_of_buckling(c, modes);
    REQUIRE(errors.size() == 2);
    REQUIRE(errors[0]);
    const double error = std::abs(modes[0].factor - factor);
    INFO("factor " << modes[0].factor << ", error " << error << ", estimated " << *errors[0]);
    CHECK(*errors[0] > error);
    CHECK(*errors[0] < 0.1 * factor);
    CHECK(errors[1].has_value());
  };
  for (const int n : {20, 40})
    for (const double degrees : {0.0, 30.0}) {
      INFO("n " << n << ", turned by " << degrees);
      check(loaded(1, 0.05, simply_supported_hard, {-1, 0, 0}, n, degrees), 3.9443864);
      check(loaded(1, 0.05, simply_supported_hard, {0, 0, 1}, n, degrees), 8.9016552);
      check(loaded(1, 0.05, clamped, {-1, -1, 0}, n, degrees), 5.0865546);
      check(loaded(1, 0.05, clamped, {0, 0, 1}, n, degrees), 13.349245);
    }
  for (const bool pulled : {true, false}) {
    auto c =
        loaded(1, 0.005, simply_supported_hard, pulled ? std::array{0.0, 1.0, 0.0} : std::array{-1.0, 0.0, 0.0}, 50);
    c.supports[1].points = {{0, 0.5}, {0.04, 0.5}};
    c.cracks = {{{0.35, 0.5}, {0.65, 0.5}}};
    c.discretization.tip_spacing = 0.005, c.discretization.spacing_growth = 0.1;
    INFO("crack, pulled " << pulled);
    check(c, pulled ? 63.16733 : 3.621039);
  }
}

TEST_CASE("buckling: loads that press the faces of a crack together are told", "[in_plane]") {
  for (const double pull : {1.0, -1.0}) {
    auto c = loaded(1, 0.05, SupportKind::simply_supported_hard, {0, pull, 0}, 40);
    c.supports[1].points = {{0, 0.5}, {0.025, 0.5}};
    c.cracks = {{{0.35, 0.5}, {0.65, 0.5}}};
    const auto found = discretise(c);
    CHECK(cases::warnings_about_pressed_faces(*found.membrane, c.analysis).size() == (pull > 0 ? 0 : 2));
  }
}

TEST_CASE("buckling: a plate in tension has no load at which it buckles", "[in_plane]") {
  for (const double h : {0.05, 0.003}) {
    CHECK(modes_of(loaded(1, h, SupportKind::simply_supported_hard, {1, 0.5, 0}, 10)).empty());
    CHECK(modes_of(loaded(1, h, SupportKind::simply_supported_hard, {1, 1, 0}, 30), 5).empty());
  }
}

TEST_CASE("buckling: short waves across a large tension are found", "[in_plane]") {
  const auto found = modes_of(loaded(1, 0.01, SupportKind::simply_supported_hard, {1, -0.01, 0}, 20), 3);
  REQUIRE(found.size() == 3);
  for (const auto& mode : found) CHECK(mode.residual < 1e-6);
  CHECK(found[0].factor > 0);
  CHECK(found[0].factor <= found[1].factor);
  CHECK(found[1].factor <= found[2].factor);
}

TEST_CASE("buckling: frequencies go to zero with the load", "[in_plane]") {
  constexpr double N_cr = 3.9443864;
  for (const auto* formulation : {&plate::galerkin, &plate::ordinary})
    for (const double share : {-0.5, 0.9, -2.0}) {  // of the buckling load; below zero in tension
      INFO(formulation->name << ", share " << share);
      auto c = loaded(1, 0.05, SupportKind::simply_supported_hard, {-share * N_cr, 0, 0}, 40);
      c.discretization.formulation = formulation, c.joined_with_plane = true;
      const auto found = discretise(c);
      const auto inverse = found.plate->inverse_of_shifted(1);
      const FrequencyOptions options{1, 1e-6, 10000, shift_of(c.section, 1), inverse.get(), {}};
      const Forces mass = found.plate->mass();
      const double free = frequencies(*found.plate, found.plate->constraints(), mass, options).modes.at(0).frequency;
      const auto of_stressed = frequencies_under_load(*found.membrane, *found.plate, mass, options);
      CHECK(std::abs(std::pow(of_stressed.modes.at(0).frequency / free, 2) - (1 - share)) <
            (formulation == &plate::galerkin ? 0.006 : 0.04));  // measured: 0.0052, 0.035 in tension
    }
  const auto c = loaded(1, 0.05, SupportKind::simply_supported_hard, {-1.1 * N_cr, 0, 0}, 10);
  const auto found = discretise(c);
  const auto inverse = found.plate->inverse_of_shifted(1);
  const FrequencyOptions options{1, 1e-6, 10000, shift_of(c.section, 1), inverse.get(), {}};
  CHECK_THROWS_AS(frequencies_under_load(*found.membrane, *found.plate, found.plate->mass(), options), NumericalError);
}

TEST_CASE("buckling: multiple factors come all, and none that is not there", "[in_plane]") {
  const std::vector<double> exact{2, 5, 5, 8, 10, 10, 13};  // m^2 + n^2 of the thin plate, pressed alike in x and y
  for (const std::size_t count : {2u, 5u, 7u}) {
    const auto modes = modes_of(loaded(1, 0.02, SupportKind::simply_supported_hard, {-1, -1, 0}, 24), count);
    REQUIRE(modes.size() == count);
    for (std::size_t i = 0; i < count; ++i) {
      INFO(count << ", mode " << i << ": " << modes[i].factor);
      CHECK(modes[i].factor == Approx(exact[i]).epsilon(0.05));  // measured: 3.7 % of the seventh
      CHECK(modes[i].residual < 1e-6);
    }
  }
}
