#include "cases/papers/bodies/moving_bar.hpp"

#include <Eigen/LU>

#include "cases/papers/bodies/equilibrium.hpp"
#include "cases/papers/bodies/fractions.hpp"

namespace boundary_bodies {
namespace {

constexpr double wave_speed = 5000, bar_horizon = 0.1;  // length 1
constexpr int bar_ratio = 100;

/// Si(x) by Simpson's rule.
double sine_integral(double x) {
  double sum = 0;
  const int parts = 20 + int(10 * x);
  const double h = x / parts;
  const auto sinc = [](double t) { return t < 1e-8 ? 1 : std::sin(t) / t; };
  for (int i = 0; i < parts; ++i) sum += h / 6 * (sinc(i * h) + 4 * sinc((i + 0.5) * h) + sinc((i + 1) * h));
  return sum;
}

double pull_over(double length, double fraction) {
  return wave_speed * wave_speed / (bar_horizon * length * length) * fraction * moving_bar_spacing;
}

/// Accelerations of the nodes and the flux through the upper end as rows over nodes and, behind them, surface nodes
/// or fictitious nodes.
struct BarRows {
  plate::WeightRows accelerations;
  Eigen::VectorXd flux;
};

/// Rows of bonds over all nodes, fictitious ones too.
BarRows bonds_of_bar(const plate::LatticeBody& body, double kernel) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd flux = Eigen::VectorXd::Zero(body.count());
  for (int i = 0; i < body.count(); ++i)
    for (const auto& [away, fraction] : family_of(1, bar_ratio)) {
      const int j = body.node(body.nodes[std::size_t(i)] + away);
      if (j < 0) continue;
      const double pull = kernel * pull_over(moving_bar_spacing * away[0], fraction);
      if (i < body.real) entries.emplace_back(i, j, pull), entries.emplace_back(i, i, -pull);
      for (const auto& crossing : plate::crossings(body, i, j, plate::FluxRule::crossing_point))
        if (crossing.surface == 1) flux[j] += crossing.share * pull, flux[i] -= crossing.share * pull;
    }
  plate::WeightRows rows(body.real, body.count());
  rows.setFromTriplets(entries.begin(), entries.end());
  return {rows, flux};
}

BarRows rows_with_surface_nodes(const MovingBar& way) {
  const auto body = box_body({moving_bar_nodes}, bar_ratio);
  const plate::WeightRows expanded = plate::extrapolation(body, plate::Centre::surface_node, way.order);
  const auto bar = bonds_of_bar(body, way.kernel);
  return {bar.accelerations * expanded, expanded.transpose() * bar.flux};
}

/// Rows without fictitious nodes, the first node held.
BarRows bare_rows(double kernel) {
  const int n = moving_bar_nodes;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 1; i < n; ++i)
    for (const auto& [away, fraction] : family_of(1, bar_ratio)) {
      const int j = i + away[0];
      if (j < 0 || j >= n) continue;
      const double pull = kernel * pull_over(moving_bar_spacing * away[0], fraction);
      entries.emplace_back(i, j, pull), entries.emplace_back(i, i, -pull);
    }
  plate::WeightRows rows(n, n + 2);
  rows.setFromTriplets(entries.begin(), entries.end());
  return {rows, Eigen::VectorXd::Unit(n + 2, n + 1)};
}

/// Conditions that multipliers hold: value at 0, flux at the end; 2 x nodes, of length 1.
struct HeldBar {
  plate::WeightRows accelerations;
  Eigen::MatrixXd conditions;
};

HeldBar rows_with_multipliers(const MovingBar& way) {
  const auto body = box_body({moving_bar_nodes}, bar_ratio);
  const plate::WeightRows expanded = plate::extrapolation(body, plate::Centre::real_node, way.order);
  const auto bar = bonds_of_bar(body, way.kernel);
  Eigen::MatrixXd conditions(2, moving_bar_nodes);
  conditions.row(0) = plate::surface_values(body, way.order).row(0);
  conditions.row(1) = (expanded.transpose() * bar.flux).transpose();
  conditions.rowwise().normalize();
  return {bar.accelerations * expanded, conditions};
}

