// Heat, supports that move and harmonic loads of plates whose bending and stretching are coupled: free and held
// laminates, Timoshenko's bimetal strip, a strip whose end moves, the slow limit and the resonance of a plate.
#include <Eigen/LU>

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/solve/coupled_plate.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "post/files/sinks.hpp"
#include "post/files/summary.hpp"
#include "tests/verification/sections/laminates.hpp"

using namespace plates_of_sections;
using namespace laminates;

namespace {

Ply warm(Ply ply, double alpha1, double alpha2) {
  ply.alpha1 = alpha1, ply.alpha2 = alpha2;
  return ply;
}

/// Isotropic ply.
Ply metal(double young, double thickness, double alpha) {
  Ply result;
  const double G = young / 2.6;
  static_cast<Orthotropy&>(result) = {young, young, 0.3, G, G, G, 0};
  result.thickness = thickness;
  return warm(result, alpha, alpha);
}

/// N_T and M_T of classical lamination, by the temperatures of the middle plane and per z.
Vector6 thermal(const Section& section, double mean, double per_z) {
  Vector6 result = Vector6::Zero();
  double z = -section.thickness / 2;
  for (const auto& one : section.plies) {
    const double end = z + one.thickness, c = std::cos(one.angle * pi / 180), s = std::sin(one.angle * pi / 180);
    const double a1 = *one.alpha1, a2 = *one.alpha2;
    const Eigen::Vector3d f = turned_stiffness(one) *
                              Eigen::Vector3d(c * c * a1 + s * s * a2, s * s * a1 + c * c * a2, 2 * c * s * (a1 - a2));
    const double first = (end * end - z * z) / 2, second = (end * end * end - z * z * z) / 3;
    result.head<3>() += ((end - z) * mean + first * per_z) * f;
    result.tail<3>() += (first * mean + second * per_z) * f;
    z = end;
  }
  return result;
}

struct Warmed {
  Discretised plates;
  CoupledEquilibrium found;
  Resultants bending, membrane;
  double stored = 0;  // with the heat
};

/// A plate 1 x 0.6 under a temperature; three pins hold w, or all edges are held.
Warmed warmed(const Section& section, double mean, double difference, bool held) {
  auto c = rectangle(section, 1, 0.6, 0.1);
  auto pins = vp::held(SupportKind::pinned, {});
  pins.points = {{0, 0}, {1, 0}, {0, 0.6}};
  c.supports = {held ? vp::held_all_round(SupportKind::clamped) : pins};
  if (held) c.supports[0].in_plane = InPlane::fixed;
  c.loads = {Load{Temperature{.value = difference, .mean = mean}}};
  Warmed result{discretise(c), {}, {}, {}};
  const auto &plate = *result.plates.plate, &membrane = *result.plates.membrane;
  result.found =
      CoupledPlate(plate, membrane).equilibrium({plate.total_load(), membrane.total_load()}, {1e-10, 10, {}});
  REQUIRE(result.found.of_both.converged);
  const auto heat = heat_of(membrane, 1);
  result.bending = plate.resultants(result.found.bending), result.membrane = membrane.resultants(result.found.membrane);
  couple(result.bending, result.membrane, section, &heat);
  result.stored = result.found.strain_energy() + stored(plate, heat_of(plate, 1), result.found.bending) +
                  stored(membrane, heat, result.found.membrane);
  return result;
}

double theta(const Formulation& plate, const State& state, Eigen::Index component, const Point& x) {
  double sum = 0;
  for (const auto& share : plate.interpolation(x)) sum += share.weight * state(component, share.point);
  return sum;
}

/// Largest of the resultants over `size`.
double largest(const Warmed& found, const Vector6& size) {
  return std::max(found.membrane.moments.cwiseAbs().maxCoeff() / size.head<3>().cwiseAbs().maxCoeff(),
                  found.bending.moments.cwiseAbs().maxCoeff() / size.tail<3>().cwiseAbs().maxCoeff());
}

}  // namespace

