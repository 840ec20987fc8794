#include "post/files/recorder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/halo_exchange.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/section.hpp"
#include "plate/solve/analysis.hpp"
#include "post/files/archive.hpp"
#include "post/files/processes.hpp"
#include "post/files/result_checks.hpp"
#include "post/files/run_folder.hpp"

namespace post {

Frame frame_of(const plate::Formulation& plate, double time, std::size_t step, const plate::State& state,
               bool resultants, const plate::Heat* heat) {
  const auto plate_points = plate.cloud().plate_points;
  Frame frame{time, step, state.leftCols(Eigen::Index(plate_points)), {}, {}};
  if (!resultants) return frame;
  frame.resultants = plate.resultants(state);
  if (heat) plate::relieve(frame.resultants, plate.section(), *heat);
  frame.damage.assign(plate_points, 0);
  return frame;
}

Mesh points_of(const plate::Formulation& plate) {
  if (plate.distributed() && !plate.breaking()) return plate.mesh();  // with numbers, where points are in no rows
  const auto& [units, positions, areas, plate_points, part] = plate.cloud();
  const auto count = std::ptrdiff_t(plate_points);
  return {{positions.begin(), positions.begin() + count},
          {areas.begin(), areas.begin() + count},
          plate.cut(),
          {},
          {},
          units.spacing,
          plate.section().thickness};
}

Recorder::Recorder(std::unique_ptr<Sink> sink, std::string resolved, std::string version, ProcessesOfRun processes)
    : sink_(std::move(sink)),
      processes_(std::move(processes)),
      resolved_(std::move(resolved)),
      version_(std::move(version)) {
  history_.columns = {"time",
                      "step",
                      "strain_energy",
                      "kinetic_energy",
                      "external_work",
                      "fracture_energy",
                      "max_abs_w",
                      "discrete_energy",
                      "energy_residual",
                      "released_energy",
                      "load_factor",
                      "displacement"};
  probes_.columns = {"time", "probe", "x", "y", "w", "theta_x", "theta_y"};
  frequencies_.columns = {"mode", "frequency", "omega", "residual"};
}

namespace {

/// Largest deflection over the owned points of all ranks: positions of other points are not known on every rank.
double largest_deflection(const plate::State& state, const plate::Boundary& boundary) {
  double largest = 0;
  for (std::size_t k = 0; k < boundary.cloud.plate_points; ++k)
    if (boundary.owns(k)) largest = std::max(largest, std::abs(state(0, Eigen::Index(k))));
  return plate::largest_of(boundary.map, largest);
}

}  // namespace

void Recorder::row(const Sample& s, const std::vector<Probe>& probes, const plate::Boundary& boundary) {
  const auto when = fmt::format("at step {}, time {:g}", s.step, s.time);
  require_finite({{"strain energy", s.strain_energy},
                  {"kinetic energy", s.kinetic_energy},
                  {"work", s.external_work},
                  {"fracture energy", s.fracture_energy},
                  {"discrete energy", s.discrete_energy.value_or(0)},
                  {"load factor", s.load_factor.value_or(0)}},
                 when);
  history_.rows.push_back({s.time, double(s.step), s.strain_energy, s.kinetic_energy, s.external_work,
                           s.fracture_energy, largest_deflection(s.state, boundary), cell(s.discrete_energy),
                           cell(s.energy_residual), cell(s.released_energy), cell(s.load_factor),
                           cell(s.displacement)});
  if (s.dissipated_energy) {
    if (history_.rows.size() == 1) history_.columns.emplace_back("dissipated_energy");
    history_.rows.back().emplace_back(*s.dissipated_energy);
  }
  if (s.contact_energy) {
    if (history_.rows.size() == 1) history_.columns.emplace_back("contact_energy");
    history_.rows.back().emplace_back(*s.contact_energy);
  }
  for (const auto& [name, x, shares] : probes) {
    plate::PointValues u = plate::value_at(shares, s.state);
    for (double& component : u) component = plate::sum_of_all(boundary.map, component);  // one process has the place
    probes_.rows.push_back({s.time, name, x.x(), x.y(), u[0], u[1], u[2]});
    if (!s.in_plane) continue;
    if (probes_.rows.size() == 1) probes_.columns.emplace_back("u"), probes_.columns.emplace_back("v");
    geometry::Point moved(0, 0);
    for (const auto& share : shares) moved += share.weight * s.in_plane->col(share.point);
    for (double& component : moved) component = plate::sum_of_all(boundary.map, component);
    probes_.rows.back().emplace_back(moved.x()), probes_.rows.back().emplace_back(moved.y());
  }
}

void Recorder::mode(const Frequency& one) {
  frequencies_.rows.push_back({double(one.mode), one.frequency, one.omega, one.residual});
  if (!one.share_in_plane) return;
  if (frequencies_.rows.size() == 1) frequencies_.columns.emplace_back("share_in_plane");
  frequencies_.rows.back().emplace_back(*one.share_in_plane);
}

void Recorder::frame(Frame frame, std::optional<plate::Mesh> mesh, plate::State velocity) {
  sink_->frame(std::move(frame), std::move(mesh), std::move(velocity));
}

void Recorder::cracks(Cracks cracks, const std::vector<Srif>& factors) {
  if (!draws()) return;
  set_factors(cracks, factors);
  sink_->cracks(cracks);
}

void Recorder::save(plate::OutArchive& archive) {
  archive(history_, probes_, sink_->written());
}

void Recorder::restore(plate::InArchive& archive) {
  std::vector<double> frames;
  archive(history_, probes_, frames);
  sink_->go_on(frames);
}

namespace {

/// Gives the time of every stage to the first part of it, and that of stages without a part to one more: the shares add
/// up to 1.
void share_time(Summary& summary, const plate::Stopwatch& stopwatch) {
  std::vector<std::string> others;
  double of_others = 0;
  for (const auto& [stage, seconds] : stopwatch.seconds()) {
    const auto part = std::ranges::find(summary.scene, stage, &ScenePart::stage);
    const double share = seconds / stopwatch.total();
    if (part != summary.scene.end())
      part->time_share = share;
    else
      of_others += share, others.push_back(stage);
  }
  if (!others.empty())
    summary.scene.push_back({fmt::format("other stages: {}", fmt::join(others, ", ")), "", 0, of_others});
}

}  // namespace

Summary Recorder::finish(Summary summary, plate::Stopwatch& stopwatch) {
  Sink::Tables tables;
  using Kind = plate::Analysis::Kind;
  const auto kind = summary.analysis.kind;
  if (frequencies_.rows.empty() && kind != Kind::frequencies && kind != Kind::harmonic && kind != Kind::buckling)
    tables.emplace_back("history", &history_);
  if (!frequencies_.rows.empty() || kind == Kind::frequencies) tables.emplace_back("frequencies", &frequencies_);
  if (!probes_.rows.empty()) tables.emplace_back("probes", &probes_);
  for (const auto& [name, table] : tables_) tables.emplace_back(name, &table);
  sink_->tables(tables);
  stopwatch.lap("output");
  summary.version = version_;
  summary.digest = digest(resolved_);
  summary.seconds = stopwatch.seconds();
  summary.seconds.emplace_back("total", stopwatch.total());
  share_time(summary, stopwatch);
  summary.peak_memory_bytes = peak_memory_bytes();
  const auto& [steps, iterations] = std::tie(summary.analysis.steps, summary.analysis.iterations);
  summary.processes =
      processes_.summary(summary.own_points, summary.seconds, double(summary.peak_memory_bytes),
                         steps || iterations ? std::optional(double(steps ? *steps : *iterations)) : std::nullopt);
  sink_->summary(to_json(summary));
  return summary;
}

}  // namespace post
