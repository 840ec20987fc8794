#include "cases/runs/results.hpp"

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "cases/input/compatibility.hpp"
#include "cases/runs/analyses.hpp"
#include "fracture/growth/distributed_growth.hpp"
#include "fracture/growth/growth.hpp"
#include "fracture/growth/moving_growth.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/archive.hpp"
#include "post/report/curve_plot.hpp"
#include "post/report/curves.hpp"
#include "post/report/overlaps.hpp"

namespace cases {

void add_elastic_support_energy(const plate::Formulation& plate, const plate::State& state, post::Summary& summary) {
  const auto& [elastic_supports, map] = std::tie(plate.boundary().elastic_supports, plate.boundary().map);
  if (!elastic_supports.parts().empty()) summary.energy.emplace_back("attached", elastic_supports.energy(state, map));
  if (elastic_supports.unilateral()) summary.touching = elastic_supports.contact_share(state, map);
}

Results::Results(Outputs& outputs, const plate::Formulation& plate, const std::vector<post::TipMethods>& methods)
    : outputs_(outputs),
      plate_(plate),
      tip_methods_(methods),
      factors_(outputs.factors()),
      reactions_(plate, content().analysis.rotary_inertia,
                 content().analysis.method == plate::Analysis::Method::lanczos,
                 content().analysis.damping.value_or(plate::Damping{}).mass),
      extremes_(plate, content().output.stress_distance),
      energy_balance_(content().growth ? post::EnergyBalance::Plate::grows : post::EnergyBalance::Plate::moves) {
  reactions_.along_edges(content().output.edge_reactions);
}

void Results::in_plane(const plate::Formulation& membrane, MembraneResult result) {
  membrane_ = &membrane, in_plane_ = std::move(result);
  outputs_.summary().membrane = in_plane_->summary;
}

void Results::touching(FacesFound found) {
  outputs_.summary().contact = found.summary;
  closed_ = std::move(found.closed), faces_ = std::move(found.faces);
}

/// Finds the stress by bending and membrane forces together, where the strain energy is larger than before.
void Results::look_at_stress(const plate::Instant& now, const plate::Heat& heat) {
  auto frame = post::frame_of(plate_, now.time, now.step, now.state, true, &heat);
  add_in_plane(frame, plate_, *membrane_, *in_plane_);
  extremes_.frame(now.time, frame.resultants);
}

void Results::sample(const plate::Instant& now, bool last) {
  const auto heat = plate::heat_at(plate_, now.time);
  double heated = plate::stored(plate_, heat, now.state);
  if (in_plane_ && content().moves()) heated += in_plane_->stored;  // whose energies `now` has without heat
  strain_energy_ = now.strain_energy + heated, external_work_ = now.external_work + heated;
  post::Sample row{now.time, now.step, now.state, strain_energy_, now.kinetic_energy, external_work_, 0};
  post::EnergyBalance::Terms terms{now.strain_energy + now.kinetic_energy + now.dissipated,
                                   now.strain_energy + now.discrete_kinetic_energy + now.dissipated, now.external_work};
  row.discrete_energy = terms.discrete + now.potential;
  if (content().analysis.damping || now.faces) row.dissipated_energy = now.dissipated;
  if (now.faces) row.contact_energy = now.contact_so_far.lost;
  if (now.contact_force) {
    const auto& contact_force = *now.contact_force;
    contact_forces_.rows.push_back({now.time, contact_force.place, contact_force.velocity, contact_force.force,
                                    contact_force.largest, contact_force.touching});
  }
  if (growth_) {
    row.fracture_energy = growth_->fracture_energy();
    terms.energy += row.fracture_energy + growth_->frozen_energy();
    row.energy_residual = residual_ = now.external_work - terms.energy;
    growth_->look(now.time);
  }
  if (in_plane_) row.in_plane = &in_plane_->fields.displacement;
  outputs_.row(row, plate_);
  const auto when = fmt::format("at step {}, time {:g}", now.step, now.time);
  if (in_plane_) {  // beside heat that leaves the plate at rest, held or free, its own energies are rounding
    const double stored = std::abs(in_plane_->stored);
    terms.energy += stored, terms.discrete += stored, terms.work += stored;
  }
  if (content().moves()) energy_balance_.check(terms, when);
  if (content().moves() && last) energy_balance_.check(terms, when);  // no further row looks back at this one
  reactions_.add(now, growth_ ? growth_->plate() : plate_);
  if (!growth_) extremes_.row(now);
  if (in_plane_ && !growth_ && content().moves() && extremes_.time() == now.time) look_at_stress(now, heat);
  times_.push_back(now.time);
  const auto factors = [&]() -> std::vector<post::Srif> {
    if (growth_) return fracture::of_all(plate_, growth_->factors(now.state));
    if (!content().srif || factors_.known()) return {};
    return fracture::of_all(plate_,
                            post::srifs(plate_, *content().srif, tip_methods_, now.what_strains(), last, &heat));
  };
  auto found = factors();
  if (in_plane_) post::add_membrane(found, in_plane_->factors, content().section);
  if (!closed_.empty()) post::close(found, closed_, content().section);
  factors_.add(std::move(found), fmt::format("at step {}, time {:g}", now.step, now.time));
}

void Results::frame(const plate::Instant& now) {
  next_frame_ = content().output.every ? next_frame_ + *content().output.every : INFINITY;
  if (!outputs_.takes_frames() && !in_plane_) return;
  const auto& recorder = outputs_.recorder();
  const auto kind = content().analysis.kind;
  const bool of_mode = kind == plate::Analysis::Kind::frequencies || kind == plate::Analysis::Kind::buckling;
  const auto heat = of_mode ? plate::Heat{} : plate::heat_at(plate_, now.time);
  auto frame = post::frame_of(plate_, now.time, now.step, now.what_strains(), !growth_, &heat);
  if (now.rest) frame.state = now.state.leftCols(frame.state.cols());
  std::optional<plate::Mesh> mesh;
  if (growth_) {
    auto drawn = growth_->draw(frame, now.state, factors_.last());
    if (recorder.draws()) mesh = std::move(drawn);
  }
  if (in_plane_) add_in_plane(frame, plate_, *membrane_, *in_plane_);
  if (frame.resultants.von_mises.size() > 0 && !growth_) extremes_.frame(now.time, frame.resultants);
  if (!outputs_.takes_frames()) return;
  const bool rates = recorder.stores() && content().moves();
  outputs_.frame(plate_, std::move(frame), std::move(mesh), rates ? now.velocity() : plate::no_state());
}

void Results::mode(std::size_t number, const plate::Mode& mode, const plate::Formulation* membrane) {
  const auto when = fmt::format("of mode {}", number);
  post::require_finite({{"frequency", mode.frequency}, {"residual", mode.residual}}, when);
  post::require_finite(mode.shape, when, plate_);
  frequencies_.push_back({number, mode.frequency, 2 * std::numbers::pi * mode.frequency, mode.residual});
  if (membrane) frequencies_.back().share_in_plane = mode.share_in_plane;
  outputs_.recorder().mode(frequencies_.back());
  shape(number, mode.shape, mode.in_plane, membrane);
}

void Results::shape(std::size_t number, const plate::State& bending, const plate::State& in_plane,
                    const plate::Formulation* membrane) {
  if (membrane && in_plane.cols() > 0) {
    membrane_ = membrane;
    in_plane_ = results_of_shape(plate_, *membrane, {bending, in_plane}, {}, fmt::format("of mode {}", number));
  }
  frame({number, double(number), bending, {}, 0, 0, 0, 0});
  in_plane_.reset();
}

/// Advice where the points do not resolve something. Growth in motion has bonds only.
std::string Results::remedy() const {
  return growth_ ? fmt::format("set discretization.spacing = {:.2g}", plate_.discretization().spacing / 2)
                 : plate_.remedy();
}

/// Tables and numbers of the growth; the cracks as they have grown.
post::Cracks Results::finish_growth() {
  auto& recorder = outputs_.recorder();
  auto& summary = outputs_.summary();
  const auto& record = growth_->record();
  recorder.table("growth", record.growth);
  recorder.table("tips", record.tips);
  recorder.table("cracks", record.crack_table());
  const auto outcome = growth_->outcome();
  summary.growth = post::GrowthSummary{fracture::in_words(outcome),
                                       outcome.advances,
                                       {},
                                       {},
                                       outcome.spent,
                                       outcome.largest_speed,
                                       outcome.broken,
                                       outcome.lengths,
                                       {},
                                       outcome.stopped.empty() && outcome.unsteady.empty()};
  auto spent = fracture::warnings_about_spent_energy(*content().growth, outcome, content().section, remedy());
  const std::string by_bonds = "set `criterion` = \"bond_energy\"";
  for (auto& line : spent)
    if (line.ends_with(by_bonds) && !may_break_bonds(content()))
      line.replace(line.size() - by_bonds.size(), by_bonds.size(), "set smaller loads");
  outputs_.warn(spent);
  outputs_.warn(fracture::warnings_about_directions(outcome, remedy()));
  outputs_.warn(record.cut_places(content()));
  summary.energy.emplace_back("fracture", growth_->fracture_energy());
  if (growth_->frozen_energy() > 0) summary.energy.emplace_back("frozen", growth_->frozen_energy());
  if (residual_) summary.energy.emplace_back("residual", *residual_);
  return record.cracks;
}

void Results::finish() {
  if (!faces_.rows.empty()) outputs_.recorder().table("contact", std::move(faces_));
  const auto& section = content().section;
  auto& recorder = outputs_.recorder();
  auto& summary = outputs_.summary();
  std::vector<post::FaceOverlaps> overlaps;
  if (!tip_methods_.empty()) {
    auto table = factors_.table(times_);
    overlaps = post::face_overlaps(table);
    recorder.table("srif", std::move(table));
  }
  if (growth_)
    recorder.cracks(finish_growth(), factors_.last());
  else
    outputs_.given_cracks(plate_, factors_.last());
  post::record(reactions_, recorder);
  if (!contact_forces_.rows.empty()) recorder.table("impact", contact_forces_);
  const auto& history = recorder.history();
  if (content().moves() && recorder.plots())
    recorder.picture("curves", post::to_svg(post::curves_of_motion(content().title, times_, factors_.rows(), history,
                                                                   content().si())));
  summary.frequencies = frequencies_;
  post::conclude(summary, {.section = section,
                           .options = content().srif,
                           .si = content().si(),
                           .history = history,
                           .reactions = reactions_,
                           .factors = factors_.last(),
                           .stretches = content().stretches,
                           .may_stretch = may_stretch(content())});
  if (!growth_)
    post::look_for_largest(summary, section, fracture::of_all(plate_, extremes_.found()), times_, factors_.rows());
  const auto at_time = [](double time) { return fmt::format("t = {:.4g}", time); };
  const auto crack = [&](std::size_t tip) { return std::size_t(plate_.tips()[tip].crack); };
  if (content().srif) outputs_.warn(post::left_out(plate_.tips(), tip_methods_, *content().srif));
  outputs_.warn(post::warnings_about_factors(summary.srif, factors_.largest(), section.thickness, remedy()));
  outputs_.warn(factors_.warnings(content().analysis.tolerance));
  outputs_.warn(post::tips_that_grow(summary));
  outputs_.warn(post::sinking_supports(summary.reactions, content(),
                                       section.thickness * summary.deflection_over_thickness.value_or(0)));
  if (!content().moves()) outputs_.warn(post::unbalanced_hubs(summary.reactions, content()));
  if (in_plane_) {
    overlaps.clear();
    outputs_.warn(in_plane_->warnings);
    if (!content().faces_touch()) {
      outputs_.warn(warnings_about_overlaps(summary.srif, may_touch(content(), plate_)));
    }
  }
  outputs_.warn(post::warnings_about_faces(
      overlaps, section, growth_ ? std::function<std::size_t(std::size_t)>() : crack,
      content().moves() ? at_time : std::function<std::string(double)>(), may_touch(content(), plate_)));
  if (content().moves()) summary.overlaps = std::move(overlaps);
}

template <typename Archive>
void Results::memory(Archive& archive) {
  archive(factors_, reactions_, extremes_, times_, residual_, energy_balance_, strain_energy_, external_work_,
          next_frame_, contact_forces_);
}

void Results::save(plate::OutArchive& archive) {
  outputs_.save(archive);
  const auto own = extremes_.so_far();
  extremes_.so_far(fracture::of_all(plate_, own));
  memory(archive);
  extremes_.so_far(own);
}

void Results::restore(plate::InArchive& archive) {
  outputs_.restore(archive);
  memory(archive);
}

AnalysisWithResults::AnalysisWithResults(const ValidatedPlate& ready, Outputs& outputs)
    : PlateAnalysis(ready, outputs), results_(outputs, plate_, ready.tip_methods) {}

}  // namespace cases
