// Frequencies and buckling of plates whose bending and stretching are coupled: Navier's solutions of antisymmetric
// cross-ply squares, strips in cylindrical bending, beams with a rib on one side.
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "cases/input/case_file.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/coupled_modes.hpp"
#include "tests/verification/sections/laminates.hpp"

using namespace plates_of_sections;
using namespace laminates;

namespace {

/// [0/90] of the thickness h, the plies of these densities.
Section cross_ply(double h, double below = 2, double above = 2) {
  auto result = of_plies({ply(0, h / 2), ply(90, h / 2)});
  result.plies[0].density = below, result.plies[1].density = above;
  return result;
}

/// A unit square on the supports SS-1 of Navier's solution, turned with its plies [degrees].
cases::Case square(Section section, int n, double degrees = 0) {
  for (auto& one : section.plies) one.angle += degrees;
  auto c = rectangle(section, 1, 1, 1.0 / n);
  const Eigen::Rotation2Dd turn(degrees * pi / 180);
  for (auto& x : c.outline.outer.vertices) x = turn * x;
  c.supports = {vp::held_all_round(SupportKind::simply_supported_hard)};
  c.supports[0].in_plane = InPlane::tangential;
  return c;
}

FrequencyOptions options_of(const cases::Case& c, std::size_t modes) {
  FrequencyOptions result;
  result.modes = modes, result.tolerance = 1e-8, result.shift = shift_of(c.section, 1);
  return result;
}

std::vector<Mode> frequencies_of(const cases::Case& c, std::size_t modes) {
  const auto made = discretise(c);
  const auto found = coupled_frequencies(*made.plate, *made.membrane, 1, nullptr, options_of(c, modes));
  for (const auto& mode : found.modes) CHECK(mode.residual < 1e-6);
  REQUIRE(found.modes.size() == modes);
  return found.modes;
}

/// Lowest frequency of the wave m, n of Navier's solution; the force per length N presses along x.
double navier_frequency(const Section& section, int m, int n, double N = 0) {
  double mass = 0, first = 0, second = 0, z = -section.thickness / 2;
  for (const auto& one : section.plies) {
    const double end = z + one.thickness, rho = one.density.value_or(section.density);
    mass += rho * (end - z), first += rho * (end * end - z * z) / 2, second += rho * (end * end * end - z * z * z) / 3;
    z = end;
  }
  Matrix5 K = navier_stiffness(section, 1, 1, m, n), M = Matrix5::Zero();
  K(2, 2) -= N * m * m * pi * pi;
  M.diagonal() << mass, mass, mass, second, second;
  M(0, 3) = M(3, 0) = M(1, 4) = M(4, 1) = first;
  return std::sqrt(Eigen::GeneralizedSelfAdjointEigenSolver<Matrix5>(K, M).eigenvalues()[0]) / (2 * pi);
}

/// Stiffness of deflections under one membrane force per length along x.
PointMatrix pressed(const Formulation& membrane, double N) {
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, Eigen::Index(membrane.points()));
  forces.row(0).setConstant(-N);
  return membrane.stretching()->stiffness_of_forces(forces);
}

}  // namespace

TEST_CASE("coupled modes: Navier's frequencies of a [0/90] square") {
  for (const double h : {0.1, 0.01}) {
    const auto modes = frequencies_of(square(cross_ply(h), 40), 1);
    const double error = modes[0].frequency / navier_frequency(cross_ply(h), 1, 1) - 1;
    INFO("h = " << h << ": " << error);
    CHECK(std::abs(error) < 0.0015);  // measured: 0.085, 0.078 %
    CHECK(modes[0].share_in_plane > h * h / 2);
    CHECK(modes[0].share_in_plane < 2 * h * h);  // measured: 0.81, 1.09
    CHECK(modes[0].shape.row(0).cwiseAbs().maxCoeff() == 1);
    CHECK(modes[0].in_plane.cwiseAbs().maxCoeff() > 0.5 * h);  // measured: 0.64, 0.74
  }
}

TEST_CASE("coupled modes: mass off the middle plane parts the double frequency of a [0/90] square") {
  const auto section = cross_ply(0.1, 2, 20);
  const auto modes = frequencies_of(square(section, 24), 3);
  const auto [low, high] = std::minmax({navier_frequency(section, 1, 2), navier_frequency(section, 2, 1)});
  CHECK(high / low > 1.005);
  INFO(modes[1].frequency / low - 1 << ", " << modes[2].frequency / high - 1);
  CHECK(modes[1].frequency == Approx(low).epsilon(0.01));                                // measured: 0.72 %
  CHECK(modes[2].frequency == Approx(high).epsilon(0.01));                               // measured: 0.71 %
  CHECK(modes[2].frequency / modes[1].frequency == Approx(high / low).epsilon(0.0005));  // measured: 3e-5
}