Eigen::VectorXd hump_of_nodes() {
  Eigen::VectorXd u(moving_bar_nodes);
  for (int i = 0; i < moving_bar_nodes; ++i) u[i] = moving_bar_hump((i + 0.5) * moving_bar_spacing);
  return u;
}

BarInstant looked_at(int step, const Eigen::VectorXd& u) {
  const Eigen::VectorXd exact = moving_bar_series(step * moving_bar_step), off = u - exact;
  return {step, u, off.cwiseAbs().maxCoeff(), off.norm() / exact.norm()};
}

bool is_asked(const std::vector<int>& steps, int n) {
  return std::ranges::find(steps, n) != steps.end();
}

std::vector<BarInstant> motion_of(const BarRows& bar, const std::vector<int>& steps) {
  constexpr int n = moving_bar_nodes;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(n + 2);
  u.head(n) = hump_of_nodes();
  u[n + 1] = moving_bar_hump(1);
  if (bar.accelerations.row(0).nonZeros() == 0) u[0] = 0;
  const auto free_end = [&] { u[n + 1] -= bar.flux.dot(u) / bar.flux[n + 1]; };  // ScaDyn 5: no flux
  free_end();
  Eigen::VectorXd velocity = moving_bar_step / 2 * (bar.accelerations * u);  // half a step on
  std::vector<BarInstant> result;
  for (int step = 1; step <= steps.back(); ++step) {
    u.head(n) += moving_bar_step * velocity;
    free_end();
    velocity += moving_bar_step * (bar.accelerations * u);
    if (is_asked(steps, step)) result.push_back(looked_at(step, u.head(n)));
  }
  return result;
}

/// Multipliers take away the part of the accelerations that would break the conditions.
std::vector<BarInstant> motion_of(const HeldBar& bar, const std::vector<int>& steps) {
  const Eigen::MatrixXd& C = bar.conditions;
  const Eigen::Matrix2d inverse_square = Eigen::Matrix2d(C * C.transpose()).inverse();
  const auto keep = [&](Eigen::VectorXd v) -> Eigen::VectorXd { return v - C.transpose() * inverse_square * (C * v); };
  Eigen::VectorXd u = keep(hump_of_nodes());
  Eigen::VectorXd velocity = moving_bar_step / 2 * keep(bar.accelerations * u);
  std::vector<BarInstant> result;
  for (int step = 1; step <= steps.back(); ++step) {
    u += moving_bar_step * velocity;
    velocity += moving_bar_step * keep(bar.accelerations * u);
    if (!is_asked(steps, step)) continue;
    result.push_back(looked_at(step, u));
    result.back().violated = (C * u).cwiseAbs().maxCoeff();
  }
  return result;
}

}  // namespace

double moving_bar_hump(double x) {
  return 0.02 * std::exp(-100 * (x - 0.5) * (x - 0.5));
}

Eigen::VectorXd moving_bar_series(double time) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(moving_bar_nodes);
  for (int m = 1; m <= 80; m += 2) {
    const double k = m * std::numbers::pi / 2, kd = k * bar_horizon;
    const double frequency =
        wave_speed * std::sqrt(2 / (bar_horizon * bar_horizon) * (kd * sine_integral(kd) + std::cos(kd) - 1));
    const double size =
        0.004 * std::sqrt(std::numbers::pi) * std::sin(k / 2) * std::exp(-k * k / 400) * std::cos(frequency * time);
    for (int i = 0; i < moving_bar_nodes; ++i) u[i] += size * std::sin(k * (i + 0.5) * moving_bar_spacing);
  }
  return u;
}

std::vector<BarInstant> moving_bar(const MovingBar& way, const std::vector<int>& steps) {
  if (way.ends == BarEnds::multiplied) return motion_of(rows_with_multipliers(way), steps);
  return motion_of(way.ends == BarEnds::bare ? bare_rows(way.kernel) : rows_with_surface_nodes(way), steps);
}

}  // namespace boundary_bodies
