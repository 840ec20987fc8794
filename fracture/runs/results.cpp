#include "fracture/runs/results.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "fracture/growth/distrust.hpp"
#include "fracture/growth/motion/moving_growth.hpp"
#include "fracture/growth/words.hpp"
#include "fracture/runs/shared/among_ranks.hpp"
#include "fracture/runs/shared/own_drawing.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/heated/heat.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/figures/curve_plot.hpp"
#include "post/files/archive.hpp"
#include "post/report/curves.hpp"
#include "post/report/overlaps.hpp"

namespace fracture {

Results::Results(const RunPlan& plan, const plate::Formulation& plate, const std::vector<post::TipMethods>& methods,
                 post::Recorder recorder)
    : plan_(plan),
      plate_(plate),
      tip_methods_(methods),
      recorder_(std::move(recorder)),
      probes_(probes_of(plan.probes, plate)),
      factors_(plan.problem.section.thickness),
      reactions_(plate, plan.analysis.rotary_inertia, plan.analysis.method == plate::Analysis::Method::lanczos,
                 plan.analysis.damping.value_or(plate::Damping{}).mass),
      extremes_(plate),
      energy_gate_(plan.growth ? post::EnergyGate::Plate::grows : post::EnergyGate::Plate::moves) {
  if (!recorder_.draws() && !recorder_.stores()) return;
  const auto mesh = recorder_.draws() || plan_.report ? plate.mesh() : post::points_of(plate);
  if (shared()) {
    drawing_ = std::make_unique<OwnDrawing>(plate, mesh);
    recorder_.open(drawing_->mesh());
    return;
  }
  if (plan_.report) pictures_.open(mesh);
  recorder_.open(mesh);
}

Results::~Results() = default;

void Results::sample(const plate::Instant& now, bool last) {
  const auto heat = plate::heat_at(plate_, now.time);
  const double heated = plate::stored(plate_, heat, now.state);
  strain_energy_ = now.strain_energy + heated, external_work_ = now.external_work + heated;
  post::Sample row{now.time, now.step, now.state, strain_energy_, now.kinetic_energy, external_work_, 0};
  post::EnergyGate::Books books{now.strain_energy + now.kinetic_energy + now.dissipated,
                                now.strain_energy + now.discrete_kinetic_energy + now.dissipated, now.external_work};
  row.discrete_energy = books.kept + now.potential;
  if (plan_.analysis.damping) row.dissipated_energy = now.dissipated;
  if (now.blow) {
    const auto& blow = *now.blow;
    blows_.rows.push_back({now.time, blow.place, blow.velocity, blow.force, blow.largest, blow.touching});
  }
  if (growth_) {
    row.fracture_energy = growth_->fracture_energy();
    books.energy += row.fracture_energy + growth_->frozen_energy();
    row.energy_residual = residual_ = now.external_work - books.energy;
    growth_->look(now.time);
  }
  recorder_.row(row, probes_, plate_.boundary());
  const auto when = fmt::format("at step {}, time {:g}", now.step, now.time);
  if (plan_.moves()) energy_gate_.look(books, when);
  if (plan_.moves() && last) energy_gate_.look(books, when);  // no further row looks back at this one
  reactions_.add(now, growth_ ? growth_->plate() : plate_);
  if (!growth_) extremes_.row(now);
  times_.push_back(now.time);
  const auto factors = [&]() -> std::vector<post::Srif> {
    if (growth_) return of_all(growth_->factors(now.state));
    if (!plan_.srif || factors_.known()) return {};
    return of_all(post::srifs(plate_, *plan_.srif, tip_methods_, now.what_strains(), last, &heat));
  };
  factors_.add(factors(), fmt::format("at step {}, time {:g}", now.step, now.time));
}

void Results::frame(const plate::Instant& now) {
  next_frame_ = plan_.frames_every ? next_frame_ + *plan_.frames_every : INFINITY;
  if (!recorder_.draws() && !recorder_.stores()) return;
  const bool of_mode = plan_.analysis.kind == plate::Analysis::Kind::frequencies;
  const auto heat = of_mode ? plate::Heat{} : plate::heat_at(plate_, now.time);
  auto frame = post::frame_of(plate_, now.time, now.step, now.what_strains(), !growth_, &heat);
  if (now.rest) frame.state = now.state.leftCols(frame.state.cols());
  std::optional<plate::Mesh> mesh;
  if (growth_) {
    auto drawn = growth_->draw(frame, now.state, factors_.last());
    if (recorder_.draws()) mesh = std::move(drawn);
  }
  if (frame.resultants.von_mises.size() > 0 && !growth_) extremes_.frame(now.time, frame.resultants);
  const bool rates = recorder_.stores() && plan_.moves();
  if (drawing_) {
    if (mesh) drawing_ = std::make_unique<OwnDrawing>(plate_, *mesh), mesh = drawing_->mesh();
    recorder_.frame(drawing_->frame(std::move(frame)), std::move(mesh),
                    rates ? drawing_->own(now.velocity()) : plate::State(3, 0));
    return;
  }
  if (plan_.report) {
    if (mesh) pictures_.open(*mesh);
    pictures_.look(frame);
  }
  plate::State velocity;
  if (rates) velocity = now.velocity().leftCols(Eigen::Index(plate_.cloud().plate_points));
  recorder_.frame(std::move(frame), std::move(mesh), std::move(velocity));
}

void Results::mode(std::size_t number, const plate::Mode& mode) {
  const auto when = fmt::format("of mode {}", number);
  post::require_finite({{"frequency", mode.frequency}, {"residual", mode.residual}}, when);
  post::require_finite(mode.shape, when);
  frequencies_.push_back({number, mode.frequency, 2 * std::numbers::pi * mode.frequency, mode.residual});
  recorder_.mode(frequencies_.back());
  frame({number, double(number), mode.shape, {}, 0, 0, 0, 0});
}

/// Tables and numbers of the growth; the cracks as they have grown.
post::Cracks Results::finish_growth(post::Summary& summary) {
  const auto& record = growth_->record();
  recorder_.table("growth", record.growth);
  recorder_.table("tips", record.tips);
  recorder_.table("cracks", record.crack_table());
  const auto moved = growth_->moved();
  summary.growth = post::GrowthSummary{in_words(moved), moved.advances,      {},           {},
                                       moved.spent,     moved.largest_speed, moved.broken, moved.lengths};
  for (const auto& some : {distrust_of_spent(*plan_.growth, moved, plan_.problem.section),
                           distrust_of_directions(moved, plate_.remedy()), record.cut_places(plan_.problem)})
    summary.warnings.insert(summary.warnings.end(), some.begin(), some.end());
  summary.energy.emplace_back("fracture", growth_->fracture_energy());
  if (growth_->frozen_energy() > 0) summary.energy.emplace_back("frozen", growth_->frozen_energy());
  if (residual_) summary.energy.emplace_back("residual", *residual_);
  return record.cracks;
}

post::Summary Results::finish(post::Summary summary, plate::Stopwatch& stopwatch) {
  const auto& section = plan_.problem.section;
  std::vector<post::FaceOverlaps> overlaps;
  if (!tip_methods_.empty()) {
    auto table = factors_.table(times_);
    overlaps = post::face_overlaps(table);
    recorder_.table("srif", std::move(table));
  }
  const auto cracks = growth_ ? finish_growth(summary) : post::given_cracks(plate_.paths());
  if (growth_ || !cracks.lines.empty()) recorder_.cracks(cracks, factors_.last());
  if (!reactions_.empty()) recorder_.table("reactions", reactions_.table());
  if (!blows_.rows.empty()) recorder_.table("impact", blows_);
  const auto& history = recorder_.history();
  if (plan_.moves() && recorder_.plots())
    recorder_.picture("curves",
                      post::to_svg(post::curves_of_motion(plan_.title, times_, factors_.rows(), history, plan_.si())));
  summary.accuracy = accuracy_;
  summary.frequencies = frequencies_;
  post::conclude(summary, {section, plan_.srif, plan_.si(), history, reactions_, factors_.last()});
  if (!growth_) post::look_for_largest(summary, section, of_all(extremes_.found()), times_, factors_.rows());
  const auto at_time = [](double time) { return fmt::format("t = {:.4g}", time); };
  const auto crack = [&](std::size_t tip) { return std::size_t(plate_.tips()[tip].crack); };
  for (const auto& some :
       {post::left_out(plate_.tips(), tip_methods_),
        post::distrust_of_factors(summary.srif, factors_.largest(), section.thickness, plate_.remedy()),
        factors_.distrust(), post::tips_that_grow(summary),
        post::sinking_supports(summary.reactions, plan_.problem,
                               section.thickness * summary.deflection_over_thickness.value_or(0)),
        post::distrust_of_faces(overlaps, section, growth_ ? std::function<std::size_t(std::size_t)>() : crack,
                                plan_.moves() ? at_time : std::function<std::string(double)>())})
    summary.warnings.insert(summary.warnings.end(), some.begin(), some.end());
  if (plan_.moves()) summary.overlaps = std::move(overlaps);
  summary = recorder_.finish(std::move(summary), stopwatch);
  write_report(plan_, pictures_);
  return summary;
}

template <typename Archive>
void Results::memory(Archive& archive) {
  archive(factors_, reactions_, extremes_, pictures_, times_, residual_, energy_gate_, strain_energy_, external_work_,
          next_frame_, blows_);
}

void Results::remember(plate::OutArchive& archive) {
  recorder_.remember(archive);
  if (!shared()) return memory(archive);
  auto own = extremes_;
  extremes_.so_far(of_all(own.so_far())), extremes_.state().resize(3, 0);
  memory(archive);
  extremes_ = std::move(own);
}

void Results::recall(plate::InArchive& archive) {
  recorder_.recall(archive);
  memory(archive);
}

}  // namespace fracture
