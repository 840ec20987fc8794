#include "fracture/growth/record.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "geometry/shape/crack_path.hpp"
#include "plate/model/problem.hpp"

namespace fracture {

using post::cell;

QuasiStaticLoad::Step QuasiStaticLoad::to(double whole, double critical, double held) {
  const bool fixed = control_ == Growth::Control::displacement, follows = control_ == Growth::Control::equilibrium;
  if (first_) most_displacement_ = whole;
  const double reached = fixed ? displacement_ / whole : factor_, end = fixed ? most_displacement_ / whole : 1;
  const Step result{first_ || critical >= reached * (1 - 1e-9), !follows && critical > end};
  first_ = false;
  go_to(whole, held,
        follows ? (std::isfinite(critical) ? critical : factor_) : std::min(std::max(critical, reached), end));
  return result;
}

/// A change comes first, under constant load or at constant displacement, then the load changes in proportion to the
/// displacement; where the load follows the crack, both at once. Supports that have moved do no work in the first.
void QuasiStaticLoad::go_to(double whole, double held, double factor) {
  const double displacement = factor * whole;
  const bool fixed = control_ == Growth::Control::displacement;
  const double from = control_ == Growth::Control::load ? factor_ * whole : displacement_;
  const double factor_from = fixed ? displacement_ / whole : factor_;
  const double of_supports = factor_ * held - held_;
  ledger.external_work +=
      factor_ * (from - displacement_ - of_supports) + (factor_from + factor) / 2 * (displacement - from);
  factor_ = factor, displacement_ = displacement, held_ = factor * held;
  ledger.strain = factor * displacement / 2;
}

Record::Record() {
  growth.columns = {"advance",
                    "time",
                    "load_factor",
                    "displacement",
                    "critical_load_factor",
                    "stable",
                    "crack_length",
                    "tips",
                    "broken_bonds",
                    "external_work",
                    "strain_energy",
                    "fracture_energy",
                    "released_energy",
                    "critical_load_factor_error"};
  tips.columns = {"advance", "time", "tip", "crack", "x",     "y",     "angle", "length", "moves",
                  "G",       "K1",   "K2",  "K3",    "begin", "piece", "speed", "spent",  "reached"};
}

void Record::add(const GrowthRow& row) {
  growth.rows.push_back({row.advance, cell(row.time), cell(row.load_factor), cell(row.displacement),
                         cell(row.critical_load_factor), cell(row.stable), row.crack_length, double(row.tips),
                         cell(row.broken_bonds), cell(row.external_work), cell(row.strain_energy), row.fracture_energy,
                         cell(row.released_energy), cell(row.critical_load_factor_error)});
}

void Record::add(const TipRow& row) {
  tips.rows.push_back({row.advance, cell(row.time), row.tip, cell(row.crack), row.x, row.y, row.angle, cell(row.length),
                       cell(row.moves), cell(row.G), cell(row.K1), cell(row.K2), cell(row.K3), cell(row.begin),
                       cell(row.piece), cell(row.speed), cell(row.spent), cell(row.reached)});
  if (auto& cells = tips.rows.back(); cells.size() < tips.columns.size())
    cells.insert(cells.end(), {cell(row.N1), cell(row.N2), cell(row.face)});
}

void Record::acts_in_plane() {
  tips.columns.insert(tips.columns.end(), {"N1", "N2", "face"});
}

post::Table Record::crack_table() const {
  post::Table result{{"crack", "vertex", "x", "y", "advance", "time"}, {}};
  for (std::size_t c = 0; c < cracks.lines.size(); ++c)
    for (std::size_t i = 0; i < cracks.lines[c].vertices.size(); ++i) {
      const auto& x = cracks.lines[c].vertices[i];
      const post::Cell when(cracks.lines[c].advances[i]), none;
      result.rows.push_back({double(c), double(i), x.x(), x.y(), in_motion ? none : when, in_motion ? when : none});
    }
  return result;
}

std::vector<std::string> Record::cut_places(const plate::Problem& problem) const {
  std::vector<std::pair<std::string, geometry::Point>> places;
  if (problem.impact) places.emplace_back("a mass hits", problem.impact->position);
  for (const auto& load : problem.loads)
    if (const auto x = load.point()) places.emplace_back("a force acts", *x);
  for (const auto& spring : problem.springs)
    if (spring.position) places.emplace_back("a spring acts", *spring.position);
  for (const auto& support : problem.supports)
    for (const auto& point : support.points) places.emplace_back("a support holds", point);
  const double near = problem.discretization.spacing_at_tips();
  std::vector<std::string> result;
  for (const auto& [what, place] : places)
    if (std::ranges::any_of(
            cracks.lines, [&, &at = place](const auto& line) { return geometry::distance(line.vertices, at) < near; }))
      result.push_back(
          fmt::format("a crack runs through ({:g}, {:g}), where {}: both its faces share that; keep it away "
                      "with `no_fail`",
                      place.x(), place.y(), what));
  return result;
}

}  // namespace fracture
