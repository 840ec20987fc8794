#include "cases/runs/results.hpp"

#include <fmt/format.h>
#include <cmath>
#include <numbers>
#include <optional>

#include "cases/runs/distributed_run.hpp"
#include "fracture/growth/distributed_growth.hpp"
#include "fracture/growth/growth.hpp"
#include "fracture/growth/moving_growth.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/archive.hpp"
#include "post/report/cost_model.hpp"
#include "post/report/curve_plot.hpp"
#include "post/report/curves.hpp"
#include "post/report/html_report.hpp"
#include "post/report/overlaps.hpp"

namespace fracture {
namespace {

using geometry::Point;

constexpr auto none = std::uint32_t(-1);

/// A part of a mesh, with numbers of its own.
class Part {
public:
  explicit Part(const plate::Mesh& whole)
      : whole_(whole), number_(whole.positions.size() + whole.corners.size(), none) {
    mesh.spacing = whole.spacing, mesh.thickness = whole.thickness;
  }

  template <typename Cell>
  void take(const Cell& cell, std::vector<Cell>& cells) {
    for (const auto vertex : cell)
      if (number_[vertex] == none)
        number_[vertex] = 0, (vertex < whole_.positions.size() ? points : corners_).push_back(vertex);
    cells.push_back(cell);
  }
  /// A point that may be in no cell.
  void take(std::uint32_t point) {
    if (number_[point] == none) number_[point] = 0, points.push_back(point);
  }
  /// Numbers what has been taken, and takes what its corners need.
  void finish() {
    const auto drawn = points.size();
    for (const auto corner : corners_)
      for (const auto& source : whole_.corners[corner - whole_.positions.size()].sources) take(source.point);
    mesh.others = points.size() - drawn;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      number_[points[i]] = i;
      mesh.positions.push_back(whole_.positions[points[i]]), mesh.areas.push_back(whole_.areas[points[i]]);
      mesh.cut.push_back(whole_.cut[points[i]]);
      if (!whole_.numbers.empty()) mesh.numbers.push_back(whole_.numbers[points[i]]);
    }
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      number_[corners_[i]] = std::uint32_t(points.size()) + i;
      mesh.corners.push_back(whole_.corners[corners_[i] - whole_.positions.size()]);
      for (auto& source : mesh.corners.back().sources) source.point = number_[source.point];
    }
    for (auto& cell : mesh.quads)
      for (auto& vertex : cell) vertex = number_[vertex];
    for (auto& cell : mesh.triangles)
      for (auto& vertex : cell) vertex = number_[vertex];
  }

  plate::Mesh mesh;
  std::vector<std::uint32_t> points;

private:
  const plate::Mesh& whole_;
  std::vector<std::uint32_t> number_, corners_;  // of the global vertices
};

bool before(const Point& a, const Point& b) {
  return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
}

/// Values of the plate's points with those of others' points from their owners, three rows at most.
template <typename Rows>
void fetch(const plate::Formulation& plate, Rows&& values) {
  plate::State all = plate::State::Zero(3, Eigen::Index(plate.points()));
  all.topLeftCorner(values.rows(), values.cols()) = values;
  plate.constraints().fetch(all);
  values = all.topLeftCorner(values.rows(), values.cols());
}

}  // namespace

OwnedMesh::OwnedMesh(const plate::Formulation& plate) : OwnedMesh(plate, plate.mesh()) {}

OwnedMesh::OwnedMesh(const plate::Formulation& plate, const plate::Mesh& whole) : plate_(plate) {
  Part part(whole);
  for (std::uint32_t k = 0; k < plate.cloud().plate_points; ++k)
    if (plate.boundary().owns(k)) part.take(k);
  own_ = part.points.size();
  const auto& lattice = plate.boundary().lattice;
  const auto own = [&](const auto& cell) {  // whose the lowest of its points is, of these the one to the left
    std::optional<std::uint32_t> first;
    for (const auto k : cell)
      if (k < whole.positions.size() && (!first || before(lattice[k], lattice[*first]))) first = k;
    return first ? plate.boundary().owns(*first) : plate.here(whole.corners[cell[0] - whole.positions.size()].position);
  };
  for (const auto& cell : whole.quads)
    if (own(cell)) part.take(cell, part.mesh.quads);
  for (const auto& cell : whole.triangles)
    if (own(cell)) part.take(cell, part.mesh.triangles);
  part.finish();
  mesh_ = std::move(part.mesh), points_ = std::move(part.points), mesh_.own = own_;
}