TEST_CASE("coupled heat: free plies have the strains and curvatures of classical lamination, and no forces") {
  for (const auto& section : {of_plies({warm(ply(0, 0.01), -1e-6, 3e-5), warm(ply(90, 0.01), -1e-6, 3e-5)}),
                              of_plies({warm(ply(30, 0.01), -1e-6, 3e-5), warm(ply(75, 0.005), -1e-6, 3e-5)}),
                              of_plies({metal(2000, 0.01, 2e-5), metal(1000, 0.005, 1e-5)})}) {
    REQUIRE(section.couples());
    const auto held = thermal(section, 100, -40 / section.thickness);
    const Vector6 strains = laminate(section).inverse() * held;
    const auto found = warmed(section, 100, -40, false);
    const auto& [plate, bending] = std::tie(*found.plates.plate, found.found.bending);
    // kappa is the strain per z: theta_y,x and -theta_x,y
    const double xx = theta(plate, bending, 2, {1, 0.3}) - theta(plate, bending, 2, {0, 0.3}),
                 yy = (theta(plate, bending, 1, {0.5, 0}) - theta(plate, bending, 1, {0.5, 0.6})) / 0.6;
    const double u = theta(*found.plates.membrane, found.found.membrane, 2, {1, 0.3}) -
                     theta(*found.plates.membrane, found.found.membrane, 2, {0, 0.3});
    INFO(xx / strains[3] - 1 << ", " << yy / strains[4] - 1 << ", " << u / strains[0] - 1 << "; forces "
                             << largest(found, held));
    CHECK(xx == Approx(strains[3]).epsilon(1e-9));  // measured, as the three below: at most 2e-13
    CHECK(yy == Approx(strains[4]).epsilon(1e-9));
    CHECK(u == Approx(strains[0]).epsilon(1e-9));
    CHECK(largest(found, held) < 1e-9);
  }
}

TEST_CASE("coupled heat: a bimetal strip has the curvature of Timoshenko") {
  const auto found = warmed(of_plies({metal(2000, 0.01, 2e-5), metal(1000, 0.005, 1e-5)}), 100, 0, false);
  const auto& plate = *found.plates.plate;
  const double m = 2, n = 2, h = 0.015;
  const double exact =
      6 * (1e-5 - 2e-5) * 100 * (1 + m) * (1 + m) / (h * (3 * (1 + m) * (1 + m) + (1 + m * n) * (m * m + 1 / (m * n))));
  CHECK(theta(plate, found.found.bending, 2, {1, 0.3}) - theta(plate, found.found.bending, 2, {0, 0.3}) ==
        Approx(exact).epsilon(1e-9));  // measured: 7e-12
}

TEST_CASE("coupled heat: held plies have the forces -N_T and -M_T, and their energy") {
  const auto section = of_plies({warm(ply(30, 0.01), -1e-6, 3e-5), warm(ply(75, 0.005), -1e-6, 3e-5)});
  const auto exact = thermal(section, 100, -40 / 0.015);
  const auto found = warmed(section, 100, -40, true);
  for (Eigen::Index k = 0; k < found.bending.moments.cols(); ++k) {
    CHECK((found.membrane.moments.col(k) + exact.head<3>()).norm() < 1e-10 * exact.head<3>().norm());
    CHECK((found.bending.moments.col(k) + exact.tail<3>()).norm() < 1e-10 * exact.tail<3>().norm());
  }
  double energy = 0, z = -section.thickness / 2;  // of stresses Q alpha T, integrated by Gauss
  for (const auto& one : section.plies)
    for (const double side : {-1, 1}) {
      const double at = z + one.thickness * (0.5 + side / std::sqrt(12)), T = 100 - 40 / 0.015 * at;
      const double c = std::cos(one.angle * pi / 180), s = std::sin(one.angle * pi / 180), a1 = -1e-6, a2 = 3e-5;
      const Eigen::Vector3d strains(c * c * a1 + s * s * a2, s * s * a1 + c * c * a2, 2 * c * s * (a1 - a2));
      energy += 0.6 * one.thickness / 2 * T * T * strains.dot(turned_stiffness(one) * strains) / 2;
      if (side > 0) z += one.thickness;
    }
  CHECK(found.stored == Approx(energy).epsilon(1e-10));
}

