#include "cases/driver/bond_results.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/driver/gate.hpp"
#include "cases/driver/severed_frame.hpp"
#include "post/files/whole_file.hpp"

namespace cases {

BondResults::BondResults(const CaseFile& file, const Assembly& assembly, const fracture::SeveredPlate& plate, BondCracks& cracks,
                         std::filesystem::path folder)
    : file_(file), assembly_(assembly), plate_(plate), cracks_(cracks), folder_(std::move(folder)),
      resolved_(resolved_toml(file.content)) {
  growth_.columns = {"advance",      "load_factor",   "displacement",  "critical_load_factor", "stable",
                     "broken_bonds", "crack_length",  "tips",          "external_work",        "strain_energy",
                     "fracture_energy", "released_energy"};
  history_.columns = {"time",          "step",            "strain_energy",   "kinetic_energy",
                      "external_work", "fracture_energy", "released_energy", "max_abs_w",
                      "load_factor",   "displacement"};
  probe_table_.columns = {"time", "probe", "x", "y", "w", "theta_x", "theta_y"};
  srifs_.columns = post::srif_columns();
  for (const auto& [name, position] : file.content.output.probes) probes_.emplace_back(name, probe(assembly, position));
  std::filesystem::create_directories(folder_);
  post::write_whole(folder_ / "case.resolved.toml", resolved_);
  if (file.content.output.vtk) vtk_.emplace(folder_, post::Mesh{});
}

void BondResults::event(const fracture::BondEvent& event, bool new_lines, bool last) {
  const auto when = fmt::format("at advance {}", event.advance);
  const auto& ledger = event.load.ledger;
  require_finite({{"load factor", event.load.factor()},
                  {"work", ledger.external_work},
                  {"strain energy", ledger.strain},
                  {"fracture energy", ledger.fracture}},
                 when);
  require_finite(*event.plate.state, when);
  advance_ = event.advance, books_ = event.load.ledger;
  row(event);
  const double factor = event.load.factor();
  if (!event.breaks.empty() && !last && !first_factor_) first_factor_ = factor;
  largest_factor_ = std::max(largest_factor_, factor);
  state_ = factor * *event.plate.state;
  for (const auto& [name, shares] : probes_) {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (const auto& share : shares) u += share.weight * state_.col(share.point);
    const auto& x = file_.content.output.probes.at(name);
    probe_table_.rows.push_back({double(advance_), name, x.x(), x.y(), u[0], u[1], u[2]});
  }
  if (file_.content.srif && (new_lines || advance_ == 0)) factors(factor, *event.plate.state);
  framed_ = false;
  if (advance_ % file_.content.growth->frames_every == 0) frame();
}

void BondResults::row(const fracture::BondEvent& event) {
  const auto time = double(event.advance);
  const auto& books = event.load.ledger;
  const double factor = event.load.factor(), displacement = event.load.displacement();
  const post::Cell critical = std::isfinite(event.critical) ? post::Cell(event.critical) : post::Cell();
  growth_.rows.push_back({time, factor, displacement, critical, double(event.stable), double(cracks_.broken()),
                          cracks_.length(), double(cracks_.tips().size()), books.external_work, books.strain, books.fracture,
                          books.released()});
  const auto points = Eigen::Index(assembly_.boundary.cloud.plate_points);
  history_.rows.push_back({time, time, books.strain, 0.0, books.external_work, books.fracture, books.released(),
                           factor * event.plate.state->row(0).head(points).cwiseAbs().maxCoeff(), factor, displacement});
}

/// Intensity factors where the tips are; none of tips beside edges, bends and other cracks.
void BondResults::factors(double factor, const plate::State& state) {
  const Case& c = file_.content;
  plate::Forces force;
  plate_.internal_force(state, force);
  const auto paths = cracks_.paths();
  latest_.clear();
  for (const auto& [number, tip] : cracks_.tips_of_cracks()) try {
      for (auto& srif : severed_tip_methods(c, assembly_, plate_.families(), paths, tip, *c.srif)(factor * state, factor * force, true)) {
        srif.tip = number;
        post::normalize(srif, *c.srif, c.section.thickness);
        latest_.push_back(std::move(srif));
      }
    } catch (const std::invalid_argument&) {
      continue;
    }
  require_finite(latest_, fmt::format("at advance {}", advance_));
  post::append(srifs_, double(advance_), latest_);
}

void BondResults::frame() {
  framed_ = true;
  if (!vtk_) return;
  auto frame = frame_of(file_.content, assembly_, double(advance_), advance_, state_, false);
  vtk_->remesh(severed_frame(file_.content, assembly_, plate_.families(), frame, state_));
  vtk_->write(frame);
}

post::Summary BondResults::finish(post::Summary summary, const std::string& outcome, Stopwatch& stopwatch) {
  const Case& c = file_.content;
  if (state_.cols() > 0 && !framed_) frame();
  if (state_.cols() > 0 && c.output.hdf5) {
    post::StateFile hdf5(folder_ / "state.h5", mesh_of(c, assembly_), resolved_, PDPLATE_VERSION);
    hdf5.write(frame_of(c, assembly_, double(advance_), advance_, state_, false), nullptr);
    for (const auto& [name, table] : {std::pair{"history", &history_}, {"growth", &growth_}, {"srif", &srifs_}})
      hdf5.write(name, *table);
    hdf5.close();
  }
  post::write_csv(folder_ / "growth.csv", growth_);
  post::write_csv(folder_ / "history.csv", history_);
  if (c.srif) post::write_csv(folder_ / "srif.csv", srifs_);
  if (!probes_.empty()) post::write_csv(folder_ / "probes.csv", probe_table_);
  cracks_.write(folder_, "advance", c.output.vtk);
  stopwatch.lap("output");

  summary.srif = latest_;
  auto& growth = summary.growth.emplace();
  growth.outcome = outcome, growth.advances = advance_;
  growth.first_load_factor = first_factor_, growth.largest_load_factor = largest_factor_;
  growth.broken_bonds = cracks_.broken();
  if (cracks_.growth() > 0 && c.growth->fracture_energy > 0)
    growth.spent = (books_.external_work - books_.strain) / (c.growth->fracture_energy * c.section.thickness * cracks_.growth());
  for (const auto& line : cracks_.lines()) growth.lengths.push_back(line.length);
  summary.energy = {{"strain", books_.strain}, {"external_work", books_.external_work},
                    {"fracture", books_.fracture}, {"released", books_.released()}};
  write_summary(summary, resolved_, stopwatch, folder_);
  return summary;
}

}  // namespace cases
