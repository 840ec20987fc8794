#include "post/files/factor_rows.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <stdexcept>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/stretching.hpp"
#include "post/factors/errors.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "post/files/result_checks.hpp"

namespace post {

void OtherFactors::widen_row(std::size_t number, std::vector<Srif>& row, double thickness) const {
  const std::size_t of_coarser = coarser.size() == 1 ? 0 : number;
  for (auto& srif : row)
    for (std::size_t i = 0; of_coarser < coarser.size() && i < coarser[of_coarser].size(); ++i)
      if (const auto& other = coarser[of_coarser][i]; other.tip == srif.tip && other.method == srif.method)
        widen(srif, other, thickness);
  if (number >= second.size()) return;
  for (auto& srif : row)
    if (const auto other = std::ranges::find(second[number], srif.tip, &Srif::tip); other != second[number].end())
      compare_with(srif, *other, formulation, thickness, closed);
}

void FactorRows::add(std::vector<Srif> found, const std::string& when) {
  auto row = known_.empty() ? std::move(found) : known_.at(rows_.size());
  if (known_.empty()) others_.widen_row(rows_.size(), row, thickness_);
  require_finite(row, when);
  mark_lost(row, thickness_, largest_);
  rows_.push_back(std::move(row));
}

Table FactorRows::table(const std::vector<double>& times) {
  Table result{srif_columns(), {}};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (auto& srif : rows_[i])
      if (srif.tip < truncated_.size()) widen(srif, truncated_[srif.tip] * largest_[srif.tip], thickness_);
    if (rows_.size() > 1) mark_lost(rows_[i], thickness_, largest_);
    append(result, times[i], rows_[i]);
  }
  return result;
}

std::vector<std::string> FactorRows::warnings(double tolerance) const {
  std::vector<std::string> result;
  for (std::size_t tip = 0; tip < truncated_.size(); ++tip)
    if (truncated_[tip] > 0.03)
      result.push_back(
          fmt::format("tip {}: Lanczos vectors leave out some {:.2g} % of the largest factor; set `tolerance` = {:.2g}",
                      tip, 100 * truncated_[tip], tolerance / 10));
  return result;
}

std::vector<std::string> srif_columns() {
  return {"time",
          "tip",
          "x",
          "y",
          "method",
          "K1",
          "K2",
          "K3",
          "F1",
          "F2",
          "F3",
          "estimated_error",
          "fit_residual",
          "samples",
          "estimated_error_K1",
          "estimated_error_K2",
          "estimated_error_K3",
          "overlaps_at"};
}

void append(Table& table, double time, const std::vector<Srif>& srifs) {
  if (table.columns.empty()) table.columns = srif_columns();
  const bool in_plane = std::ranges::any_of(srifs, [](const Srif& srif) { return srif.membrane.has_value(); });
  if (in_plane && table.rows.empty())
    for (const char* name : {"N1", "N2", "estimated_error_N1", "estimated_error_N2"}) table.columns.emplace_back(name);
  for (const Srif& srif : srifs) {
    const auto factor = [&](std::size_t i, const std::optional<double>& value) {
      return srif.resolved[i] ? cell(value) : Cell();
    };
    const auto where = overlap(srif);
    table.rows.push_back({time, static_cast<double>(srif.tip), srif.position.x(), srif.position.y(),
                          name_of(srif.method), factor(0, srif.K1), factor(1, srif.K2), factor(2, srif.K3),
                          factor(0, srif.F1), factor(1, srif.F2), factor(2, srif.F3), cell(srif.estimated_error),
                          srif.fit_residual, static_cast<double>(srif.samples), cell(srif.errors[0]),
                          cell(srif.errors[1]), cell(srif.errors[2]),
                          where == Overlap::unknown ? Cell() : Cell(name_of(where))});
    if (!in_plane) continue;
    const auto membrane = srif.membrane.value_or(MembraneFactors{{}, {}, {false, false}, {}});
    for (std::size_t i = 0; i < 2; ++i)
      table.rows.back().push_back(membrane.resolved[i] ? Cell(membrane.N[i]) : Cell());
    for (const auto& error : membrane.errors) table.rows.back().push_back(cell(error));
  }
}

