#include "cases/driver/results.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numbers>
#include "cases/driver/gate.hpp"
#include "cases/driver/trust.hpp"
#include "post/files/mesh.hpp"
#include "post/factors/tip_rings.hpp"
#include "post/files/whole_file.hpp"

namespace cases {
namespace {

/// 64-bit FNV-1a of a text, as hexadecimal: the same settings have the same digest on every machine.
std::string digest(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const unsigned char c : text) hash = (hash ^ c) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

}  // namespace

std::vector<post::Share> probe(const Assembly& assembly, const geometry::Point& at) {
  if (const auto* galerkin = assembly.galerkin()) 
    return post::interpolation(geometry::CellLocator(galerkin->cells), galerkin->cells.units.spacing, at);
  const auto& boundary = assembly.boundary;
  const geometry::Point u = boundary.cloud.units.to_lattice(at);
  const auto paths = geometry::to_lattice(assembly.paths, boundary.cloud.units);
  std::vector<std::pair<std::uint32_t, geometry::Point>> near;
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k) {
    if ((boundary.lattice[k] - u).norm() > 1.6) continue;
    bool parted = false;
    for (const auto& path : paths) parted = parted || geometry::severs(path, u, boundary.lattice[k]);
    if (!parted) near.emplace_back(k, boundary.lattice[k]);
  }
  if (near.empty()) near.emplace_back(geometry::nearest_plate_point(boundary.cloud, at), u);
  return post::interpolation(near, u);
}

post::Mesh mesh_of(const Case& content, const Assembly& assembly) {
  const double h = content.section.thickness;
  if (const auto* galerkin = assembly.galerkin())
    return post::mesh(galerkin->cells, assembly.boundary.cloud.areas, assembly.cut, h);
  return post::mesh(assembly.boundary, assembly.families(), assembly.cut, h);
}

post::Frame frame_of(const Case& content, const Assembly& assembly, double time, std::size_t step, const plate::State& state,
                     bool resultants) {
  const auto plate_points = assembly.boundary.cloud.plate_points;
  post::Frame frame{time, step, state.leftCols(Eigen::Index(plate_points)), {}, {}};
  if (!resultants) return frame;
  const auto* galerkin = assembly.galerkin();
  frame.resultants = galerkin ? plate::resultants(state, galerkin->op.families(), content.section)
                              : plate::resultants(state, assembly.families(), assembly.ordinary()->shapes(),
                                                  assembly.boundary.cloud.areas, plate_points, content.section);
  frame.damage.assign(plate_points, 0);
  return frame;
}

void write_summary(post::Summary& summary, const std::string& resolved, const Stopwatch& stopwatch,
                   const std::filesystem::path& folder) {
  summary.version = PDPLATE_VERSION;
  summary.digest = digest(resolved);
  summary.seconds = stopwatch.seconds();
  summary.seconds.emplace_back("total", stopwatch.total());
  for (auto& part : summary.scene) part.time_share = stopwatch.seconds(part.stage) / stopwatch.total();
  summary.peak_memory_bytes = post::peak_memory_bytes();
  post::write_whole(folder / "summary.json", post::to_json(summary));
}

Results::Results(const CaseFile& file, const Assembly& assembly, const std::vector<post::TipMethods>& methods,
                 std::filesystem::path folder)
    : case_(file.content), assembly_(assembly), folder_(std::move(folder)), resolved_(resolved_toml(file.content)),
      tip_methods_(methods) {
  for (const auto& [name, position] : case_.output.probes) probes_.emplace_back(name, probe(assembly, position));
  history_.columns = {"time",          "step",            "strain_energy", "kinetic_energy",
                      "external_work", "fracture_energy", "max_abs_w",     "discrete_energy"};
  probe_table_.columns = {"time", "probe", "x", "y", "w", "theta_x", "theta_y"};
  frequency_table_.columns = {"mode", "frequency", "omega", "residual"};

  std::filesystem::create_directories(folder_);
  post::write_whole(folder_ / "case.resolved.toml", resolved_);
  if (!case_.output.vtk && !case_.output.hdf5) return;
  const auto mesh = mesh_of(case_, assembly);
  if (case_.output.vtk) vtk_.emplace(folder_, mesh);
  if (case_.output.hdf5) hdf5_.emplace(folder_ / "state.h5", mesh, resolved_, PDPLATE_VERSION);
}

void Results::grows(MovingGrowth& growth) {
  growth_ = &growth;
  history_.columns.push_back("energy_residual");
}

void Results::sample(const plate::Instant& now, bool last) {
  const auto when = fmt::format("at step {}, time {:g}", now.step, now.time);
  require_finite({{"strain energy", now.strain_energy},
                  {"kinetic energy", now.kinetic_energy},
                  {"work", now.external_work},
                  {"discrete energy", now.strain_energy + now.discrete_energy}},
                 when);
  strain_energy_ = now.strain_energy;
  const auto plate_points = Eigen::Index(assembly_.boundary.cloud.plate_points);
  const double fracture = growth_ ? growth_->fracture_energy() : 0;
  history_.rows.push_back({now.time, double(now.step), strain_energy_, now.kinetic_energy, now.external_work, fracture,
                           now.state.row(0).head(plate_points).cwiseAbs().maxCoeff(),
                           strain_energy_ + now.discrete_energy});
  if (growth_)
    history_.rows.back().push_back(now.external_work - strain_energy_ - now.kinetic_energy - fracture - growth_->frozen_energy());
  sample_probes(now);
  sample_srifs(now, last);
}

void Results::sample_probes(const plate::Instant& now) {
  for (const auto& [name, shares] : probes_) {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (const auto& share : shares) u += share.weight * now.state.col(share.point);
    const auto& x = case_.output.probes.at(name);
    probe_table_.rows.push_back({now.time, name, x.x(), x.y(), u[0], u[1], u[2]});
  }
}