TEST_CASE("coupled heat: plies that all expand alike are free of stress and flat under a mean temperature") {
  auto section = of_plies({ply(0, 0.01), ply(90, 0.01)});
  section.thermal_expansion = 1e-5;
  const auto found = warmed(section, 100, 0, false);
  const Vector6 size = laminate(section) * (Vector6() << 1e-3, 1e-3, 0, 0.1, 0.1, 0).finished();
  CHECK(largest(found, size) < 1e-9);
  CHECK(found.found.bending.row(0).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(std::abs(found.stored) < 1e-9 * found.found.strain_energy());
}

TEST_CASE("coupled supports: a strip whose end moves has the force of a cantilever of D - B B / A") {
  const double h = 0.02, L = 1, moved = 0.01;
  const auto section = of_plies({ply(0, h / 2), ply(90, h / 2)});
  auto c = rectangle(section, L, 0.2, 0.025);
  c.supports = {vp::held(SupportKind::clamped, {"left"}), vp::held(SupportKind::simply_supported, {"right"}),
                vp::held(SupportKind::symmetry, {"top", "bottom"})};
  c.supports[0].in_plane = InPlane::fixed, c.supports[2].in_plane = InPlane::normal;
  Settlement settlement;
  settlement.support = 1, settlement.value = moved;
  c.loads = {Load{settlement}};
  const auto made = discretise(c);
  const auto &plate = *made.plate, &membrane = *made.membrane;
  const auto lift = total_lift(plate);
  const PlateLoads loads{plate.total_load(), membrane.total_load()};
  const auto found = CoupledPlate(plate, membrane).equilibrium(loads, {1e-8, 10, {}}, lift);
  REQUIRE(found.of_both.converged);
  CHECK(found.of_both.residual < 1e-8);
  const auto K = laminate(section);
  const double D = K(3, 3) - K(0, 3) * K(0, 3) / K(0, 0), S = section.shear_correction * h / 2 * (500 + 200);
  const double force = moved / (L * L * L / (3 * D) + L / S) * 0.2;
  const double energy = force * moved / 2, u = K(0, 3) / K(0, 0) * force / 0.2 * L * L / (2 * D);
  const double end = theta(membrane, found.membrane, 2, {L, 0.1});
  INFO("energy " << found.strain_energy() / energy - 1 << ", u " << end / u - 1);
  CHECK(found.strain_energy() == Approx(energy).epsilon(0.001));  // measured: 0.034 %, by half the spacing 0.009 %
  CHECK(end == Approx(u).epsilon(0.001));                         // likewise
  const Forces load = loads.across + found.on_bending;
  CHECK(PrescribedDisplacements(plate, load, lift).work(found.what_strains()) ==
        Approx(found.strain_energy()).epsilon(1e-8));
}

namespace {

constexpr const char* shaken = R"([section]
density = 2.0
plies = [
  { E1 = 25000.0, E2 = 1000.0, nu12 = 0.25, G12 = 500.0, G13 = 500.0, G23 = 200.0, thickness = 0.01 },
  { E1 = 25e3, E2 = 1e3, nu12 = 0.25, G12 = 500.0, G13 = 5e2, G23 = 2e2, angle = 90, thickness = 0.01, density = 6.0 }]
[geometry]
outline = { rectangle = [0.0, 0.0, 1.0, 0.6] }
[discretization]
formulation = "galerkin"
spacing = 0.06
[[support]]
kind = "simply_supported"
edges = ["left", "right", "top", "bottom"]
in_plane = "fixed"
)";

const std::string pressed = "[[load]]\nkind = 'pressure'\nvalue = 1e-3\n[output]\nprobes = { m = [0.5, 0.3] }\n";
const std::string swept =
    "[analysis]\nkind = 'harmonic'\nsweep = { from = 1e-4, to = 1.6, count = 3 }\n"
    "damping = { mass = 0.2 }\n";

post::Summary summary_of(const std::string& more, post::ResultsInMemory& results) {
  const auto file = cases::read_case_text(shaken + more, "shaken", {});
  return cases::run(file, {.folder = {}, .quiet = true, .in_memory = &results});
}

const post::Table& table(const post::ResultsInMemory& results, const std::string& name) {
  const auto found = std::ranges::find(results.tables, name, &std::pair<std::string, post::Table>::first);
  REQUIRE(found != results.tables.end());
  return found->second;
}

}  // namespace

