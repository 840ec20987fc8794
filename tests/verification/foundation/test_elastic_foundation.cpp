// Plates on Winkler's and Pasternak's foundations and on springs, in both formulations: series of Navier for the plate
// of Mindlin with k and G_p, the infinite plate of Hertz, limits of springs, rigid plates.
#include <numbers>

#include "plate/formulation/boundary.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "plate/solve/statics.hpp"
#include "post/report/reactions.hpp"
#include "tests/catch.hpp"
#include "tests/verification/at_rest.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point, vp::at, vp::at_rest;

namespace {

const std::vector<const FormulationKind*> both{&galerkin, &ordinary};

cases::Case unit_square(const FormulationKind& kind, double spacing, std::optional<SupportKind> held = {}) {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), spacing);
  c.discretization.formulation = &kind;
  c.section = {1000, 0.3, 0.1, 5.0 / 6, 2};
  if (held) c.supports = {vp::held_all_round(*held)};
  return c;
}

/// Middle of a unit square with hard supports under unit pressure. Of every wave sin(m pi x) sin(n pi y), L = (m^2 +
/// n^2) pi^2, the couples are in balance with psi = grad w / (1 + D L / S), and w (D L^2 / (1 + D L / S) + k + G L) is
/// the pressure: for thin plates the textbook's q / (D L^2 + k).
double navier(const Section& s, double k, double G) {
  const double D = s.bending_stiffness(), S = s.shear_stiffness(), pi = std::numbers::pi;
  double sum = 0;
  for (int m = 1; m < 200; m += 2)
    for (int n = 1; n < 200; n += 2) {
      const double L = (m * m + n * n) * pi * pi, q = 16 / (m * n * pi * pi);
      sum += q / (D * L * L / (1 + D * L / S) + k + G * L) * ((m + n) % 4 == 2 ? 1 : -1);
    }
  return sum;
}

Spring on_edges(double deflection, double normal = 0, double tangential = 0) {
  Spring spring;
  spring.deflection = deflection, spring.rotation_normal = normal, spring.rotation_tangential = tangential;
  spring.edges = {"left", "right", "bottom", "top"};
  return spring;
}

Spring single(const Point& x, double deflection, double rotation = 0) {
  Spring spring;
  spring.position = x, spring.deflection = deflection, spring.rotation = rotation;
  return spring;
}

Load force_at(const Point& x, double value) {
  return {PointForce{.position = x, .value = value}};
}

/// omega^2 of the three lowest modes.
std::vector<double> squares(const cases::Case& c) {
  const auto plate = vp::assembled(c);
  const auto factor = plate->factor();
  FrequencyOptions options;
  options.modes = 3, options.tolerance = 1e-6, options.shift = shift_of(c.section, 1);
  options.preconditioner = factor.get();
  std::vector<double> result;
  for (const auto& mode : frequencies(*plate, plate->constraints(), plate->mass(), options).modes)
    result.push_back(std::pow(2 * std::numbers::pi * mode.frequency, 2));
  return result;
}

double middle(const cases::Case& c) {
  const auto plate = vp::assembled(c);
  return at(*plate, at_rest(*plate), {0.5, 0.5});
}

}  // namespace

TEST_CASE("hard supports on foundations: Navier's series") {
  // the wave (1, 1) has D L^2 / (1 + D L / S) = 34: k and G_p L are of the same size
  for (const auto* kind : both)
    for (const double G : {0.0, 1.5}) {
      std::vector<double> error;
      for (const int cells : {20, 40, 100}) {
        auto c = unit_square(*kind, 1.0 / cells, SupportKind::simply_supported_hard);
        c.foundations = {{30, G, {}}};
        error.push_back(middle(c) / navier(c.section, 30, G) - 1);
      }
      CAPTURE(kind->name, G, error);
      CHECK(std::abs(error[0]) < 0.03);    // measured: 0.22 and 0.27 % (Galerkin), -1.8 and -0.6 % (bonds)
      CHECK(std::abs(error[1]) < 0.008);   // measured: 0.056, 0.068 %; -0.43, -0.01 %
      CHECK(std::abs(error[2]) < 0.0015);  // measured: 0.009, 0.011 %; -0.07, +0.06 %
      // order: 2.0 in the Galerkin plate; with bonds 2.0 without shear layer, with it the error changes its sign
      if (kind == &galerkin || G == 0) CHECK(std::log2(std::abs(error[0] / error[1])) == Approx(2).margin(0.1));
    }
}

TEST_CASE("infinite plate on soil under a point force: Hertz") {
  const double l = 1;  // (D / k)^(1/4); its edges are six of these away, and h / l leaves no shear
  auto c = vp::free_plate(geometry::rectangle(-6, -6, 6, 6), l / 16);
  c.discretization.formulation = &galerkin;
  c.section.thickness = 0.01;
  const double D = c.section.bending_stiffness(), k = D / std::pow(l, 4);
  c.foundations = {{k, 0, {}}};
  c.loads = {force_at({0, 0}, 1)};
  const auto plate = vp::assembled(c);
  const State u = at_rest(*plate);
  CHECK(at(*plate, u, {0, 0}) == Approx(l * l / (8 * D)).epsilon(0.006));  // measured: +0.42 %; at l / 8 +1.33 %
  const double carried = plate->boundary().elastic_supports.parts()[0]->force(u).row(0).sum();
  CHECK(carried == Approx(-1).epsilon(1e-7));  // measured: 1e-10
}

