// Beams along edges and lines of a Galerkin plate: Levy's solution of a plate with edge beams, a plate on a beam in the
// middle, the beam alone, mass, reactions and energies.
#include <Eigen/LU>
#include <array>
#include <numbers>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "plate/solve/statics.hpp"
#include "post/report/reactions.hpp"
#include "tests/catch.hpp"
#include "tests/verification/at_rest.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point, vp::at, vp::at_rest;
constexpr double pi = std::numbers::pi;

namespace {

constexpr double thickness = 0.01;

/// 1 x 1 about (0.5, 0), hard supports left and right, free below and above.
cases::Case strip(double spacing, std::vector<Stiffener> stiffeners) {
  auto c = vp::free_plate(geometry::rectangle(0, -0.5, 1, 0.5), spacing);
  c.discretization.formulation = &galerkin;
  c.section = {1000, 0.3, thickness, 5.0 / 6, 2};
  c.supports = {vp::held(SupportKind::simply_supported_hard, {"left", "right"})};
  c.stiffeners = std::move(stiffeners);
  c.loads = {Load{Pressure{.value = 1e-3}}};
  return c;
}

Stiffener beam(double bending, double torsion, std::vector<std::string> edges, geometry::Polyline along = {}) {
  Stiffener result;
  result.bending = bending, result.torsion = torsion, result.edges = std::move(edges), result.along = std::move(along);
  return result;
}

/// Levy's solution of the thin plate, even in y: w = sum (p / D / a^5 ... ) of sines in x; deflection at (0.5, y). Edge
/// beams at y = +-0.5: V_y = EI w,xxxx and M_yy = GJ w,xxy balance what the plate leaves there.
double levy(double y, double bending, double torsion, double pressure = 1e-3) {
  const Section s{1000, 0.3, thickness, 5.0 / 6, 2};
  const double D = s.bending_stiffness(), nu = s.poisson, b = 0.5;
  double sum = 0;
  for (int m = 1; m < 60; m += 2) {
    const double a = m * pi, q = 4 * pressure / (m * pi), particular = q / (D * std::pow(a, 4));
    // w_m = particular + A cosh(a y) + B a y sinh(a y), and its derivatives at y = b
    const double c = std::cosh(a * b), h = std::sinh(a * b), t = a * b;
    const double w[2] = {c, t * h};
    const double d1[2] = {a * h, a * (h + t * c)}, d2[2] = {a * a * c, a * a * (2 * c + t * h)};
    const double d3[2] = {a * a * a * h, a * a * a * (3 * h + t * c)};
    Eigen::Matrix2d system;
    Eigen::Vector2d right;
    for (int i = 0; i < 2; ++i) {
      // the plate's moment at the edge and the beam's twist: D (w,yy - nu a^2 w) + GJ a^2 w,y = 0
      system(0, i) = D * (d2[i] - nu * a * a * w[i]) + torsion * a * a * d1[i];
      // its Kirchhoff force and the beam's bending: D (w,yyy - (2 - nu) a^2 w,y) - EI a^4 w = 0
      system(1, i) = D * (d3[i] - (2 - nu) * a * a * d1[i]) - bending * std::pow(a, 4) * w[i];
    }
    right << D * nu * a * a * particular, bending * std::pow(a, 4) * particular;
    const Eigen::Vector2d k = system.inverse() * right;
    sum += (particular + k[0] * std::cosh(a * y) + k[1] * a * y * std::sinh(a * y)) * (m % 4 == 1 ? 1 : -1);
  }
  return sum;
}

}  // namespace