TEST_CASE("coupled harmonic response: slow loads bend as at rest, reactions balance, the resonance is the frequency") {
  post::ResultsInMemory rest, slow, modes;
  summary_of(pressed + "[analysis]\nkind = 'static'\n", rest);
  const auto response = summary_of(pressed + swept, slow);
  const auto own = summary_of("[analysis]\nkind = 'frequencies'\nmodes = 1\n", modes);
  const auto& at_rest = table(rest, "probes");
  const double w = std::get<double>(at_rest.rows.at(0)[at_rest.column("w")]);
  const auto& found = table(slow, "response");
  double force = 0, amplitude = 0;
  for (const auto& row : found.rows) {
    if (std::get<double>(row[found.column("frequency")]) > 1e-3) continue;
    const double value = std::get<double>(row[found.column("amplitude")]);
    const auto place = std::get<std::string>(row[found.column("place")]),
               quantity = std::get<std::string>(row[found.column("quantity")]);
    if (place == "m" && quantity == "w") amplitude = value;
    if (place.starts_with("support") && quantity == "force") force += value;
  }
  INFO("w " << amplitude / std::abs(w) - 1 << ", force " << force / 6e-4 - 1);
  CHECK(amplitude == Approx(std::abs(w)).epsilon(1e-6));  // measured: 6e-9
  CHECK(force == Approx(1e-3 * 0.6).epsilon(1e-6));       // measured: 4e-9
  REQUIRE(response.resonances.size() == 1);
  const double resonance = response.resonances[0] / own.frequencies.at(0).frequency;
  INFO("resonance " << resonance - 1);
  CHECK(resonance == Approx(1).epsilon(1e-8));  // measured: 9e-13
}

TEST_CASE("coupled harmonic response: a plate that moves freely in its plane is refused") {
  std::string free = shaken;
  free.erase(free.find("in_plane"));
  const auto file = cases::read_case_text(free + pressed + swept, "free", {});
  post::ResultsInMemory results;
  CHECK_THROWS_AS(cases::run(file, {.folder = {}, .quiet = true, .in_memory = &results}), cases::CaseError);
}

namespace {

/// A clamped [0/90] plate under a mean temperature.
post::Summary clamped_summary(double mean, const std::string& analysis) {
  std::string text = shaken;
  text.replace(text.find("simply_supported"), std::string("simply_supported").size(), "clamped");
  for (auto at = text.find("thickness"); at != std::string::npos; at = text.find("thickness", at + 50))
    text.insert(at, "alpha1 = -1e-6, alpha2 = 3e-5, ");
  const auto heat = "[[load]]\nkind = 'temperature'\nmean = " + std::to_string(mean) + "\n";
  const auto file = cases::read_case_text(text + heat + analysis, "clamped", {});
  post::ResultsInMemory results;
  return cases::run(file, {.folder = {}, .quiet = true, .in_memory = &results});
}

}  // namespace

TEST_CASE("coupled heat: held plies buckle at the temperature at which their lowest frequency vanishes") {
  const std::string own = "[analysis]\nkind = 'frequencies'\nmodes = 1\n";
  const double cold = clamped_summary(1e-6, own).frequencies.at(0).frequency,
               critical = clamped_summary(1, "[analysis]\nkind = 'buckling'\nmodes = 1\n").buckling.at(0).factor,
               warm = clamped_summary(0.999 * critical, own).frequencies.at(0).frequency;
  INFO("critical " << critical << ", frequency " << warm / cold << " of the cold one");
  CHECK(warm < 0.05 * cold);
  CHECK_THROWS_AS(clamped_summary(1.001 * critical, own), NumericalError);
}

TEST_CASE("coupled heat: a warm strip with a cold rib on one side bends as the composite beam") {
  constexpr double half = 0.025, L = 1, h = 0.01, E = 1000, alpha = 1e-5, warm = 100;
  Section section{E, 0.3, h, 5.0 / 6, 2};
  section.thermal_expansion = alpha;
  auto c = rectangle(section, L, 2 * half, half / 4);
  auto hold = vp::held(SupportKind::in_plane, {});
  hold.points = {{L / 2, 0}, {L / 2, 2 * half}};
  c.supports = {vp::held(SupportKind::simply_supported, {"left", "right"}), hold};
  Stiffener rib;
  rib.along = {{0, half}, {L, half}};
  rib.axial = 0.3, rib.bending = 1e-5, rib.eccentricity = 0.03;
  c.stiffeners = {rib};
  c.loads = {Load{Temperature{.mean = warm}}};
  const auto made = discretise(c);
  const auto found = CoupledPlate(*made.plate, *made.membrane)
                         .equilibrium({made.plate->total_load(), made.membrane->total_load()}, {1e-9, 10, {}});
  const double EA = E * 2 * half * h, both = EA + rib.axial, first = rib.axial * rib.eccentricity,
               second = EA * h * h / 12 + rib.bending + first * rib.eccentricity;
  const double curvature = -EA * alpha * warm * first / (both * second - first * first);
  const double exact = curvature * L * L / 8, w = at(*made.plate, found.bending, {L / 2, half});
  INFO(w / exact - 1);
  CHECK(w == Approx(exact).epsilon(0.008));  // measured: +0.50 %
}