TEST_CASE("frequencies on a foundation: omega^2 rises by k / rho h") {
  // errors of the rise in three modes, 22 and 44 points across: of the second order, (pi m / 44)^2 / 6 for each
  // direction in the Galerkin plate; with bonds rotary inertia and soil differ by (h^2 - spacing^2) / 12 of the slopes
  for (const auto* kind : both) {
    std::vector<double> worst;
    for (const int points : {22, 44}) {
      auto c = unit_square(*kind, 1.0 / points, SupportKind::simply_supported_hard);
      c.section.thickness = kind == &galerkin ? 0.005 : 0.03;  // bonds lock in thinner ones
      const double rho_h = c.section.density * c.section.thickness;
      const double k = 500 * c.section.bending_stiffness();  // the lowest omega^2 rho h / D: 390
      const auto bare = squares(c);
      c.foundations = {{k, 0, {}}};
      const auto lying = squares(c);
      double error = 0;
      for (std::size_t i = 0; i < bare.size(); ++i)
        error = std::max(error, std::abs((lying[i] - bare[i]) * rho_h / k - 1));
      worst.push_back(error);
    }
    CAPTURE(kind->name, worst);
    CHECK(worst[1] < 0.005);         // measured: 0.43 % (Galerkin), 0.16 % (bonds)
    CHECK(worst[1] < worst[0] / 2);  // measured: a quarter, a third
  }
}

TEST_CASE("a motion on a foundation and springs conserves energy") {
  for (const auto* kind : both) {
    auto c = unit_square(*kind, 1.0 / 20);
    c.foundations = {{20, 2, geometry::Circle{{0.4, 0.5}, 0.33, ""}}};
    c.springs = {on_edges(5, 0.1, 0.2), single({0.77, 0.31}, 3, 0.2)};
    const auto plate = vp::assembled(c);
    const double step = 0.95 * stable_time_step(*plate, plate->constraints(), plate->mass());
    std::vector<double> sums;
    double largest = 0;
    central_differences(*plate, plate->constraints(), plate->mass(), plate->loads(), {step, 2000, 10},
                        [&](const Instant& now) {
                          CHECK(now.strain_energy == Approx(plate->strain_energy(now.state)).margin(1e-12));
                          sums.push_back(now.discrete_kinetic_energy + now.strain_energy + now.potential);
                          largest = std::max(largest, now.strain_energy);
                        });
    const auto [low, high] = std::ranges::minmax(sums);
    CHECK((high - low) / largest < 1e-12);  // measured: 1e-14
  }
}

TEST_CASE("springs along edges: from soft supports at large stiffness, and less without end") {
  for (const auto* kind : both) {
    const double supported = middle(unit_square(*kind, 1.0 / 40, SupportKind::simply_supported));
    const double clamped = middle(unit_square(*kind, 1.0 / 40, SupportKind::clamped));
    double before = INFINITY;
    for (const double k : {1e-2, 1.0, 1e2, 1e4, 1e7}) {
      auto c = unit_square(*kind, 1.0 / 40);
      c.springs = {on_edges(k)};
      const double w = middle(c);
      CHECK(w < before);
      before = w;
    }
    CHECK(before == Approx(supported).epsilon(kind == &galerkin ? 1e-5 : 0.015));  // measured: 1e-6; -0.9 %
    before = INFINITY;
    for (const double k : {0.0, 1e-2, 1.0, 1e2, 1e6}) {
      auto c = unit_square(*kind, 1.0 / 40, SupportKind::simply_supported);
      if (k > 0) c.springs = {on_edges(0, k, k)};
      const double w = middle(c);
      CHECK(w < before);
      if (k == 1e-2) CHECK(w == Approx(supported).epsilon(0.3));
      before = w;
    }
    CHECK(before == Approx(clamped).epsilon(kind == &galerkin ? 1e-5 : 0.025));  // measured: 6e-7; +1.8 %
  }
}

TEST_CASE("a rigid plate on three springs and one on soil") {
  for (const auto* kind : both) {
    auto c = unit_square(*kind, 1.0 / 10);
    c.section.young = 1e9;
    const std::array<Point, 3> feet{Point(0.13, 0.22), Point(0.87, 0.31), Point(0.44, 0.79)};
    const std::array<double, 3> stiffness{3, 5, 8};
    for (std::size_t i = 0; i < 3; ++i) c.springs.push_back(single(feet[i], stiffness[i]));
    const Point x(0.5, 0.4);
    c.loads = {force_at(x, 2)};
    auto plate = vp::assembled(c);
    State u = at_rest(*plate);
    // a force on three feet: shares by areas of triangles
    const auto cross = [](const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); };
    const double all = cross(feet[1] - feet[0], feet[2] - feet[0]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Point &a = feet[(i + 1) % 3], &b = feet[(i + 2) % 3];
      const double share = cross(a - x, b - x) / all;
      const double found = plate->boundary().elastic_supports.parts()[i]->force(u).row(0).sum();
      CHECK(found == Approx(-2 * share).epsilon(1e-9));  // measured: 6e-13
    }
    // on soil beneath a part: w = (F / A) (1 + x (x0 - xm) / i^2 ...) about the part's middle
    c.springs.clear();
    c.foundations = {
        {40, 0, geometry::Polygon{{{0.25, 0.33}, {0.81, 0.33}, {0.81, 0.71}, {0.25, 0.71}}, {"", "", "", ""}}}};
    plate = vp::assembled(c), u = at_rest(*plate);
    const double a = 0.56, b = 0.38;
    const Point e = x - Point(0.53, 0.52);
    for (const Point& y : {Point(0.1, 0.1), Point(0.85, 0.35)}) {
      const Point r = y - Point(0.53, 0.52);
      const double w = 2 / (40 * a * b) * (1 + 12 * e.x() * r.x() / (a * a) + 12 * e.y() * r.y() / (b * b));
      CHECK(at(*plate, u, y) == Approx(w).epsilon(1e-6));  // measured: 8e-8, what bends at this modulus
    }
  }
}
