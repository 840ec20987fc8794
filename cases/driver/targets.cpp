#include "cases/driver/targets.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "cases/driver/accuracy.hpp"
#include "cases/driver/prepared.hpp"
#include "cases/driver/recording.hpp"
#include "cases/runs/analyses.hpp"
#include "cases/runs/outputs.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/statics.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/report/accuracy_search.hpp"
#include "post/report/errors_of_results.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

using Share = std::optional<double>;

/// The larger of two errors; absent where one is.
Share larger(const Share& one, const Share& other) {
  return one && other ? Share(std::max(*one, *other)) : std::nullopt;
}

Share share_of(const std::optional<double>& error, double size) {
  if (!error) return std::nullopt;
  return size > 0 ? *error / size : 0;
}

Share of_peak(const std::vector<post::Peak>& peaks, const std::string& quantity) {
  const auto found = std::ranges::find(peaks, quantity, &post::Peak::quantity);
  return found == peaks.end() ? std::nullopt : share_of(found->error, std::abs(found->value));
}

/// Force on the plate in its plane counts as forces along w do.
Share of_reactions(const std::optional<post::ReactionSummary>& reactions,
                   const std::optional<post::MembraneSummary>& membrane) {
  double largest = 0, error = 0;
  bool known = false;
  if (reactions && reactions->errors.size() == reactions->supports.size() && !reactions->errors.empty()) {
    known = true;
    for (const auto& one : reactions->balance.supports) largest = std::max(largest, std::abs(one.force));
    for (const auto& one : reactions->errors) error = std::max(error, std::abs(one.force));
  }
  Share result = known ? share_of(error, largest) : std::nullopt;
  if (!membrane || membrane->reactions.empty()) return result;
  double in_plane = 0, of_them = 0;
  for (const auto& one : membrane->reactions) {
    if (!one.error) return std::nullopt;
    in_plane = std::max(in_plane, one.force.norm()), of_them = std::max(of_them, *one.error);
  }
  return known ? larger(result, share_of(of_them, in_plane)) : share_of(of_them, in_plane);
}

Share of_frequencies(const std::vector<post::Frequency>& all) {
  if (all.empty()) return std::nullopt;
  Share result = 0;
  for (const auto& one : all) result = larger(result, share_of(one.error, one.frequency));
  return result;
}

/// Share that a run, or a load case, has reached of a target.
template <typename Results>
Share of_results(const Results& results, const std::string& target) {
  if (target == "deflection") return of_peak(results.extremes, "w");
  if (target == "stress") return of_peak(results.extremes, "von_mises");
  return of_reactions(results.reactions, results.membrane);
}

}  // namespace

void set_reached(const post::Summary& results, post::TargetsSummary& found) {
  for (auto& [of, asked, reached] : found.targets) {
    if (of == "frequencies") {
      reached = of_frequencies(results.frequencies);
    } else if (results.load_cases.empty()) {
      reached = of_results(results, of);
    } else {
      reached = 0;
      for (const auto& one : results.load_cases) reached = larger(reached, of_results(one, of));
    }
  }
}

post::TargetsSummary targets_of(const AccuracyTargets& asked) {
  post::TargetsSummary result;
  const auto add = [&](const char* of, const std::optional<double>& share) {
    if (share) result.targets.push_back({of, *share});
  };
  add("deflection", asked.deflection), add("stress", asked.stress), add("reactions", asked.reactions);
  add("frequencies", asked.frequencies);
  return result;
}

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A plate on the way, solved.
struct Solved {
  std::unique_ptr<Prepared> plate;
  post::Summary results;  // without errors
};

CaseFile of_size(const CaseFile& file, double size) {
  CaseFile result = file;
  Case& c = result.content;
  c.discretization = post::discretization_for_results(file.content, size);
  c.analysis.tolerance = std::min(c.analysis.tolerance, 1e-8);  // far below the errors that are asked
  return result;
}

/// Keeps the solution of one load on a linear plate, so that the run that is written need not find it again.
void keep_solution(Prepared& ready) {
  const Case& c = ready.file.content;
  const bool simple = c.analysis.kind == Analysis::Kind::static_ && c.load_cases.empty() && !c.analysis.nonlinear &&
                      !c.coupled() && !c.faces_touch() && !ready.membrane;
  if (!simple) return;
  const plate::StaticOptions options{c.analysis.tolerance, c.analysis.max_iterations, {}};
  ready.solution = plate::static_solution(*ready.plate, c.analysis, options);
  ready.stopwatch.lap("solve");
}

Solved solved(const CaseFile& file, double size, const RunOptions& options) {
  auto plate = std::make_unique<Prepared>(of_size(file, size), *options.communicator);
  keep_solution(*plate);
  Case c = plate->file.content;
  c.srif.reset();
  c.output.vtk = c.output.hdf5 = c.output.errors = false, c.output.report = false;
  post::ResultsInMemory unused;
  const RunPlan plan{c, {{}, true, &unused, false, options.communicator}};
  plate::Stopwatch stopwatch = plate->stopwatch;
  Outputs outputs(plan, recording(plan).recorder, stopwatch);
  auto results = run(*plate, outputs);
  return {std::move(plate), std::move(results)};
}

/// Search for the discretisation.
class TargetSearch {
public:
  TargetSearch(const CaseFile& file, const RunOptions& options)
      : file_(file),
        options_(options),
        found_(targets_of(*file.content.accuracy)),
        progress_(options.quiet, "accuracy") {}

