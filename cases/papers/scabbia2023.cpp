// Scabbia, Zaccariotto, Galvanetto 2023: boxes with surface nodes, plane strain beside other corrections.

#include <fmt/format.h>
#include <functional>

#include "cases/papers/bodies/boxes.hpp"
#include "cases/papers/bodies/competitors.hpp"
#include "cases/papers/bodies/fractions.hpp"
#include "cases/papers/bodies/plane.hpp"
#include "cases/papers/paper_rows.hpp"

namespace cases {
namespace {

namespace bb = boundary_bodies;
using plate::FluxRule;

constexpr auto of_error = "largest error (38) [-]";

/// Times a computation and adds a row.
void add_row(PaperResults& results, PaperRow row, const std::function<double()>& computed,
             const std::function<std::optional<Claim>(double)>& claim = {}) {
  const ProcessorWatch watch;
  row.ours = computed();
  row.processor_seconds = watch.seconds();
  if (claim) row.claim = claim(row.ours);
  results.rows.push_back(std::move(row));
}

std::function<std::optional<Claim>(double)> above(double bound) {
  return [bound](double x) { return Claim{fmt::format("above {:g} %", 100 * bound), x > bound}; };
}

std::function<std::optional<Claim>(double)> below(double bound) {
  return [bound](double x) { return Claim{fmt::format("below {:g} %", 100 * bound), x < bound}; };
}

/// 4.1: a linear field. Its error by the moduli of the lattice is known beforehand.
void add_pulled_box(PaperResults& results) {
  const auto box = bb::elastic_box({8, 5, 5}, 0.1);
  const auto lattice = bb::at_unknowns(box, bb::pulled_box_of_lattice(box));
  const double known = bb::errors(box, lattice, bb::pulled_box).largest;
  add_row(
      results,
      {.item = "4.1 box pulled, 8 x 5 x 5 nodes, no corrections",
       .quantity = of_error,
       .published = 0.3,
       .reference = 0,
       .reference_is = "closed form (39)"},
      [&] { return bb::errors(box, bb::uncorrected(box, bb::pulled(0, 1), bb::pulled_box), bb::pulled_box).largest; },
      above(0.3));
  for (const auto rule : {FluxRule::crossing_point, FluxRule::lever})
    add_row(results,
            {.item = fmt::format("4.1 box pulled, 8 x 5 x 5 nodes, surface nodes, order 1, {}",
                                 rule == FluxRule::lever ? "lever" : "crossing points"),
             .quantity = of_error,
             .published = 0.0006,
             .reference = known,
             .reference_is = "moduli of the lattice, closed form"},
            [&] {
              return bb::errors(box, bb::with_surface_nodes(box, 1, rule, bb::pulled(0, 1)), bb::pulled_box).largest;
            });
}

/// 4.2: the made-up field; the paper does not give the body.
void add_made_box(PaperResults& results, const std::vector<int>& counts, double length) {
  const bb::MadeBox body(counts, length);
  const std::string box =
      fmt::format("4.2 made-up loading, {} x {} x {} nodes, {} m", counts[0], counts[1], counts[2], length);
  const auto row = [&](const std::string& way, std::optional<double> published) {
    return PaperRow{.item = box + ", " + way,
                    .quantity = of_error,
                    .published = published,
                    .reference = 0,
                    .reference_is = "closed form (42)"};
  };
  add_row(
      results, row("no corrections", 1.3), [&] { return body.uncorrected(); }, above(1.3));
  add_row(
      results, row("surface nodes, order 1, lever", 0.01), [&] { return body.corrected(1, FluxRule::lever); },
      below(0.01));
  add_row(results, row("surface nodes, order 3, crossing points", 0.004),
          [&] { return body.corrected(3, FluxRule::crossing_point); });
}

struct PlaneTask {
  std::string name;
  bb::Solid solid;
  bb::Conditions conditions;
  bb::Field solution;
};

/// Displacements by each correction.
std::vector<std::pair<std::string, std::function<Eigen::VectorXd(const PlaneTask&)>>> plane_ways() {
  return {
      {"no corrections", [](const PlaneTask& t) { return bb::uncorrected(t.solid, t.conditions, t.solution); }},
      {"PALS",
       [](const PlaneTask& t) {
         const plate::SparseStiffness K = bb::position_aware_stiffness(t.solid).sparseView();
         return bb::on_nodes(t.solid, K, t.conditions, t.solution);
       }},
      {"MNM without tangential derivatives",
       [](const PlaneTask& t) { return bb::with_mirror_nodes(t.solid, t.conditions, false); }},
      {"MNM with tangential derivatives",
       [](const PlaneTask& t) { return bb::with_mirror_nodes(t.solid, t.conditions, true); }},
      {"PDDO", [](const PlaneTask& t) { return bb::with_differential_operator(t.solid, t.conditions, t.solution); }},
      {"PDDO, stresses known at the nodes",
       [](const PlaneTask& t) { return bb::with_differential_operator(t.solid, t.conditions, t.solution, true); }},
      {"SNM, order 1, lever",
       [](const PlaneTask& t) { return bb::with_surface_nodes(t.solid, 1, FluxRule::lever, t.conditions); }},
      {"SNM, order 2, crossing points",
       [](const PlaneTask& t) { return bb::with_surface_nodes(t.solid, 2, FluxRule::crossing_point, t.conditions); }}};
}

/// Errors (44) of u and v of each correction, and along the middle of the square as curves.
void add_plane(PaperResults& results, const PlaneTask& task) {
  post::Panel panel{"correction", fmt::format("largest |error| of {} [%]", task.name), {}};
  panel.y_scale = post::Scale::logarithmic;
  std::vector<post::Curve> curves(2);
  double number = 0;
  for (const auto& [name, solve] : plane_ways()) {
    const ProcessorWatch watch;
    const Eigen::VectorXd errors = bb::largest_errors(task.solid, solve(task), task.solution);
    number += 1;
    for (const int c : {0, 1}) {
      results.add(watch, fmt::format("5 plane strain, {}, {}", task.name, name),
                  fmt::format("largest error (44) of {} [-]", "uv"[c]), errors[c], 0, "closed form");
      curves[std::size_t(c)].t.push_back(number), curves[std::size_t(c)].y.push_back(100 * errors[c]);
    }
  }
  panel.t_title = "correction, in the order of the table";
  panel.series = {{.label = "u", .line = post::Line::numbered, .curve = curves[0], .number = 0},
                  {.label = "v", .line = post::Line::numbered, .curve = curves[1], .number = 1}};
  results.panels.push_back(panel);
}

}  // namespace

PaperResults scabbia2023(const std::filesystem::path&) {
  constexpr double poisson = 0.3;
  PaperResults results;
  add_pulled_box(results);
  add_made_box(results, {18, 18, 4}, 0.3);
  add_made_box(results, {14, 6, 6}, 0.1);
  const auto square = bb::plane_square(poisson);
  add_plane(results, {"pulled", square, bb::pulled(1, 1), bb::pulled_square(poisson)});
  add_plane(results, {"made-up loading", square, bb::made(square, poisson), bb::made_field});
  return results;
}

}  // namespace cases
