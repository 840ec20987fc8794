#include "cases/driver/accuracy.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/driver/lanczos.hpp"
#include "cases/driver/prepared.hpp"
#include "cases/driver/static_solution.hpp"
#include "cases/input/case_file.hpp"
#include "plate/model/numerical_error.hpp"
#include "post/factors/accuracy_path.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/gate.hpp"
#include "post/report/progress.hpp"
#include "post/studies/accuracy_search.hpp"

namespace cases {
namespace {

CaseFile with_size(const CaseFile& file, double size) {
  CaseFile result = file;
  Case& c = result.content;
  c.discretization = post::discretization_of(file.content, c.analysis.kind == Analysis::Kind::dynamic, size);
  // static factors are to be known far better than by the default tolerance; in motion they are watched themselves
  if (c.analysis.kind == Analysis::Kind::static_) c.analysis.tolerance = std::min(c.analysis.tolerance, 1e-8);
  c.srif->first_ring_only = true;  // errors come from the path
  return result;
}

post::AccuracyTrial in_statics(Prepared& plate) {
  const Case& c = plate.file.content;
  plate.solution = static_solution(c, *plate.plate, {c.analysis.tolerance, c.analysis.max_iterations, {}});
  const auto& solution = plate.solution->solution;
  if (!solution.converged)
    throw plate::NumericalError(fmt::format("on the way to srif.accuracy, {} points: {}, residual {:.2e}",
                                            plate.plate->points(), solution.stop_reason, solution.residual));
  plate.stopwatch.lap("solve");
  post::AccuracyTrial result{plate.plate.get(),
                             {post::srifs(*plate.plate, *c.srif, plate.tip_methods, solution.state)},
                             {},
                             plate.plate->strain_energy(solution.state),
                             0};
  plate.stopwatch.lap("srif");
  return result;
}

post::AccuracyTrial in_motion(Prepared& plate) {
  constexpr double of_truncation = 0.3;  // of the accuracy
  const Case& c = plate.file.content;
  plate.motion.emplace(lanczos_motion(c, *plate.plate, plate.tip_methods, of_truncation * *c.srif->accuracy, {}));
  post::AccuracyTrial result{plate.plate.get(), {}, plate.motion->truncated(), 0, plate.motion->vectors()};
  plate.motion->observe(plate.steps->grid.steps, [&](const plate::Instant& now) {
    plate.stopwatch.lap("solve");
    result.rows.push_back(post::srifs(*plate.plate, *c.srif, plate.tip_methods, now.state, false));
    result.strain_energy = std::max(result.strain_energy, now.strain_energy);
    plate.stopwatch.lap("srif");
  });
  return result;
}

post::AccuracyTrial solve(Prepared& plate) {
  const bool moves = plate.file.content.analysis.kind == Analysis::Kind::dynamic;
  post::AccuracyTrial result = moves ? in_motion(plate) : in_statics(plate);
  for (const auto& row : result.rows) post::require_finite(row, "on the way to srif.accuracy");
  return result;
}

void warn_of_given_lengths(const CaseFile& file, std::vector<std::string>& warnings) {
  std::string given;
  for (const char* name : {"spacing", "tip_spacing", "hole_spacing", "spacing_growth"})
    for (const auto& [key, where] : file.places)
      if (key == fmt::format("discretization.{}", name)) given += (given.empty() ? "" : ", ") + std::string(name);
  if (!given.empty())
    warnings.push_back(
        fmt::format("srif.accuracy finds the lengths of the discretisation: {} of the case not used", given));
}

}  // namespace

Accurate to_accuracy(const CaseFile& file, bool quiet) {
  const auto& options = *file.content.srif;
  Accurate result;
  auto& plate = result.plate;
  plate::Stopwatch before;
  std::optional<CaseError> refused;  // the coarsest points
  post::Progress progress(quiet, "srif.accuracy");
  auto found = post::refine(
      options,
      [&](double size) -> std::variant<post::AccuracyTrial, post::Unfit> {
        try {
          auto next = std::make_unique<Prepared>(with_size(file, size));
          auto trial = solve(*next);
          if (plate) before.add(plate->stopwatch);
          plate = std::move(next);
          return trial;
        } catch (const CaseError& error) {
          const auto& first = error.problems().front();
          const auto& key = first.key;
          if (key == "srif.accuracy" || key.starts_with("analysis.") || key.starts_with("output.")) throw;
          if (!refused) refused = error;
          return post::Unfit{first.what};
        }
      },
      progress);
  progress.done();
  if (found.summary.path.empty()) throw *refused;
  plate->stopwatch.add(before);
  for (auto& warning : post::distrust_of(found.summary)) plate->warnings.push_back(std::move(warning));
  warn_of_given_lengths(file, plate->warnings);
  result.found = found.summary;
  std::optional<std::vector<double>> truncated;
  if (plate->motion) truncated = plate->motion->truncated();
  result.rows = post::rows_of(std::move(found), truncated, options, file.content.section.thickness);
  return result;
}

}  // namespace cases
