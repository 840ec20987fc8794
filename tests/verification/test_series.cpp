// Plates without cracks against closed forms: deflections under pressure, the first natural frequency.
#include <fstream>
#include <sstream>

#include "geometry/lattice/cloud.hpp"
#include "tests/catch.hpp"
#include "tests/verification/exact.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

/// First natural frequency [1/time] by inverse iteration: K x_next = M x.
double first_frequency(const cases::Case& c) {
  const auto a = vp::assembled(c);
  const auto& constraints = a->constraints();
  const Forces mass = a->mass();
  State x = vp::field(*a, [](const geometry::Point&) { return Eigen::Vector3d(1, 0, 0); });
  double eigenvalue = 0, before = 1;
  for (int i = 0; i < 30 && std::abs(eigenvalue / before - 1) > 1e-7; ++i) {
    before = eigenvalue;
    const auto next = conjugate_gradients(*a, constraints, mass.cwiseProduct(x), {1e-9, 20000, {}});
    REQUIRE(next.converged);
    x = next.state / next.state.cwiseAbs().maxCoeff();
    eigenvalue = 2 * a->energies(x).sum() / x.cwiseProduct(mass.cwiseProduct(x)).sum();
  }
  return std::sqrt(eigenvalue) / (2 * std::numbers::pi);
}

/// Deflection of a plate under unit pressure at its points next to (0, 0) and (0.3, -0.5) [exact, computed].
std::vector<std::pair<geometry::Point, double>> deflections(const cases::Case& c) {
  const auto a = vp::assembled(c);
  const auto solution = vp::solved(*a);
  REQUIRE(solution.converged);
  std::vector<std::pair<geometry::Point, double>> result;
  for (const geometry::Point& x : {geometry::Point(0.01, 0.01), geometry::Point(0.3, -0.5)}) {
    const auto k = geometry::nearest_plate_point(a->cloud(), x);
    result.emplace_back(a->cloud().positions[k], solution.state(0, Eigen::Index(k)));
  }
  return result;
}

double series_error(double spacing, VolumeCorrection volume) {
  auto c = vp::square(spacing);
  c.discretization.volume_correction = volume;
  c.supports = {vp::held_all_round(SupportKind::simply_supported_hard)};
  double worst = 0;
  for (const auto& [x, w] : deflections(c)) {
    const double exact = exact::navier_deflection(c.section, 2, 2, 1, x.x() + 1, x.y() + 1);
    if (std::abs(w / exact - 1) > std::abs(worst)) worst = w / exact - 1;
  }
  return worst;
}

/// A number of cases/references/frequencies.csv.
double reference_frequency(const std::string& name, int mode) {
  std::ifstream file(PDPLATE_SOURCE_DIR "/cases/references/frequencies.csv");
  for (std::string line; std::getline(file, line);)
    if (line.rfind(name + "," + std::to_string(mode) + ",", 0) == 0) {
      std::istringstream row(line);
      std::string value;
      for (int column = 0; column < 3; ++column) std::getline(row, value, ',');
      return std::stod(value);
    }
  FAIL("no row " << name << ", mode " << mode);
  return 0;
}

/// The plate of Dai et al., section 4.2, without supports.
cases::Case steel(double spacing) {
  auto c = vp::square(spacing);
  c.section = {200e9, 0.3, 0.1, 5.0 / 6, 7850};
  return c;
}

}  // namespace

TEST_CASE("hard simple supports: deflection against Navier's series at three spacings") {
  std::vector<double> error;
  for (const double spacing : {0.1, 0.05, 0.025})
    error.push_back(series_error(spacing, VolumeCorrection::lattice_fitted));
  CAPTURE(error);
  CHECK(std::abs(error[0]) < 0.03);             // measured: -2.01 %
  CHECK(std::abs(error[1]) < 0.006);            // measured: -0.38 %
  CHECK(std::abs(error[2]) < 0.0015);           // measured: -0.088 %
  CHECK(std::log2(error[0] / error[1]) > 1.8);  // measured: 2.39
  CHECK(std::log2(error[1] / error[2]) > 1.8);  // measured: 2.12
}

TEST_CASE("linear volumes: the series is approached up to the lattice's anisotropy") {
  const double error = series_error(0.025, VolumeCorrection::linear);
  CAPTURE(error);
  CHECK(std::abs(error) < 0.004);  // measured: -0.26 %, of it -0.17 % by the anisotropy
}

TEST_CASE("clamped square: deflection at the centre") {
  // w D / (p L^4) of the Mindlin plate, h / L = 0.05, by the method of Ritz
  constexpr double reference = 1.32726e-3;
  std::vector<double> error;
  for (const int cells : {21, 41, 81}) {  // odd: a point at the centre
    auto c = vp::square(2.0 / cells);
    c.discretization.volume_correction = VolumeCorrection::lattice_fitted;
    c.supports = {vp::held_all_round(SupportKind::clamped)};
    const auto a = vp::assembled(c);
    const auto solution = vp::solved(*a);
    REQUIRE(solution.converged);
    const auto centre = geometry::nearest_plate_point(a->cloud(), {0, 0});
    REQUIRE(a->cloud().positions[centre].norm() < 1e-9);
    error.push_back(solution.state(0, Eigen::Index(centre)) * c.section.bending_stiffness() / 16 / reference - 1);
  }
  CAPTURE(error);
  CHECK(std::abs(error[0]) < 0.06);                                  // measured: -5.2 %
  CHECK(std::abs(error[1]) < 0.014);                                 // measured: -1.21 %
  CHECK(std::abs(error[2]) < 0.0036);                                // measured: -0.31 %
  CHECK(std::log(error[0] / error[1]) / std::log(41.0 / 21) > 1.9);  // measured: 2.17
  CHECK(std::log(error[1] / error[2]) / std::log(81.0 / 41) > 1.9);  // measured: 2.01
}

TEST_CASE("hard simple supports: first natural frequency against Mindlin's equation") {
  std::vector<double> error;
  for (const double spacing : {0.1, 0.05}) {
    auto c = steel(spacing);
    c.discretization.volume_correction = VolumeCorrection::lattice_fitted;
    c.supports = {vp::held_all_round(SupportKind::simply_supported_hard)};
    error.push_back(first_frequency(c) / exact::natural_frequency(c.section, 2, 2, 1, 1) - 1);
  }
  CAPTURE(error);
  CHECK(std::abs(error[0]) < 0.014);  // measured: +1.09 %
  CHECK(std::abs(error[1]) < 0.003);  // measured: +0.21 %
}

TEST_CASE("clamped plate with a crack: first natural frequency against the reference") {
  auto c = steel(0.02);
  c.supports = {vp::held_all_round(SupportKind::clamped)};
  c.cracks = {{{-0.1, 0}, {0.1, 0}}};
  const double error = first_frequency(c) / reference_frequency("4.2_clamped", 1) - 1;
  CAPTURE(error);
  CHECK(std::abs(error) < 0.0025);  // measured: +0.18 %
}
