#include "post/files/stored_factors.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/heated/heat.hpp"
#include "plate/model/history.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/settled.hpp"
#include "post/factors/errors.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/gate.hpp"
#include "post/files/hdf5/state_file.hpp"

namespace post {
namespace {

/// Of all load cases and combinations, in the order of their frames; where there are none, of no frame.
std::vector<std::string> names_of_frames(const plate::Problem& problem) {
  std::vector<std::string> names;
  for (const auto& one : problem.load_cases) names.push_back(one.name);
  for (const auto& one : problem.combinations) names.push_back(one.name);
  return names;
}

/// Errors of the combination that a frame is of, from those of the load cases in the frames before.
void widen_errors_of_frame(std::size_t frame, const plate::Formulation& plate,
                           std::vector<std::vector<Srif>>& of_frames) {
  const auto& problem = plate.problem();
  const auto cases = problem.load_cases.size();
  if (frame < cases) return;
  const auto factors = plate::factors_of(problem.combinations[frame - cases], problem.load_cases);
  std::vector<std::pair<double, const std::vector<Srif>*>> parts;
  for (std::size_t i = 0; i < cases; ++i) parts.emplace_back(factors[i], &of_frames[i]);
  widen_errors(of_frames[frame], parts, plate.section().thickness);
}

/// What every load counts for in a frame: of a load case or combination, or at its time.
std::vector<double> shares_of_frame(std::size_t frame, double time, const plate::Formulation& plate) {
  const auto& problem = plate.problem();
  const auto cases = problem.load_cases.size();
  std::vector<double> shares(plate.loads().size(), 0);
  for (std::size_t i = 0; cases == 0 && i < shares.size(); ++i)
    shares[i] = plate::factor(plate.loads()[i].history, time);
  std::vector<double> factors(cases, 0);
  if (frame < cases) factors[frame] = 1;
  if (cases > 0 && frame >= cases) factors = plate::factors_of(problem.combinations[frame - cases], problem.load_cases);
  for (std::size_t i = 0; i < cases; ++i)
    for (const auto k : plate::loads_of(problem, i)) shares[k] += factors[i];
  return shares;
}

plate::Heat heat_of_frame(std::size_t frame, double time, const plate::Formulation& plate) {
  return plate.problem().load_cases.empty() ? plate::heat_at(plate, time)
                                            : plate::heat_of(plate, shares_of_frame(frame, time, plate));
}

/// Of what supports hold in a frame.
plate::State lift_of_frame(std::size_t frame, double time, const plate::Formulation& plate) {
  const auto shares = shares_of_frame(frame, time, plate);
  plate::State lift = plate::State::Zero(3, Eigen::Index(plate.points()));
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (const auto& one = plate.loads()[i]; one.lifts()) lift += shares[i] * one.lift;
  return lift;
}

}  // namespace

Table stored_factors(const StoredRun& run, const plate::Formulation& plate, const SrifOptions& options,
                     const std::vector<TipMethods>& methods) {
  const auto& cloud = plate.cloud();
  if (run.positions.size() != cloud.plate_points)
    throw std::runtime_error("state.h5 does not belong to case.resolved.toml");
  Table table{srif_columns(), {}};
  const auto names = names_of_frames(plate.problem());
  if (names.size() < run.times.size() && !names.empty())
    throw std::runtime_error("state.h5 does not belong to case.resolved.toml");
  if (!names.empty()) table.columns.emplace_back("case");
  std::vector<std::vector<Srif>> of_frames;  // of load cases
  plate::State state = plate::State::Zero(3, Eigen::Index(cloud.size()));
  for (std::size_t frame = 0; frame < run.times.size(); ++frame) {
    state.leftCols(Eigen::Index(cloud.plate_points)) = run.states[frame];
    plate.constraints().impose(state);
    if (plate::settles(plate)) state += lift_of_frame(frame, run.times[frame], plate);
    const auto heat = heat_of_frame(frame, run.times[frame], plate);
    auto found = srifs(plate, options, methods, state, true, &heat);
    require_finite(found, fmt::format("at time {:g}", run.times[frame]));
    if (names.empty()) {
      append(table, run.times[frame], found);
      continue;
    }
    of_frames.push_back(std::move(found));
    widen_errors_of_frame(frame, plate, of_frames);
    const auto before = table.rows.size();
    append(table, run.times[frame], of_frames.back());
    for (auto row = before; row < table.rows.size(); ++row) table.rows[row].emplace_back(names[frame]);
  }
  return table;
}

}  // namespace post