TEST_CASE("coupled modes: stiff plates swing as soft ones, at higher frequencies") {
  auto stiff = cross_ply(0.05);
  for (auto& one : stiff.plies)
    for (double* modulus : {&one.E1, &one.E2, &one.G12, &one.G13, &one.G23}) *modulus *= 1e12;
  const auto plain = frequencies_of(square(cross_ply(0.05), 16), 3), high = frequencies_of(square(stiff, 16), 3);
  for (std::size_t i = 0; i < plain.size(); ++i)
    CHECK(high[i].frequency == Approx(1e6 * plain[i].frequency).epsilon(1e-6));
  auto c = square(of_plies({ply(0, 0.01), ply(90, 0.01), ply(0, 0.01)}), 16);
  const auto alone = [&](double factor) {
    for (auto& one : c.section.plies)
      for (double* modulus : {&one.E1, &one.E2, &one.G12, &one.G13, &one.G23}) *modulus *= factor;
    const auto plate = discretise(c).plate;
    auto options = options_of(c, 2);
    const auto inverse = plate->inverse_of_shifted(options.shift);
    options.preconditioner = inverse.get();
    return frequencies(*plate, plate->constraints(), plate->mass(), options).modes;
  };
  const auto soft = alone(1), stiffer = alone(1e12);
  for (std::size_t i = 0; i < soft.size(); ++i)
    CHECK(stiffer[i].frequency == Approx(1e6 * soft[i].frequency).epsilon(1e-6));
}

TEST_CASE("coupled modes: a plate turned with its plies has the same frequencies") {
  const auto plain = frequencies_of(square(cross_ply(0.05), 30), 3);
  const auto turned = frequencies_of(square(cross_ply(0.05), 30, 27), 3);
  for (std::size_t i = 0; i < plain.size(); ++i)
    CHECK(turned[i].frequency == Approx(plain[i].frequency).epsilon(0.0005));  // measured: 0.015 %
}

TEST_CASE("coupled modes: without coupling they are those of the plate alone") {
  auto c = square(of_plies({ply(0, 0.01), ply(90, 0.01), ply(0, 0.01)}), 20);
  const auto plate = discretise(c).plate;
  const auto plane = plate->middle_plane();
  const auto options = options_of(c, 4);
  const auto inverse = plate->inverse_of_shifted(options.shift);
  auto alone = options;
  alone.preconditioner = inverse.get();
  const auto expected = frequencies(*plate, plate->constraints(), plate->mass(), alone).modes;
  const auto found = coupled_frequencies(*plate, *plane, 1, nullptr, options).modes;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(found[i].frequency == Approx(expected[i].frequency).epsilon(1e-9));
    CHECK(found[i].share_in_plane < 1e-12);
  }
}

TEST_CASE("coupled modes: a free plate has the rigid motions across it, and none in its plane") {
  auto c = square(cross_ply(0.05, 2, 6), 12);
  c.supports.clear();
  const auto modes = frequencies_of(c, 5);
  for (const int i : {0, 1, 2}) CHECK(modes[std::size_t(i)].frequency < 1e-4 * modes[3].frequency);
  CHECK(modes[3].shape.row(0).cwiseAbs().maxCoeff() == 1);
}

TEST_CASE("coupled modes: buckling of a [0/90] square, and its frequency below") {
  for (const double h : {0.1, 0.01}) {
    const auto section = cross_ply(h);
    const double exact = 1 / (pi * pi * navier_stiffness(section, 1, 1, 1, 1).inverse()(2, 2));
    const auto c = square(section, 40);
    const auto made = discretise(c);
    const auto modes = coupled_buckling(*made.plate, *made.membrane, pressed(*made.membrane, exact), 2, 1e-8);
    INFO("h = " << h << ": " << modes[0].factor - 1);
    CHECK(std::abs(modes[0].factor - 1) < 0.003);  // measured: 0.24, 0.25 %
    CHECK(modes[0].residual < 1e-6);
    CHECK(modes[0].in_plane.cwiseAbs().maxCoeff() > 0.01 * h);
    const auto half = pressed(*made.membrane, exact / 2), twice = pressed(*made.membrane, 2 * exact);
    const auto options = options_of(c, 1);
    const double frequency = coupled_frequencies(*made.plate, *made.membrane, 1, &half, options).modes[0].frequency;
    CHECK(frequency == Approx(navier_frequency(section, 1, 1, exact / 2)).epsilon(0.001));  // measured: 0.048 %
    CHECK_THROWS_AS(coupled_frequencies(*made.plate, *made.membrane, 1, &twice, options), NumericalError);
  }
}

