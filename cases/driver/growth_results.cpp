#include "cases/driver/growth_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/driver/gate.hpp"
#include "post/files/whole_file.hpp"

namespace cases {
namespace {

/// The factors of a tip under a share of the load.
post::Srif scaled(post::Srif srif, double factor) {
  for (double* value : {&srif.K1, &srif.K2, &srif.K3}) *value *= factor;
  for (auto* value : {&srif.F1, &srif.F2, &srif.F3})
    if (*value) **value *= factor;
  if (srif.G) *srif.G *= factor * factor;
  for (auto& ring : srif.rings) {
    for (double* value : {&ring.K1, &ring.K2, &ring.K3}) *value *= factor;
    ring.G *= factor * factor;
  }
  return srif;
}

std::vector<post::Srif> scaled(std::vector<post::Srif> srifs, double factor) {
  for (auto& srif : srifs) srif = scaled(std::move(srif), factor);
  return srifs;
}

/// Was the point on a crack at the start?
bool on_any(const std::vector<geometry::Polyline>& cracks, const geometry::Point& x, double tolerance) {
  return std::ranges::any_of(cracks, [&](const auto& crack) { return geometry::distance(crack, x) <= tolerance; });
}

}  // namespace

GrowthResults::GrowthResults(const CaseFile& file, std::filesystem::path folder)
    : file_(file), folder_(std::move(folder)), resolved_(resolved_toml(file.content)) {
  growth_.columns = {"advance", "load_factor", "displacement", "critical_load_factor", "stable", "tip",   "crack",
                     "x",       "y",           "angle",        "length",               "moves",  "G",     "K1",
                     "K2",      "K3",          "external_work", "strain_energy", "fracture_energy", "released_energy"};
  history_.columns = {"time",          "step",            "strain_energy",   "kinetic_energy",
                      "external_work", "fracture_energy", "released_energy", "max_abs_w",
                      "load_factor",   "displacement"};
  probes_.columns = {"time", "probe", "x", "y", "w", "theta_x", "theta_y"};
  srifs_.columns = post::srif_columns();
  for (const auto& crack : file.content.cracks) lines_.push_back({crack, std::vector<double>(crack.size(), 0)});
  std::filesystem::create_directories(folder_);
  post::write_whole(folder_ / "case.resolved.toml", resolved_);
  if (file.content.output.vtk) vtk_.emplace(folder_, post::Mesh{});
}

void GrowthResults::event(const fracture::Event& event, const std::shared_ptr<const GrownPlate>& plate) {
  require_finite({{"load factor", event.load_factor},
                  {"work", event.ledger.external_work},
                  {"strain energy", event.ledger.strain}},
                 fmt::format("at advance {}", event.advance));
  last_ = plate, advance_ = event.advance, factor_ = event.load_factor;
  if (event.advance == 0) first_cut_ = plate->assembly.cut;
  const auto& c = file_.content;
  const auto points = Eigen::Index(plate->assembly.boundary.cloud.plate_points);
  const auto& [work, strain, fracture] = event.ledger;
  const auto time = double(event.advance);
  history_.rows.push_back({time, time, strain, 0.0, work, fracture, event.ledger.released(),
                           factor_ * plate->state.row(0).head(points).cwiseAbs().maxCoeff(), factor_, event.displacement});
  for (const auto& [name, x] : c.output.probes) {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (const auto& share : probe(plate->assembly, x)) u += factor_ * share.weight * plate->state.col(share.point);
    probes_.rows.push_back({time, name, x.x(), x.y(), u[0], u[1], u[2]});
  }
  post::append(srifs_, time, scaled(plate->srifs, factor_));
  tips(event, *plate);
  cracks(event);
  const bool moves = std::ranges::any_of(event.moves, [](char one) { return one; });
  if (moves && first_factor_ == 0) first_factor_ = factor_;
  largest_factor_ = std::max(largest_factor_, factor_);
  framed_ = false;
  if (event.advance % c.growth->frames_every == 0) frame();
}

void GrowthResults::tips(const fracture::Event& event, const GrownPlate&) {
  for (std::size_t i = 0; i < event.plate.tips.size(); ++i) {
    const auto& [tip, K, G] = event.plate.tips[i];
    const double angle = std::atan2(tip.direction.y(), tip.direction.x()) * 180 / std::numbers::pi;
    const post::Cell critical = std::isfinite(event.critical) ? post::Cell(event.critical) : post::Cell();
    growth_.rows.push_back({double(event.advance), event.load_factor, event.displacement, critical, double(event.stable),
                            double(i), double(tip.crack), tip.position.x(), tip.position.y(), angle,
                            geometry::length(event.cracks[tip.crack]), double(event.moves[i]),
                            factor_ * factor_ * G.value_or(0), factor_ * K.K1, factor_ * K.K2, factor_ * K.K3,
                            event.ledger.external_work, event.ledger.strain, event.ledger.fracture,
                            event.ledger.released()});
  }
}

/// Puts the ends that have moved since the last event before and behind the lines.
void GrowthResults::cracks(const fracture::Event& event) {
  const auto advance = double(event.advance);
  for (std::size_t c = 0; c < lines_.size(); ++c) {
    auto& [vertices, advances] = lines_[c];
    const auto& crack = event.cracks[c];
    if (crack.front() != vertices.front())
      vertices.insert(vertices.begin(), crack.front()), advances.insert(advances.begin(), advance);
    if (crack.back() != vertices.back()) vertices.push_back(crack.back()), advances.push_back(advance);
  }
}

void GrowthResults::frame() {
  framed_ = true;
  if (!vtk_) return;
  const auto& [file, assembly, state, srifs] = *last_;
  auto mesh = mesh_of(file_.content, assembly);
  auto frame = frame_of(file_.content, assembly, double(advance_), advance_, factor_ * state, true);
  for (std::size_t k = 0; k < frame.damage.size(); ++k) {
    const double now = assembly.cut[k];
    double first = assembly.galerkin() ? 0 : first_cut_[k];
    if (assembly.galerkin() && on_any(file_.content.cracks, mesh.positions[k], 1e-6 * mesh.spacing)) first = now;
    frame.damage[k] = first < 1 ? 1 - (1 - now) / (1 - first) : 0;
    mesh.cut[k] = first;
  }
  vtk_->remesh(std::move(mesh));
  vtk_->write(frame);
}

void GrowthResults::write_state() const {
  const auto& c = file_.content;
  post::StateFile hdf5(folder_ / "state.h5", mesh_of(c, last_->assembly), resolved_, PDPLATE_VERSION);
  hdf5.write(frame_of(c, last_->assembly, double(advance_), advance_, factor_ * last_->state, false), nullptr);
  for (const auto& [name, table] : {std::pair{"history", &history_}, {"growth", &growth_}, {"srif", &srifs_}})
    hdf5.write(name, *table);
  hdf5.close();
}

post::Summary GrowthResults::finish(post::Summary summary, const fracture::Grown& grown, Stopwatch& stopwatch) {
  if (last_ && !framed_) frame();
  if (last_ && file_.content.output.hdf5) write_state();
  post::Table cracks{{"crack", "vertex", "x", "y", "advance"}, {}};
  for (std::size_t c = 0; c < lines_.size(); ++c)
    for (std::size_t i = 0; i < lines_[c].vertices.size(); ++i)
      cracks.rows.push_back({double(c), double(i), lines_[c].vertices[i].x(), lines_[c].vertices[i].y(), lines_[c].advances[i]});
  post::write_csv(folder_ / "growth.csv", growth_);
  post::write_csv(folder_ / "history.csv", history_);
  post::write_csv(folder_ / "srif.csv", srifs_);
  post::write_csv(folder_ / "cracks.csv", cracks);
  if (!probes_.rows.empty()) post::write_csv(folder_ / "probes.csv", probes_);
  if (vtk_) post::write_crack_lines(folder_ / "cracks.vtp", lines_);
  stopwatch.lap("output");

  if (last_) summary.srif = scaled(last_->srifs, factor_);
  summary.growth = post::GrowthSummary{grown.outcome, grown.advances, first_factor_, largest_factor_, {}, {}, {}, {}};
  for (const auto& crack : grown.cracks) summary.growth->lengths.push_back(geometry::length(crack));
  const auto& books = grown.ledger;
  summary.energy = {{"strain", books.strain}, {"external_work", books.external_work},
                    {"fracture", books.fracture}, {"released", books.released()}};
  write_summary(summary, resolved_, stopwatch, folder_);
  return summary;
}

}  // namespace cases
