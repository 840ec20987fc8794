#include "plate/formulation/bond_law.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

using namespace plate;

namespace {

/// Two points with one bond: what each end gives to it, and its area.
struct End {
  double a, D, B, S, area;
};

constexpr double weight = 0.7;
const End ends[2] = {{2.0, 0.3, 1.1, 5.0, 0.8}, {-1.5, 0.4, 0.9, 7.0, 0.6}};

BondShape along(double angle, double length) {
  return {std::sin(angle), -std::cos(angle), length, weight};
}

BondShape reversed(const BondShape& bond) {
  return {-bond.mx, -bond.my, bond.length, bond.weight};
}

double dilatation(const End& own, const BondShape& bond, const Kinematics<>& k, const Kinematics<>& j) {
  return own.D * curvature_difference(bond, k, j);
}

/// Energy of the pair, both points' bookings (Dai 1, 2 with a single bond in each family).
double energy(const BondShape& bond, const Kinematics<> (&u)[2]) {
  double sum = 0;
  for (int k : {0, 1}) {
    const BondShape own = k == 0 ? bond : reversed(bond);
    const Kinematics<>&from = u[k], &to = u[1 - k];
    const double theta = dilatation(ends[k], own, from, to);
    sum += ends[k].area *
           (ends[k].a * theta * theta +
            bond_energy(ends[k].B, ends[k].S, curvature_difference(own, from, to), shear_difference(own, from, to)));
  }
  return sum;
}

BondForce<double> force(const BondShape& bond, int k, const Kinematics<> (&u)[2]) {
  const Kinematics<>&from = u[k], &to = u[1 - k];
  const BondShape back = reversed(bond);
  const End &own = ends[k], &other = ends[1 - k];
  const double q_k = 2 * own.area * own.a * dilatation(own, bond, from, to);
  const double q_j = 2 * other.area * other.a * dilatation(other, back, to, from);
  return bond_force(bond.length, own.D, other.D, 2 * (own.area * own.B + other.area * other.B),
                    2 * (own.area * own.S + other.area * other.S), q_k, q_j, curvature_difference(bond, from, to),
                    shear_difference(bond, from, to));
}

}  // namespace

TEST_CASE("bond force is minus the derivative of the pair's energy") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double largest = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const BondShape bond = along(3.2 * uniform(random), 1.5 + uniform(random));
    Kinematics<> u[2];
    for (auto& end : u) end = {uniform(random), uniform(random), uniform(random)};
    for (int k : {0, 1}) {
      const BondShape own = k == 0 ? bond : reversed(bond);
      const BondForce<double> f = force(own, k, u);
      const double expected[] = {f.force, own.mx * f.couple, own.my * f.couple};
      double Kinematics<>::*const component[] = {&Kinematics<>::w, &Kinematics<>::theta_x, &Kinematics<>::theta_y};
      for (int c = 0; c < 3; ++c) {
        Kinematics<> plus[2] = {u[0], u[1]}, minus[2] = {u[0], u[1]};
        plus[k].*component[c] += 0.5;  // any step: the energy is quadratic
        minus[k].*component[c] -= 0.5;
        largest = std::max(largest, std::abs(expected[c] + energy(bond, plus) - energy(bond, minus)));
      }
    }
  }
  CHECK(largest > 0);
  CHECK(largest < 1e-13);  // measured: 4e-15, forces up to 10
}

TEST_CASE("a bond moved as a rigid body has neither curvature nor shear") {
  const BondShape bond = along(0.7, 2);
  const auto rigid = [](double x, double y) {  // w = 3 + 0.2 x - 0.5 y; psi = grad w = (-theta_y, theta_x)
    return Kinematics<>{3 + 0.2 * x - 0.5 * y, -0.5, -0.2};
  };
  const auto k = rigid(1, 1), j = rigid(1 + 2 * std::cos(0.7), 1 + 2 * std::sin(0.7));
  CHECK(curvature_difference(bond, k, j) == 0);
  CHECK(std::abs(shear_difference(bond, k, j)) < 1e-15);  // measured: 2e-16
}

TEST_CASE("a bond in constant curvature has that curvature and no shear") {
  const double angle = 0.7, length = 2, kappa = 0.3;  // w = kappa x^2 / 2, psi_x = kappa x
  const BondShape bond = along(angle, length);
  const double x = length * std::cos(angle);
  const Kinematics<> k{0, 0, 0}, j{kappa * x * x / 2, 0, -kappa * x};
  CHECK(curvature_difference(bond, k, j) == Approx(length * kappa * std::pow(std::cos(angle), 2)).epsilon(1e-14));  // 0
  CHECK(std::abs(shear_difference(bond, k, j)) < 1e-15);  // measured: 0
}

TEST_CASE("forces of the two ends are opposite, couples in balance with them") {
  const BondShape bond = along(-1.1, 1.3);
  const Kinematics<> u[2] = {{0.2, -0.4, 0.5}, {-0.3, 0.1, 0.7}};
  const BondForce<double> on_k = force(bond, 0, u), on_j = force(reversed(bond), 1, u);
  CHECK(on_k.force == Approx(-on_j.force).epsilon(1e-14));
  // about k: psi-couples n . (c_k + c_j) plus the lever of the force on j
  CHECK(std::abs(on_k.couple - on_j.couple + bond.length * on_j.force) < 1e-14);  // measured: 0
}