std::optional<OwnedMesh> owned_mesh(const plate::Formulation& plate, const plate::Mesh& whole) {
  return plate.communicator().distributed() ? std::optional<OwnedMesh>(std::in_place, plate, whole) : std::nullopt;
}

plate::State OwnedMesh::own(const plate::State& of_plate, std::size_t count) const {
  plate::State result(3, Eigen::Index(count));
  for (std::size_t i = 0; i < count; ++i) result.col(Eigen::Index(i)) = of_plate.col(Eigen::Index(points_[i]));
  return result;
}

post::Frame OwnedMesh::frame(post::Frame seen) const {
  auto& resultants = seen.resultants;
  post::Frame result{seen.time, seen.step, own(seen.state, points_.size()), {}, {}, std::move(seen.cracks)};
  if (resultants.von_mises.size() == 0) return result;
  fetch(plate_, resultants.moments);
  fetch(plate_, resultants.shear);
  fetch(plate_, resultants.von_mises.transpose());
  const auto count = Eigen::Index(points_.size());
  result.resultants = plate::resultants_of(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = Eigen::Index(points_[std::size_t(i)]);
    result.resultants.moments.col(i) = resultants.moments.col(k);
    result.resultants.shear.col(i) = resultants.shear.col(k);
    result.resultants.von_mises[i] = resultants.von_mises[k];
    result.damage.push_back(seen.damage[std::size_t(k)]);
  }
  return result;
}

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
      energy_balance_(plan.growth ? post::EnergyBalance::Plate::grows : post::EnergyBalance::Plate::moves) {
  if (!recorder_.draws() && !recorder_.stores()) return;
  const auto mesh = recorder_.draws() || plan_.report ? plate.mesh() : post::points_of(plate);
  if (plate.communicator().distributed()) {
    drawing_ = std::make_unique<OwnedMesh>(plate, mesh);
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
  post::EnergyBalance::Terms terms{now.strain_energy + now.kinetic_energy + now.dissipated,
                                   now.strain_energy + now.discrete_kinetic_energy + now.dissipated, now.external_work};
  row.discrete_energy = terms.discrete + now.potential;
  if (plan_.analysis.damping) row.dissipated_energy = now.dissipated;
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
  recorder_.row(row, probes_, plate_.boundary());
  const auto when = fmt::format("at step {}, time {:g}", now.step, now.time);
  if (plan_.moves()) energy_balance_.check(terms, when);
  if (plan_.moves() && last) energy_balance_.check(terms, when);  // no further row looks back at this one
  reactions_.add(now, growth_ ? growth_->plate() : plate_);
  if (!growth_) extremes_.row(now);
  times_.push_back(now.time);
  const auto factors = [&]() -> std::vector<post::Srif> {
    if (growth_) return of_all(plate_.communicator(), growth_->factors(now.state));
    if (!plan_.srif || factors_.known()) return {};
    return of_all(plate_.communicator(),
                  post::srifs(plate_, *plan_.srif, tip_methods_, now.what_strains(), last, &heat));
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
    if (mesh) drawing_ = std::make_unique<OwnedMesh>(plate_, *mesh), mesh = drawing_->mesh();
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
  post::require_finite(mode.shape, when, plate_.communicator());
  frequencies_.push_back({number, mode.frequency, 2 * std::numbers::pi * mode.frequency, mode.residual});
  recorder_.mode(frequencies_.back());
  frame({number, double(number), mode.shape, {}, 0, 0, 0, 0});
}

/// Advice where the points do not resolve something. Growth in motion has bonds only.
std::string Results::remedy() const {
  return growth_ ? fmt::format("set discretization.spacing = {:.2g}", plate_.discretization().spacing / 2)
                 : plate_.remedy();
}

/// Tables and numbers of the growth; the cracks as they have grown.
post::Cracks Results::finish_growth(post::Summary& summary) {
  const auto& record = growth_->record();
  recorder_.table("growth", record.growth);
  recorder_.table("tips", record.tips);
  recorder_.table("cracks", record.crack_table());
  const auto outcome = growth_->outcome();
  summary.growth =
      post::GrowthSummary{in_words(outcome), outcome.advances, {}, {}, outcome.spent, outcome.largest_speed,
                          outcome.broken,    outcome.lengths};
  for (const auto& some : {warnings_about_spent_energy(*plan_.growth, outcome, plan_.problem.section, remedy()),
                           warnings_about_directions(outcome, remedy()), record.cut_places(plan_.problem)})
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
  if (!contact_forces_.rows.empty()) recorder_.table("impact", contact_forces_);
  const auto& history = recorder_.history();
  if (plan_.moves() && recorder_.plots())
    recorder_.picture("curves",
                      post::to_svg(post::curves_of_motion(plan_.title, times_, factors_.rows(), history, plan_.si())));
  summary.accuracy = accuracy_;
  summary.frequencies = frequencies_;
  post::conclude(summary, {section, plan_.srif, plan_.si(), history, reactions_, factors_.last()});
  if (!growth_)
    post::look_for_largest(summary, section, of_all(plate_.communicator(), extremes_.found()), times_, factors_.rows());
  const auto at_time = [](double time) { return fmt::format("t = {:.4g}", time); };
  const auto crack = [&](std::size_t tip) { return std::size_t(plate_.tips()[tip].crack); };
  for (const auto& some :
       {post::left_out(plate_.tips(), tip_methods_),
        post::warnings_about_factors(summary.srif, factors_.largest(), section.thickness, remedy()),
        factors_.warnings(plan_.analysis.tolerance), post::tips_that_grow(summary),
        post::sinking_supports(summary.reactions, plan_.problem,
                               section.thickness * summary.deflection_over_thickness.value_or(0)),
        post::warnings_about_faces(overlaps, section, growth_ ? std::function<std::size_t(std::size_t)>() : crack,
                                   plan_.moves() ? at_time : std::function<std::string(double)>())})
    summary.warnings.insert(summary.warnings.end(), some.begin(), some.end());
  if (plan_.moves()) summary.overlaps = std::move(overlaps);
  summary = recorder_.finish(std::move(summary), stopwatch);
  write_report(plan_, pictures_);
  return summary;
}

template <typename Archive>
void Results::memory(Archive& archive) {
  archive(factors_, reactions_, extremes_, pictures_, times_, residual_, energy_balance_, strain_energy_,
          external_work_, next_frame_, contact_forces_);
}

void Results::save(plate::OutArchive& archive) {
  recorder_.save(archive);
  const auto own = extremes_.so_far();
  extremes_.so_far(of_all(plate_.communicator(), own));
  memory(archive);
  extremes_.so_far(own);
}

void Results::restore(plate::InArchive& archive) {
  recorder_.restore(archive);
  memory(archive);
}

std::vector<post::Probe> probes_of(const std::map<std::string, geometry::Point>& places,
                                   const plate::Formulation& plate) {
  std::vector<post::Probe> result;
  for (const auto& [name, x] : places)
    result.push_back({name, x, plate.here(x) ? plate.interpolation(x) : std::vector<plate::PlaceShare>{}});
  return result;
}

post::Summary about(const RunPlan& plan, const plate::Formulation& plate, std::vector<std::string> warnings) {
  auto summary = post::about(plate, plan.analysis, {plan.srif.has_value(), plan.fields});
  summary.title = plan.title;
  summary.units = plan.units;
  summary.formulation_reason = plan.formulation_reason;
  summary.warnings = std::move(warnings);
  count_all(summary, plate);
  return summary;
}

plate::NumericalError placed(const plate::NumericalError& error, const plate::Formulation& plate,
                             const post::Summary& summary) {
  std::string said = error.what();
  if (const auto& places = plate.cloud().positions; error.point && *error.point < places.size())
    said += fmt::format("; the point is at ({:g}, {:g})", places[*error.point].x(), places[*error.point].y());
  if (const auto& analysis = summary.analysis; analysis.time_step && analysis.time_step_limit)
    said += fmt::format("; the time step {:g} is {:.3g} of the stable one", *analysis.time_step,
                        *analysis.time_step / *analysis.time_step_limit);
  return plate::NumericalError(said);
}

post::Summary carried_out(post::Summary summary, const plate::Formulation& plate,
                          const std::function<void(post::Summary&)>& solve,
                          const std::function<post::Summary(post::Summary)>& finish) {
  const plate::StopOnSignals signals;
  try {
    solve(summary);
    summary.outcome = "done";
  } catch (const plate::NumericalError& error) {
    const auto failed = placed(error, plate, summary);
    summary.outcome = fmt::format("failed: {}", failed.what());
    summary.analysis.stop_reason = failed.what();
    finish(summary);
    throw failed;
  } catch (const plate::Interrupted& asked) {
    summary.outcome = "interrupted";
    summary.analysis.stop_reason = asked.what();
    finish(summary);
    throw;
  }
  return finish(std::move(summary));
}

void write_report(const RunPlan& plan, const post::Pictures& pictures) {
  if (plan.report && plan.communicator->rank() == 0)
    post::write_report(*plan.report, {plan.problem, plan.title, plan.source, plan.units, plan.probes}, pictures);
}

}  // namespace fracture