  std::unique_ptr<Prepared> run() {
    constexpr double first_sizes = 0.2;
    for (double size = 1; found_.ended_by.empty();) {
      if (const auto why = step(size); !why.empty()) {
        if (found_.path.empty() && size < first_sizes) throw *refused_;
        size /= between;
        if (!found_.path.empty()) found_.ended_by = ++failed_ == most_failures ? why : end_before(size);
        continue;
      }
      failed_ = 0;
      if (found_.path.size() >= least_steps && worst() <= 1) break;
      size = next_size();
      found_.ended_by = end_before(size);
    }
    progress_.done();
    return finished();
  }

private:
  static constexpr double between = 1.4142135623730951;
  static constexpr int most_failures = 3;
  static constexpr std::size_t least_steps = 2;

  std::string end_before(double size) const {
    const auto& last = found_.path.back();
    return post::end_of_search(file_.content, size, {size_, last.points, last.seconds}, seconds_since(start_),
                               file_.content.accuracy->seconds);
  }

  /// The largest ratio of an error to what is asked; infinite where one is not known.
  double worst() const {
    double result = 0;
    for (const auto& one : found_.targets) result = std::max(result, one.reached.value_or(INFINITY) / one.asked);
    return result;
  }

  /// Next size: errors are taken to fall with its power of 1.5, and to 0.8 of what is asked.
  double next_size() const {
    constexpr double order = 1.5, aim = 0.8, least = 0.35, most = 1 / between;
    const double ratio = worst();
    return size_ * (std::isfinite(ratio) ? std::clamp(std::pow(aim / ratio, 1 / order), least, most) : most);
  }

  /// Solves the plate of a size; else why that cannot be had.
  std::string step(double size) {
    const auto begin = Clock::now();
    try {
      auto next = solved(file_, size, options_);
      plate::stop_if_asked("the search for accuracy", next.plate->plate->constraints());
      others_ = compared(next, size);
      if (plate_) before_.add(plate_->stopwatch);
      auto results = next.results;
      for (const auto& other : others_) post::set_errors(results, other, post::sizes_of(next.plate->file.content));
      if (!others_.empty()) set_reached(results, found_);
      plate_ = std::move(next.plate), size_ = size, solved_.push_back({size, std::move(next.results)});
    } catch (const CaseError& error) {
      const auto& first = error.problems().front();
      const bool coarse = first.key == "analysis.modes";  // points have fewer modes than are asked for
      if (!coarse && (first.key.starts_with("analysis.") || first.key.starts_with("output."))) throw;
      if (!refused_) refused_ = error;
      return fmt::format("what forbids the next discretisation: {}", first.what);
    } catch (const plate::NumericalError& error) {
      if (found_.path.empty()) throw;
      return error.what();
    }
    const auto& d = plate_->file.content.discretization;
    found_.path.push_back({.points = solved_.back().results.points,
                           .spacing = d.spacing,
                           .tip_spacing = d.tip_spacing,
                           .hole_spacing = d.hole_spacing,
                           .seconds = seconds_since(begin),
                           .targets = found_.targets});
    const double ratio = worst();
    progress_.update(std::min(0.99, 1 / ratio),
                     fmt::format("{} points, {}", solved_.back().results.points,
                                 std::isfinite(ratio) ? fmt::format("errors up to {:.2g} of what is asked", ratio)
                                                      : "no estimate yet"));
    return "";
  }

  /// Results by which the errors of a plate are estimated: of bonds those of the Galerkin plate, else of the two plates
  /// before, as two alone may agree by chance.
  std::vector<post::OtherResults> compared(const Solved& next, double size) const {
    constexpr double margin = 1.3;  // as of other_results()
    constexpr std::size_t most = 2;
    std::vector<post::OtherResults> result;
    if (next.plate->plate->offers(plate::Feature::horizon)) {
      std::vector<std::string> unused;
      if (auto other = other_results(next.plate->file, options_, unused)) result.push_back(std::move(*other));
      return result;
    }
    for (std::size_t i = solved_.size(); i > 0 && result.size() < most; --i)
      result.push_back({solved_[i - 1].results, margin / (solved_[i - 1].size / size - 1)});
    return result;
  }

  std::unique_ptr<Prepared> finished() {
    auto& plate = *plate_;
    plate.stopwatch.add(before_);
    plate.other_results = std::move(others_);
    if (!found_.ended_by.empty()) {
      std::string text;
      for (const auto& one : found_.targets)
        if (one.reached.value_or(INFINITY) > one.asked)
          text += fmt::format("{}{} to {:.2g} (error {})", text.empty() ? "" : ", ", one.of, one.asked,
                              one.reached ? fmt::format("{:.2g}", *one.reached) : "unknown");
      plate.warnings.push_back(fmt::format("accuracy not reached, of {}: ended by {}", text, found_.ended_by));
    }
    plate.targets = std::move(found_);
    return std::move(plate_);
  }

  const CaseFile& file_;
  const RunOptions& options_;
  post::TargetsSummary found_;
  post::Progress progress_;
  Clock::time_point start_ = Clock::now();
  plate::Stopwatch before_;
  int failed_ = 0;
  double size_ = 1;  // of the last plate
  std::unique_ptr<Prepared> plate_;
  struct Sized {
    double size;
    post::Summary results;  // without errors
  };
  std::vector<Sized> solved_;
  std::vector<post::OtherResults> others_;
  std::optional<CaseError> refused_;  // of the coarsest points
};

}  // namespace

std::unique_ptr<Prepared> to_targets(const CaseFile& file, const RunOptions& options) {
  auto plate = TargetSearch(file, options).run();
  warn_of_given_lengths(file, "[accuracy]", plate->warnings);
  return plate;
}

}  // namespace cases