std::vector<post::Srif> Results::widened_srifs(const plate::State& state, bool all_rings) const {
  if (!known_.empty()) return known_.at(srif_rows_.size());
  auto result = srifs(case_, assembly_, tip_methods_, state, all_rings);
  for (auto& srif : result)
    for (const auto& other : coarser_)
      if (other.tip == srif.tip && other.method == srif.method) post::widen(srif, other, case_.section.thickness);
  const auto& [formulation, rows] = second_;
  if (srif_rows_.size() >= rows.size()) return result;
  const auto& row = rows[srif_rows_.size()];
  for (auto& srif : result)
    if (const auto other = std::ranges::find(row, srif.tip, &post::Srif::tip); other != row.end())
      post::compare_with(srif, *other, formulation, case_.section.thickness);
  return result;
}

void Results::sample_srifs(const plate::Instant& now, bool last) {
  auto factors = growth_ ? growth_->sample(now.time, now.state) : widened_srifs(now.state, last);
  require_finite(factors, fmt::format("at step {}, time {:g}", now.step, now.time));
  post::mark_lost(factors, case_.section.thickness, largest_);
  srif_rows_.push_back(std::move(factors));
}

/// A factor that is small beside what its tip has at other times is no less resolved for it.
post::Table Results::srif_table() {
  post::Table result{post::srif_columns(), {}};
  for (std::size_t i = 0; i < srif_rows_.size(); ++i) {
    for (auto& srif : srif_rows_[i])
      if (srif.tip < truncated_.size()) post::widen(srif, truncated_[srif.tip] * largest_[srif.tip], case_.section.thickness);
    if (srif_rows_.size() > 1) post::mark_lost(srif_rows_[i], case_.section.thickness, largest_);
    post::append(result, std::get<double>(history_.rows[i].front()), srif_rows_[i]);
  }
  return result;
}

void Results::frame(const plate::Instant& now) {
  if (!vtk_ && !hdf5_) return;
  const auto plate_points = assembly_.boundary.cloud.plate_points;
  auto frame = frame_of(case_, assembly_, now.time, now.step, now.state, vtk_ && !growth_);
  std::optional<post::Mesh> mesh;
  if (growth_ && vtk_) mesh = growth_->draw(frame, now.state);
  const bool dynamic = case_.analysis.kind == Analysis::Kind::dynamic;
  plate::State velocity;
  if (hdf5_ && dynamic) velocity = now.velocity().leftCols(Eigen::Index(plate_points));
  wait_for_frame();
  if (mesh) vtk_->remesh(std::move(*mesh));
  writing_ = std::async(std::launch::async, [this, dynamic, frame = std::move(frame), velocity = std::move(velocity)] {
    if (vtk_) vtk_->write(frame);
    if (hdf5_) hdf5_->write(frame, dynamic ? &velocity : nullptr);
  });
}

void Results::wait_for_frame() {
  if (writing_.valid()) writing_.get();
}

void Results::mode(std::size_t number, const plate::Mode& mode) {
  const auto when = fmt::format("of mode {}", number);
  require_finite({{"frequency", mode.frequency}, {"residual", mode.residual}}, when);
  require_finite(mode.shape, when);
  const double omega = 2 * std::numbers::pi * mode.frequency;
  frequencies_.push_back({number, mode.frequency, omega, mode.residual});
  frequency_table_.rows.push_back({double(number), mode.frequency, omega, mode.residual});
  frame({number, double(number), mode.shape, {}, 0, 0, 0, 0});
}

post::Summary Results::finish(post::Summary summary, Stopwatch& stopwatch) {
  const bool frequencies = case_.analysis.kind == Analysis::Kind::frequencies;
  const auto& main = frequencies ? frequency_table_ : history_;
  const std::string name = frequencies ? "frequencies" : "history";
  post::write_csv(folder_ / (name + ".csv"), main);
  if (!probes_.empty()) post::write_csv(folder_ / "probes.csv", probe_table_);
  const auto srifs = srif_table();
  if (!tip_methods_.empty()) post::write_csv(folder_ / "srif.csv", srifs);
  wait_for_frame();
  if (hdf5_) {
    hdf5_->write(name, main);
    if (!probes_.empty()) hdf5_->write("probes", probe_table_);
    if (!tip_methods_.empty()) hdf5_->write("srif", srifs);
    hdf5_->close();
  }
  stopwatch.lap("output");
  if (growth_) {
    growth_->write(folder_, vtk_.has_value());
    summary.growth = growth_->summary();
    summary.energy.emplace_back("fracture", growth_->fracture_energy());
    if (growth_->frozen_energy() > 0) summary.energy.emplace_back("frozen", growth_->frozen_energy());
    if (!history_.rows.empty()) summary.energy.emplace_back("residual", std::get<double>(history_.rows.back().back()));
  }
  if (!srif_rows_.empty()) summary.srif = srif_rows_.back();
  for (const auto& reason : left_out(assembly_, tip_methods_)) summary.warnings.push_back(reason);
  warn_of_factors(case_, summary.srif, largest_, summary.warnings);
  for (std::size_t tip = 0; tip < truncated_.size(); ++tip)
    if (truncated_[tip] > 0.03)
      summary.warnings.push_back(fmt::format("tip {}: Lanczos vectors leave out some {:.2g} % of the largest factor: take a smaller analysis.tolerance",
                                             tip, 100 * truncated_[tip]));
  summary.accuracy = accuracy_;
  summary.frequencies = frequencies_;
  write_summary(summary, resolved_, stopwatch, folder_);
  return summary;
}

}  // namespace cases
