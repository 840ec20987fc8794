#include "cases/driver/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>

#include "cases/driver/run.hpp"
#include "fracture/growth/motion/moving_growth.hpp"
#include "fracture/growth/words.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/earlier.hpp"
#include "post/files/gate.hpp"
#include "post/files/sinks/folder.hpp"
#include "post/files/sinks/kept_sink.hpp"
#include "post/report/conclusion.hpp"
#include "post/report/curves.hpp"
#include "post/report/html/report.hpp"

namespace cases {

std::vector<post::Probe> probes_of(const Case& c, const plate::Formulation& plate) {
  std::vector<post::Probe> result;
  for (const auto& [name, x] : c.output.probes) result.push_back({name, x, plate.interpolation(x)});
  return result;
}

RunOptions RunOptions::part(const std::string& name) const {
  if (kept) kept->parts[name].wants_fields = kept->wants_fields;
  return {folder / name, quiet, kept ? &kept->parts[name] : nullptr};
}

void check_folder(const std::filesystem::path& folder) {
  constexpr std::size_t most = 3;
  auto found = post::strangers(folder);
  if (found.empty()) return;
  if (found.size() > most) found.resize(most), found.back() = "...";
  throw CaseError(
      {{"--out", folder.string(),
        fmt::format("holds {}, but no results of a run: choose another folder, or empty it", fmt::join(found, ", "))}});
}

post::Recorder recorder_of(const Case& c, const RunOptions& options) {
  auto resolved = resolved_toml(c);
  if (options.kept) {
    options.kept->resolved = resolved;
    options.kept->wants_fields = options.kept->wants_fields && (c.output.vtk || c.output.hdf5);
    return {std::make_unique<post::KeptSink>(*options.kept), std::move(resolved), PDPLATE_VERSION};
  }
  const auto& folder = options.folder;
  const auto removed = post::remove_earlier(folder);
  if (removed > 0 && !options.quiet)
    fmt::print(stderr, "{}: removed {} files of an earlier run\n", folder.string(), removed);
  auto sink = std::make_unique<post::Folder>(post::FolderOptions{
      folder, resolved, PDPLATE_VERSION, c.output.vtk, c.output.hdf5, c.analysis.kind == Analysis::Kind::dynamic});
  return {std::move(sink), std::move(resolved), PDPLATE_VERSION};
}

std::optional<std::filesystem::path> report_folder(const Case& c, const RunOptions& options) {
  if (options.kept || !c.output.reports()) return std::nullopt;
  return options.folder;
}

void write_report(const Case& c, const std::filesystem::path& folder, const post::Pictures& pictures) {
  post::write_report(folder, {c, c.title, c.source, c.units, c.output.probes}, pictures);
}

Results::Results(const CaseFile& file, const plate::Formulation& plate, const std::vector<post::TipMethods>& methods,
                 const RunOptions& options)
    : case_(file.content),
      plate_(plate),
      tip_methods_(methods),
      recorder_(recorder_of(case_, options)),
      report_(report_folder(case_, options)),
      probes_(probes_of(case_, plate)),
      factors_(case_.section.thickness),
      reactions_(plate, case_.analysis.rotary_inertia, case_.analysis.method == Analysis::Method::lanczos),
      extremes_(plate) {
  if (!recorder_.draws() && !recorder_.stores()) return;
  const auto mesh = recorder_.draws() || report_ ? plate.mesh() : post::points_of(plate);
  if (report_) pictures_.open(mesh);
  recorder_.open(mesh);
}

void Results::sample(const plate::Instant& now, bool last) {
  strain_energy_ = now.strain_energy;
  post::Sample row{now.time, now.step, now.state, now.strain_energy, now.kinetic_energy, now.external_work, 0};
  row.discrete_energy = now.strain_energy + now.discrete_energy;
  if (growth_) {
    row.fracture_energy = growth_->fracture_energy();
    row.energy_residual = residual_ =
        now.external_work - now.strain_energy - now.kinetic_energy - row.fracture_energy - growth_->frozen_energy();
    growth_->look(now.time);
  }
  recorder_.row(row, probes_, plate_.cloud().plate_points);
  reactions_.add(now, growth_ ? growth_->plate() : plate_);
  if (!growth_) extremes_.row(now);
  times_.push_back(now.time);
  const auto factors = [&]() -> std::vector<post::Srif> {
    if (growth_) return growth_->factors(now.state);
    if (!case_.srif || factors_.known()) return {};
    return post::srifs(plate_, *case_.srif, tip_methods_, now.state, last);
  };
  factors_.add(factors(), fmt::format("at step {}, time {:g}", now.step, now.time));
}

void Results::frame(const plate::Instant& now) {
  if (!recorder_.draws() && !recorder_.stores()) return;
  auto frame = post::frame_of(plate_, now.time, now.step, now.state, recorder_.draws() && !growth_);
  std::optional<plate::Mesh> mesh;
  if (growth_ && recorder_.draws()) mesh = growth_->draw(frame, now.state, factors_.last());
  if (report_) {
    if (mesh) pictures_.open(*mesh);
    pictures_.look(frame);
  }
  if (frame.resultants.von_mises.size() > 0 && !growth_) extremes_.frame(now.time, frame.resultants);
  plate::State velocity;
  if (recorder_.stores() && case_.analysis.kind == Analysis::Kind::dynamic)
    velocity = now.velocity().leftCols(Eigen::Index(plate_.cloud().plate_points));
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

post::Summary Results::finish(post::Summary summary, plate::Stopwatch& stopwatch) {
  if (!tip_methods_.empty()) recorder_.table("srif", factors_.table(times_));
  auto cracks = post::given_cracks(plate_.paths());
  if (growth_) {
    const auto& record = growth_->record();
    recorder_.table("growth", record.growth);
    recorder_.table("tips", record.tips);
    recorder_.table("cracks", record.crack_table());
    cracks = record.cracks;
    const auto moved = growth_->moved();
    summary.growth = post::GrowthSummary{fracture::in_words(moved), moved.advances, {},           {}, moved.spent,
                                         moved.largest_speed,       moved.broken,   moved.lengths};
    summary.energy.emplace_back("fracture", growth_->fracture_energy());
    if (growth_->frozen_energy() > 0) summary.energy.emplace_back("frozen", growth_->frozen_energy());
    if (residual_) summary.energy.emplace_back("residual", *residual_);
  }
  if (growth_ || !cracks.lines.empty()) recorder_.cracks(cracks, factors_.last());
  if (!reactions_.empty()) recorder_.table("reactions", reactions_.table());
  const bool moves = case_.analysis.kind == Analysis::Kind::dynamic, si = case_.units == "SI";
  const auto& history = recorder_.history();
  if (moves && recorder_.plots())
    recorder_.picture("curves",
                      post::to_svg(post::curves_of_motion(case_.title, times_, factors_.rows(), history, si)));
  summary.accuracy = accuracy_;
  summary.frequencies = frequencies_;
  post::conclude(summary, {case_.section, case_.srif, si, history, reactions_, factors_.last()});
  if (!growth_) post::look_for_largest(summary, case_.section, extremes_, times_, factors_.rows());
  for (const auto& some :
       {post::left_out(plate_.tips(), tip_methods_),
        post::distrust_of_factors(summary.srif, factors_.largest(), case_.section.thickness, plate_.remedy()),
        factors_.distrust(), post::tips_that_grow(summary)})
    summary.warnings.insert(summary.warnings.end(), some.begin(), some.end());
  summary = recorder_.finish(std::move(summary), stopwatch);
  if (report_) write_report(case_, *report_, pictures_);
  return summary;
}

}  // namespace cases