TEST_CASE("coupled modes: a clamped [0/90] strip stays flat and buckles by D11 - B11^2 / A11") {
  const double h = 0.02, length = 1;
  auto c = rectangle(cross_ply(h), length, 0.1, 1.0 / 80);
  const auto edges = c.outline.outer.edge_names;  // bottom, right, top, left
  c.supports = {vp::held(SupportKind::symmetry, {edges[0], edges[2]}), vp::held(SupportKind::clamped, {edges[1]}),
                vp::held(SupportKind::clamped, {edges[3]})};
  c.supports[2].in_plane = InPlane::fixed;
  c.loads = {Load{EdgeTraction{{edges[1]}, -1}}};
  const auto made = discretise(c);
  const auto [at_rest, geometric] = coupled_prestress(*made.plate, *made.membrane);
  CHECK(at_rest.bending.row(0).cwiseAbs().maxCoeff() < 1e-9 * at_rest.membrane.cwiseAbs().maxCoeff());
  const Matrix6 K = laminate(c.section);
  const double euler = 4 * pi * pi * (K(3, 3) - K(0, 3) * K(0, 3) / K(0, 0)) / (length * length);
  const double shear = 5.0 / 6 * h / 2 * (500 + 200);
  const double factor = coupled_buckling(*made.plate, *made.membrane, geometric, 1, 1e-8)[0].factor;
  INFO(factor * (1 / euler + 1 / shear) - 1);
  CHECK(factor == Approx(1 / (1 / euler + 1 / shear)).epsilon(0.002));  // measured: 0.088 %
}

namespace {

constexpr double young = 1000, density = 2, depth = 0.01, width = 0.05, rib_axial = 0.3, rib_bending = 1e-5;

/// A strip of length 1 with a rib along it, simply supported at both ends, turned [degrees].
cases::Case ribbed_strip(double eccentricity, double mass, double degrees) {
  const Eigen::Rotation2Dd turn(degrees * pi / 180);
  auto c = rectangle({young, 0.3, depth, 5.0 / 6, density}, 1, width, width / 8);
  c.outline.outer.vertices = {{0, -width / 2}, {1, -width / 2}, {1, width / 2}, {0, width / 2}};
  for (auto& x : c.outline.outer.vertices) x = turn * x;
  c.outline.outer.edge_names = {"below", "right", "above", "left"};
  c.supports = {vp::held(SupportKind::simply_supported, {"left", "right"})};
  Stiffener rib;
  rib.along = {turn * Point(0, 0), turn * Point(1, 0)};
  rib.axial = rib_axial, rib.bending = rib_bending, rib.eccentricity = eccentricity, rib.mass = mass;
  c.stiffeners = {rib};
  return c;
}

}  // namespace

TEST_CASE("coupled modes: a strip with an eccentric rib swings as the composite beam") {
  const double axial = young * width * depth, own = density * width * depth;
  for (const auto& [mass, degrees] : {std::pair(0.0, 0.0), std::pair(1e-3, 27.0)}) {
    const double e = 0.03, axis = rib_axial * e / (axial + rib_axial);
    const double bending =
        axial * depth * depth / 12 + rib_bending + axial * axis * axis + rib_axial * (e - axis) * (e - axis);
    const double rotary = own * (depth * depth / 12 + axis * axis) + mass * (e - axis) * (e - axis);
    const double exact = pi / 2 * std::sqrt(bending / (own + mass + pi * pi * rotary));
    const double found = frequencies_of(ribbed_strip(e, mass, degrees), 1)[0].frequency;
    INFO("mass " << mass << ", " << degrees << " degrees: " << found / exact - 1);
    CHECK(found == Approx(exact).epsilon(0.003));  // measured: 0.20, 0.14 %
  }
}

TEST_CASE("coupled modes: the axial force of a rib buckles it with the strip") {
  auto c = ribbed_strip(0, 0, 0);
  CHECK_FALSE(c.coupled());
  c.loads = {Load{EdgeTraction{{"left", "right"}, -1 / width}}};
  auto hold = vp::held(SupportKind::in_plane, {});
  hold.points = {{0.5, -width / 2}, {0.5, width / 2}};
  c.supports.push_back(hold);
  const auto made = discretise(c);
  const double factor = buckling(*made.plate, prestress(*made.membrane), 1, 1e-8)[0].factor;
  const double exact = pi * pi * (young * width * depth * depth * depth / 12 + rib_bending);
  INFO(factor / exact - 1);
  CHECK(factor == Approx(exact).epsilon(0.002));  // measured: 0.015 %
}