TEST_CASE("edge beams: Levy's solution of the thin plate, three stiffnesses, bending and torsion") {
  const double D = Section{1000, 0.3, thickness, 5.0 / 6, 2}.bending_stiffness();
  for (const auto& [bending, torsion] : {std::pair{0.0, 0.0}, {0.5 * D, 0.0}, {2 * D, 0.3 * D}, {50 * D, 5 * D}}) {
    for (const double spacing : {1.0 / 20, 1.0 / 40}) {
      std::vector<Stiffener> beams;
      if (bending > 0) beams = {beam(bending, torsion, {"bottom", "top"})};
      const auto plate = vp::assembled(strip(spacing, beams));
      const auto u = at_rest(*plate);
      const double middle = at(*plate, u, {0.5, 0}) / levy(0, bending, torsion) - 1;
      const double edge = at(*plate, u, {0.5, 0.5}) / levy(0.5, bending, torsion) - 1;
      INFO("EI / D " << bending / D << " GJ / D " << torsion / D << " spacing " << spacing << " middle " << middle
                     << " edge " << edge);
      CHECK(std::abs(middle) < 0.011);  // measured: at most 0.99 %, at 1/40 0.36 %
      CHECK(std::abs(edge) < 0.005);    // measured: at most 0.34 %, at 1/40 0.16 %
    }
  }
}

TEST_CASE("a beam along a line of points, much stiffer than the plate, is the beam alone, its shear adds") {
  const double EI = 1e3, p = 1e-3;
  const geometry::Polyline line{{0, 0}, {1, 0}};
  for (const bool shears : {false, true}) {
    auto one = beam(EI, 0, {}, line);
    if (shears) one.shear = 12 * EI;
    auto c = strip(0.05, {one});
    c.loads = {Load{LineLoad{.along = line, .value = p}}};
    const auto plate = vp::assembled(c);
    const double exact = 5 * p / (384 * EI) + (shears ? p / (8 * 12 * EI) : 0);
    CHECK(at(*plate, at_rest(*plate), {0.5, 0}) == Approx(exact).epsilon(0.002));  // measured: 0.10, 0.06 %
  }
}

namespace {

/// Levy's solution with a beam at y = 0 instead, free edges: of y >= 0, where w,y = 0 and 2 D w,yyy + EI w,xxxx = 0.
double levy_of_middle_beam(double y, double bending, double pressure = 1e-3) {
  const Section s{1000, 0.3, thickness, 5.0 / 6, 2};
  const double D = s.bending_stiffness(), nu = s.poisson, b = 0.5;
  double sum = 0;
  for (int m = 1; m < 12; m += 2) {  // more cancel in double precision; they fall with m^-5
    const double a = m * pi, t = a * b, particular = 4 * pressure / (m * pi) / (D * std::pow(a, 4));
    const double c = std::cosh(t), h = std::sinh(t), r = bending * a / (4 * D);
    // w = particular + A cosh + B a y sinh + C (sinh - a y cosh), C = r (particular + A); derivatives over a^n at y = b
    const std::array<double, 4> A{c, h, c, h}, B{t * h, h + t * c, 2 * c + t * h, 3 * h + t * c};
    const std::array<double, 4> C{h - t * c, -t * h, -h - t * c, -2 * c - t * h};
    Eigen::Matrix2d system;
    const auto moment = [&](const auto& f) { return f[2] - nu * f[0]; };
    const auto force = [&](const auto& f) { return f[3] - (2 - nu) * f[1]; };
    system << moment(A) + r * moment(C), moment(B), force(A) + r * force(C), force(B);
    const Eigen::Vector2d k = system.inverse() * Eigen::Vector2d(nu - r * moment(C), -r * force(C)) * particular;
    const double x = a * y, of_beam = r * (particular + k[0]);
    sum += (particular + k[0] * std::cosh(x) + k[1] * x * std::sinh(x) + of_beam * (std::sinh(x) - x * std::cosh(x))) *
           (m % 4 == 1 ? 1 : -1);
  }
  return sum;
}

}  // namespace

TEST_CASE("a beam in the middle: Levy's solution, on points and between them") {
  const double D = Section{1000, 0.3, thickness, 5.0 / 6, 2}.bending_stiffness();
  for (const double bending : {0.5 * D, 2 * D})
    for (const double off : {0.0, 0.009}) {
      auto c = strip(1.0 / 40, {beam(bending, 0, {}, {{0, off}, {1, off}})});
      const auto plate = vp::assembled(c);
      const auto u = at_rest(*plate);
      const double middle = at(*plate, u, {0.5, 0}) / levy_of_middle_beam(0, bending) - 1;
      const double edge = at(*plate, u, {0.5, 0.5}) / levy_of_middle_beam(0.5, bending) - 1;
      INFO("EI / D " << bending / D << " off " << off << " middle " << middle << " edge " << edge);
      CHECK(std::abs(middle) < 0.001);  // measured: 0.007 to 0.048 %
      CHECK(std::abs(edge) < (off == 0 ? 0.005 : 0.02));
    }
}

