#include "cases/driver/accuracy.hpp"
#include <fmt/format.h>
#include "cases/driver/prepared.hpp"
#include "fracture/runs/trial.hpp"
#include "post/report/progress.hpp"
#include "post/studies/accuracy/path.hpp"
#include "post/studies/accuracy/search.hpp"

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

void warn_of_given_lengths(const CaseFile& file, std::vector<std::string>& warnings) {
  std::string given;
  for (const char* name : {"spacing", "tip_spacing", "hole_spacing", "spacing_growth"})
    for (const auto& [key, where] : file.source.places)
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
          auto trial = fracture::trial(*next, next->file.content.analysis, *next->file.content.srif);
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
