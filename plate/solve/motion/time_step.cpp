#include <cmath>
#include <optional>
#include <random>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/algebra/dense.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/reduction.hpp"
#include "plate/solve/touched_plate.hpp"

namespace plate {
namespace {

Forces inverse_of(const Forces& mass) {
  return mass.unaryExpr([](double m) { return m > 0 ? 1 / m : 0.0; });
}

Forces root_of(const Forces& values) {
  return values.unaryExpr([](double value) { return std::sqrt(value); });
}

double dot(const Forces& a, const State& b) {
  return ordered_sum<1>(static_cast<std::size_t>(a.size()),
                        [&](std::size_t i) { return std::array<double, 1>{a.data()[i] * b.data()[i]}; })[0];
}

/// max over i of (|K| s)_i / (M_i s_i) for a positive s bounds the eigenvalues of M^-1 K. From s = M^(-1/2), scaled
/// Gershgorin, improved by a few products.
double collatz_bound(const Operator& plate, const Constraints& constraints, const Forces& mass) {
  constexpr int improvements = 3;
  const Forces inverse_mass = inverse_of(mass);
  State scale = root_of(inverse_mass);
  Forces product;
  double smallest_bound = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= improvements; ++i) {
    constraints.impose_absolute(scale);
    plate.absolute_product(scale, product);
    constraints.fold_absolute(product);
    const State next = product.cwiseProduct(inverse_mass);
    double bound = 0, largest = 0;
    for (Eigen::Index n = 0; n < next.size(); ++n)
      if (mass.data()[n] > 0) {
        bound = std::max(bound, next.data()[n] / scale.data()[n]);
        largest = std::max(largest, next.data()[n] * std::sqrt(mass.data()[n]));
      }
    smallest_bound = std::min(smallest_bound, largest_of_all(bound));
    scale = next / largest_of_all(largest);
  }
  return smallest_bound;
}

/// The largest eigenvalue of M^-1 K and a margin, by Lanczos's recursion without a basis: lost orthogonality repeats
/// eigenvalues, but does not make the largest larger. Nothing where it does not settle.
std::optional<double> lanczos_bound(const Operator& plate, const Constraints& constraints, const Forces& mass,
                                    State now) {
  constexpr double tolerance = 1e-3, margin = 0.01;
  constexpr std::size_t most = 400, check_every = 10;
  const Forces root = root_of(inverse_of(mass));
  now = (root.array() > 0).select(now, 0.0);
  State before = State::Zero(3, now.cols());
  now /= std::sqrt(dot(now, now));
  std::vector<double> alpha, beta;
  Forces forces;
  State scaled;
  while (alpha.size() < most) {
    scaled = root.cwiseProduct(now);
    constraints.impose(scaled);
    plate.internal_force(scaled, forces);
    constraints.fold(forces);
    State next = -root.cwiseProduct(forces);  // M^(-1/2) K M^(-1/2) now
    if (!beta.empty()) next -= beta.back() * before;
    alpha.push_back(dot(next, now));
    next -= alpha.back() * now;
    beta.push_back(std::sqrt(dot(next, next)));
    if (alpha.size() % check_every == 0) {
      const auto size = Eigen::Index(alpha.size());
      const Eigenpairs ritz = tridiagonal_eigenpairs(Eigen::Map<Eigen::VectorXd>(alpha.data(), size),
                                                     Eigen::Map<Eigen::VectorXd>(beta.data(), size - 1));
      const double largest = ritz.values[size - 1];
      if (beta.back() * std::abs(ritz.vectors(size - 1, size - 1)) < tolerance * largest) return largest * (1 + margin);
    }
    if (!(beta.back() > 0)) return std::nullopt;  // a plate so small that the space is exhausted
    before = std::move(now);
    now = next / beta.back();
  }
  return std::nullopt;
}

}  // namespace

double stable_time_step(const Operator& plate, const Constraints& constraints, const Forces& mass,
                        std::optional<State> start) {
  if (!start) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    start = mass.unaryExpr([&](double m) { return m > 0 ? uniform(random) : 0.0; });
  }
  const double bound = collatz_bound(plate, constraints, mass);
  return 2 / std::sqrt(std::min(bound, lanczos_bound(plate, constraints, mass, std::move(*start)).value_or(bound)));
}

std::optional<State> start_by_place(const Formulation& plate) {
  if (!ranks()) return std::nullopt;
  State start(3, Eigen::Index(plate.points()));
  for (Eigen::Index k = 0; k < start.cols(); ++k) {
    const auto [column, row] = geometry::cell_of(plate.boundary().lattice[std::size_t(k)]);
    std::seed_seq seed{std::uint32_t(column), std::uint32_t(row)};
    std::array<std::uint32_t, 3> random{};
    seed.generate(random.begin(), random.end());
    for (Eigen::Index c = 0; c < 3; ++c) start(c, k) = std::ldexp(double(random[std::size_t(c)]), -31) - 1;
  }
  return start;
}

double stable_time_step(const Formulation& plate, double rotary) {
  if (const auto& attached = plate.boundary().attached; attached.lifts_off())
    return stable_time_step(TouchedPlate(plate, attached, everywhere(attached)), plate.constraints(),
                            plate.mass(rotary), start_by_place(plate));
  return stable_time_step(plate, plate.constraints(), plate.mass(rotary), start_by_place(plate));
}

}  // namespace plate
