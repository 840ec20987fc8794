// Scabbia, Zaccariotto, Galvanetto 2021: the surface effect of a bar, four bars at rest, the clamped plate in its
// plane.

#include <fmt/format.h>

#include "cases/papers/bodies/bars.hpp"
#include "cases/papers/bodies/clamped_plate.hpp"
#include "cases/papers/bodies/surface_effect.hpp"
#include "cases/papers/paper_rows.hpp"

namespace cases {
namespace {

namespace bb = boundary_bodies;

constexpr double rounding = 1e-9;  // relative, of bars and their closed forms

post::Series series_of(const std::string& label, post::Line line, std::size_t number, post::Curve curve) {
  return {.label = label, .line = line, .curve = std::move(curve), .number = number};
}

/// Largest flux and where, where the flux is right; the tables at a few places against quadrature.
void add_surface_effect(PaperResults& results) {
  const ProcessorWatch watch;
  const double highest = bb::place_of(bb::load_near_end, 0, 0.5, 1),
               right = bb::place_of(bb::flux_near_end, 1, 0.1, 0.7);
  const auto add = [&](const std::string& quantity, double ours, double published, double reference,
                       const std::string& reference_is) {
    results.add(watch, "2.2 surface effect", quantity, ours, reference, reference_is).published = published;
  };
  add("largest flux / (E strain) [-]", bb::flux_near_end(highest), 1.263, bb::integrated_flux(highest),
      "quadrature of (24)");
  add("place of the largest flux / horizon [-]", highest, 0.772, bb::place_of(bb::integrated_load, 0, 0.5, 1),
      "zero of the load by quadrature");
  add("place where the flux is right / horizon [-]", right, 0.394, bb::place_of(bb::integrated_flux, 1, 0.1, 0.7),
      "quadrature of (24)");
  for (const double x : {0.25, 0.5, 0.75, 1.25, 1.5, 1.75}) {
    const auto at = [x](const char* name) { return fmt::format("{} at x / horizon = {} [-]", name, x); };
    results.add(watch, "table 1", at("weighted volume / full"), bb::weighted_volume_near_end(x),
                bb::integrated_weighted_volume(x), "quadrature of (25)");
    results.add(watch, "table 2", at("flux / (E strain)"), bb::flux_near_end(x), bb::integrated_flux(x),
                "quadrature of (24)");
    results.add(watch, "table B1", at("load horizon / (E strain)"), bb::load_near_end(x), bb::integrated_load(x),
                "quadrature of (B1)");
  }
  for (auto& row : results.rows) row.processor_seconds = watch.seconds();
  post::Panel panel{"x / horizon", "flux / (E strain)", {}};
  post::Curve table, integral;
  for (double x = 0.01; x < 2.5; x += 0.02) table.t.push_back(x), table.y.push_back(bb::flux_near_end(x));
  for (double x = 0.05; x < 2.5; x += 0.2) integral.t.push_back(x), integral.y.push_back(bb::integrated_flux(x));
  panel.series = {series_of("table 2", post::Line::computed, 0, table),
                  series_of("quadrature", post::Line::rings, 6, integral)};
  results.panels.push_back(panel);
}

/// A way to solve a bar.
struct BarWay {
  std::string name;
  bb::BarSolution solution;
  std::optional<Claim> claim;
};

/// Claim of the paper on an order, where it has one: exact where the order reaches the degree of the solution.
std::optional<Claim> claim_on(const bb::BarProblem& problem, int order, const bb::BarSolution& solution) {
  if (problem.degree > 2 || order < problem.degree) return std::nullopt;
  const double largest = bb::bar_errors(solution.u, problem).maxCoeff() / 100;
  return Claim{"error very close to the machine precision", largest < rounding};
}

std::vector<BarWay> ways_of(const bb::BarProblem& problem) {
  std::vector<BarWay> ways{{"no corrections", bb::uncorrected_bar(problem), {}}};
  for (const int order : {1, 2, 3, 5}) {
    const auto solution = bb::bar_with_multipliers(problem, order);
    ways.push_back({fmt::format("multipliers, order {}", order), solution, claim_on(problem, order, solution)});
  }
  for (const int order : {1, 2, 3, 5})
    ways.push_back(
        {fmt::format("surface nodes (2023), order {}", order), bb::bar_with_surface_nodes(problem, order), {}});
  return ways;
}

/// The node of the largest error (Sca21 64): its displacement against the local one.
PaperRow row_at_worst(const bb::BarProblem& problem, const BarWay& way, const bb::Solid& bar) {
  Eigen::Index worst = 0;
  bb::bar_errors(way.solution.u, problem).maxCoeff(&worst);
  const double x = bar.at(int(worst))[0];
  return {.item = fmt::format("{}, {}", problem.name, way.name),
          .quantity = fmt::format("u at the worst node, x = {:.3g} m [m]", x),
          .ours = way.solution.u[worst],
          .claim = way.claim,
          .reference = problem.local(x),
          .reference_is = "local theory, closed form"};
}

void add_bar(const bb::BarProblem& problem, PaperResults& results) {
  const ProcessorWatch watch;
  const auto bar = bb::bar_of_table_3();
  const std::string number = problem.name.substr(0, 3);
  post::Panel shape{"x [m]", fmt::format("u of {} [m]", number), {}},
      off{"x [m]", fmt::format("|error| of {} [%]", number), {}};
  off.y_scale = post::Scale::logarithmic;
  post::Curve local;
  for (int k = 0; k < bar.body.real; ++k)
    local.t.push_back(bar.at(k)[0]), local.y.push_back(problem.local(bar.at(k)[0]));
  shape.series.push_back(series_of("local theory", post::Line::reference, 0, local));
  const auto ways = ways_of(problem);
  const std::size_t first = results.rows.size();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    results.rows.push_back(row_at_worst(problem, ways[i], bar));
    const Eigen::ArrayXd errors = bb::bar_errors(ways[i].solution.u, problem);
    const auto& u = ways[i].solution.u;
    if (i < 5)  // the paper's
      shape.series.push_back(series_of(ways[i].name, post::Line::numbered, i, {local.t, {u.begin(), u.end()}}));
    off.series.push_back(series_of(ways[i].name, post::Line::numbered, i, {local.t, {errors.begin(), errors.end()}}));
  }
  const double loads = bb::bar_forces(bar, problem).sum();
  for (std::size_t i = 1; i < ways.size(); ++i)
    results.add(watch, fmt::format("{}, {}", problem.name, ways[i].name), "reaction at x = 0 [N]",
                ways[i].solution.reaction, -loads, "equilibrium");
  for (std::size_t i = first; i < results.rows.size(); ++i) results.rows[i].processor_seconds = watch.seconds();
  results.panels.push_back(shape);
  results.panels.push_back(off);
}

/// Errors of the clamped plate (Sca21 6.2) in percent of the largest displacement, against Ritz's method.
void add_clamped_plate(PaperResults& results) {
  const ProcessorWatch watch;
  const auto plate = bb::clamped_plate();
  const bb::RitzClampedPlate reference(12);
  const std::size_t first = results.rows.size();
  const auto add = [&](const std::string& way, const Eigen::VectorXd& u, std::optional<Claim> claim) {
    const Eigen::Array2d errors = bb::clamped_errors(plate, u, reference);
    for (const int component : {0, 1})
      results
          .add(watch, fmt::format("6.2 clamped plate in its plane, {}", way),
               fmt::format("largest error of {} [% of the largest displacement]", "uv"[component]), errors[component],
               0, "Ritz's method, to 2e-5")
          .claim = component == 0 ? claim : std::nullopt;
    return errors[0];
  };
  const double without = add("no corrections", bb::uncorrected_clamped(plate, reference), {});
  for (int order = 1; order <= 5; ++order) {
    const Eigen::VectorXd u = bb::clamped_by_multipliers(plate, order);
    const bool better = bb::clamped_errors(plate, u, reference)[0] < without;
    add(fmt::format("multipliers, order {}", order), u, Claim{"better than without corrections", better});
  }
  for (std::size_t i = first; i < results.rows.size(); ++i) results.rows[i].processor_seconds = watch.seconds();
}

}  // namespace

PaperResults scabbia2021(const std::filesystem::path&) {
  PaperResults results;
  add_surface_effect(results);
  for (const auto& problem : bb::bar_problems()) add_bar(problem, results);
  add_clamped_plate(results);
  return results;
}

}  // namespace cases
