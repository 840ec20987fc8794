#include "cases/papers/bodies/bars.hpp"

#include "cases/papers/bodies/equilibrium.hpp"
#include "cases/papers/bodies/fractions.hpp"

namespace boundary_bodies {
namespace {

constexpr double bar_young = 1e9, bar_poisson = 0.3, bar_area = 0.01, bar_load = 1e6;  // Sca21, table 3

}  // namespace

std::vector<BarProblem> bar_problems() {
  constexpr double E = bar_young, pi = std::numbers::pi;
  constexpr int any = 99;
  const auto none = [](double) { return 0.0; };
  return {{.name = "5.1 clamped bar under traction",
           .end_force = 1e4,
           .load = none,
           .local = [](double x) { return 1e4 * x / (E * bar_area); },  // Sca21 65
           .degree = 1},
          {.name = "5.2 clamped bar under a uniform load",
           .end_force = 0,
           .load = [](double) { return bar_load; },
           .local = [](double x) { return bar_load / E * (x - x * x / 2); },  // Sca21 66
           .degree = 2},
          {.name = "5.3 clamped bar under a linear load",
           .end_force = 0,
           .load = [](double x) { return bar_load * x; },
           .local = [](double x) { return bar_load / E * (x / 2 - x * x * x / 6); },  // Sca21 67
           .degree = 3},
          {.name = "5.4 clamped bar under a sinusoidal load",
           .end_force = 0,
           .load = [](double x) { return bar_load * std::sin(pi * x); },
           .local = [](double x) { return bar_load / E / (pi * pi) * (pi * x + std::sin(pi * x)); },  // Sca21 68
           .degree = any}};
}

Solid bar_of_table_3() {
  return {.body = box_body({20}, 3),
          .material = bar_material(bar_young, bar_poisson),
          .family = family_of(1, 3),
          .spacing = 0.05,
          .horizon = 3,
          .section = bar_area,
          .influence = inverse};
}

Eigen::VectorXd bar_forces(const Solid& bar, const BarProblem& p) {
  Eigen::VectorXd f(bar.body.real + 2);
  for (int k = 0; k < bar.body.real; ++k) f[k] = p.load(bar.at(k)[0]) * bar.volume();
  f.tail(2) << 0, p.end_force;  // at 0, at the end
  return f;
}

BarSolution bar_with_multipliers(const BarProblem& p, int order) {
  const Solid s = bar_of_table_3();
  const plate::WeightRows rows = stiffness(s, plate::Centre::real_node, order);
  plate::WeightRows B(2, s.body.real);  // surface node 0 at x = 0, 1 at the end
  B.topRows(1) = plate::surface_values(s.body, order).topRows(1);
  B.bottomRows(1) = rows.bottomRows(1);
  const auto solution =
      solution_with_multipliers(plate::SparseStiffness(rows.topRows(s.body.real)), plate::SparseStiffness(B),
                                bar_forces(s, p).head(s.body.real), Eigen::Vector2d(0, p.end_force));
  return {solution.values, (rows * solution.values)[s.body.real], solution.multipliers.cwiseAbs()};
}

BarSolution bar_with_surface_nodes(const BarProblem& p, int order) {
  const Solid s = bar_of_table_3();
  const auto K = stiffness(s, plate::Centre::surface_node, order);
  const auto solution = constrained_solution(K, bar_forces(s, p), {{s.body.real, 0.0}});
  return {solution.values.head(s.body.real), solution.reactions[0]};
}

BarSolution uncorrected_bar(const BarProblem& p) {
  const Solid s = bar_of_table_3();
  Eigen::VectorXd f = bar_forces(s, p).head(s.body.real);
  f[s.body.real - 1] += p.end_force;
  const auto solution = constrained_solution(uncorrected_stiffness(s), f, {{0, p.local(s.at(0)[0])}});
  return {solution.values, solution.reactions[0]};
}

Eigen::ArrayXd bar_errors(const Eigen::VectorXd& u, const BarProblem& p) {
  const Solid s = bar_of_table_3();
  Eigen::ArrayXd result(s.body.real);
  for (int k = 0; k < s.body.real; ++k) {
    const double local = p.local(s.at(k)[0]);
    result[k] = 100 * std::abs(u[k] - local) / std::abs(local);
  }
  return result;
}

}  // namespace boundary_bodies