namespace {

/// Names of all load cases and combinations, in the order of their frames; empty where there are none.
std::vector<std::string> names_of_frames(const plate::Problem& problem) {
  std::vector<std::string> names;
  for (const auto& one : problem.load_cases) names.push_back(one.name);
  for (const auto& one : problem.combinations) names.push_back(one.name);
  return names;
}

/// Errors of the combination that a frame is of, from those of the load cases in the frames before. With large
/// deflections it is no sum of theirs.
void widen_errors_of_frame(std::size_t frame, const plate::Formulation& plate,
                           std::vector<std::vector<Srif>>& of_frames) {
  const auto& problem = plate.problem();
  const auto cases = problem.load_cases.size();
  if (frame < cases || problem.stretches) return;
  const auto factors = plate::factors_of(problem.combinations[frame - cases], problem.load_cases);
  std::vector<std::pair<double, const std::vector<Srif>*>> parts;
  for (std::size_t i = 0; i < cases; ++i) parts.emplace_back(factors[i], &of_frames[i]);
  widen_errors(of_frames[frame], parts, plate.section().thickness);
}

/// Factors of all loads in a frame: those of its load case or combination, or those at its time.
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

/// Dirichlet lift of a frame: the displacements that supports prescribe [3 x points].
plate::State lift_of_frame(std::size_t frame, double time, const plate::Formulation& plate) {
  const auto shares = shares_of_frame(frame, time, plate);
  plate::State lift = plate::zero_state(plate.points());
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (const auto& one = plate.loads()[i]; one.lifts()) lift += shares[i] * one.lift;
  return lift;
}

/// State of a plate in its plane with these displacements u, v of its points: theta_y = u, theta_x = -v.
plate::State state_in_plane(const plate::Formulation& membrane, const Eigen::Matrix2Xd& displacement) {
  plate::State state = plate::zero_state(membrane.cloud().size());
  const auto points = displacement.cols();
  state.row(1).head(points) = -displacement.row(1), state.row(2).head(points) = displacement.row(0);
  membrane.constraints().impose(state);
  return state;
}

/// Adds the factors in the plane of a frame, with the strains of large deflections. `bending`: state of the plate;
/// `heat`: in the plane.
void add_in_plane(std::vector<Srif>& found, const PlateInPlane& in_plane, const Eigen::Matrix2Xd& displacement,
                  const plate::State& bending, const plate::Heat& heat, const SrifOptions& options) {
  const auto& [membrane, methods] = in_plane;
  std::optional<plate::Stretch> stretch;
  if (membrane.problem().stretches) stretch = membrane.stretching()->stretch(bending);
  const auto stretched = srifs(membrane, options, methods, state_in_plane(membrane, displacement), true, &heat,
                               stretch ? &*stretch : nullptr);
  require_finite(stretched, "in the plane");
  add_membrane(found, stretched, membrane.problem().section);
}

}  // namespace

Table stored_factors(const StoredRun& run, const plate::Formulation& plate, const SrifOptions& options,
                     const std::vector<TipMethods>& methods, const std::optional<PlateInPlane>& in_plane) {
  const auto& cloud = plate.cloud();
  Table table{srif_columns(), {}};
  const auto names = names_of_frames(plate.problem());
  if (run.positions.size() != cloud.plate_points || (names.size() < run.times.size() && !names.empty()))
    throw std::runtime_error("state.h5 does not belong to case.resolved.toml");
  if (in_plane && run.displacements.size() < run.times.size())
    throw std::runtime_error("state.h5 has no displacements in the plane: run the case again");
  std::vector<std::vector<Srif>> of_frames;  // of load cases
  plate::State state = plate::zero_state(cloud.size());
  for (std::size_t frame = 0; frame < run.times.size(); ++frame) {
    state.leftCols(Eigen::Index(cloud.plate_points)) = run.states[frame];
    plate.constraints().impose(state);
    if (plate::has_prescribed_displacements(plate)) state += lift_of_frame(frame, run.times[frame], plate);
    const auto heat = heat_of_frame(frame, run.times[frame], plate);
    auto found = srifs(plate, options, methods, state, true, &heat);
    if (in_plane)
      add_in_plane(found, *in_plane, run.displacements[frame], state,
                   heat_of_frame(frame, run.times[frame], in_plane->membrane), options);
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
  if (!names.empty()) table.columns.emplace_back("case");
  return table;
}

}  // namespace post