TEST_CASE("stiffeners: rigid motions cost nothing, forces balance, the work is twice the energy") {
  auto c = strip(0.05, {beam(3, 1, {"top"}), beam(2, 0.5, {}, {{0.1, -0.4}, {0.43, 0.21}, {0.9, 0.3}})});
  c.cracks = {{{0.3, 0}, {0.6, 0}}};
  const auto plate = vp::assembled(c);
  const auto& elastic_supports = plate->boundary().elastic_supports;
  REQUIRE(elastic_supports.parts().size() == 2);
  CHECK(elastic_supports.holding().empty());
  for (const auto& rigid : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.3, 2, -1)}) {
    const State u = vp::field(*plate, [&](const Point& x) {
      return Eigen::Vector3d(rigid[0] - rigid[2] * x.x() + rigid[1] * x.y(), rigid[1], rigid[2]);
    });
    const State bent = vp::field(*plate, [&](const Point& x) { return Eigen::Vector3d(x.x() * x.x() / 2, 0, -x.x()); });
    CHECK(elastic_supports.energy(u) < 1e-12 * elastic_supports.energy(bent));
  }
  // a straight line of length l in w = x^2 / 2, psi = grad w: EI l (t_x^2)^2 / 2 and GJ l (t_x n_x)^2 / 2, no shear
  const State bent = vp::field(*plate, [&](const Point& x) { return Eigen::Vector3d(x.x() * x.x() / 2, 0, -x.x()); });
  const auto length = [](double bending, double torsion, double x, double y) {
    const double l = std::hypot(x, y), t = x / l, n = y / l;
    return l * t * t * (bending * t * t + torsion * n * n) / 2;
  };
  CHECK(elastic_supports.energy(bent) ==
        Approx(length(3, 1, 1, 0) + length(2, 0.5, 0.33, 0.61) + length(2, 0.5, 0.47, 0.09)).epsilon(1e-9));
  const auto u = at_rest(*plate);
  CHECK(plate->strain_energy(u) == Approx(plate->total_load().cwiseProduct(u).sum() / 2).epsilon(1e-9));
  const post::Supports supports(plate->boundary());
  Forces internal;
  plate->internal_force(u, internal);
  const auto balance =
      supports.balance(supports.applied(internal).held, supports.applied(plate->total_load()), nullptr, u);
  CHECK(balance.residual < 1e-8);
  CHECK(balance.supports.size() == plate->boundary().holders.size());
}

TEST_CASE("stiffeners: frequencies and own weight of a narrow plate between two heavy beams") {
  const double EI = 10, mass = 5, width = 0.1;
  auto both = beam(EI, 0, {"bottom", "top"});
  both.mass = mass;
  auto c = strip(0.025, {both});
  c.outline = geometry::rectangle(0, 0, 1, width);
  c.loads = {Load{Pressure{.gravity = -2}}};
  resolve_weights(c);
  const auto plate = vp::assembled(c);
  const double all = 2 * mass + 2 * thickness * width;
  CHECK(plate->total_load().row(0).sum() == Approx(-2 * all).epsilon(1e-12));
  State up = State::Zero(3, Eigen::Index(plate->points()));
  up.row(0).setOnes();
  CHECK(plate->inertia(1).whole(up).row(0).sum() == Approx(all).epsilon(1e-12));
  FrequencyOptions options;
  options.modes = 1, options.tolerance = 1e-8, options.shift = shift_of(plate->section(), 1);
  const auto found = frequencies(*plate, plate->constraints(), plate->mass(), options);
  const double exact = pi / 2 * std::sqrt((2 * EI + 1000 * std::pow(thickness, 3) * width / 12) / all);
  INFO("frequency " << found.modes[0].frequency / exact - 1);
  CHECK(found.modes[0].frequency == Approx(exact).epsilon(0.0005));  // measured: -3e-6
}
