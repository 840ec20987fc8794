#include "cases/studies/study.hpp"

#include <fmt/format.h>

#include "cases/driver/run.hpp"
#include "cases/input/keys.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/model/process.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/digest.hpp"
#include "post/files/summary.hpp"

namespace cases {
namespace {

namespace fs = std::filesystem;

/// The unit of a key in SI units; "" without one.
std::string si_unit(const std::string& key) {
  const auto known = std::ranges::find(keys(), key, &Key::name);
  return known == keys().end() ? "" : post::si_unit_of(known->unit);
}

post::StudyTitles titles(const Study& study) {
  post::StudyTitles result{study.title, study.axis_names(), true};
  for (const auto& run : study.runs) result.si = result.si && run.file.content.units == "SI";
  for (std::size_t i = 0; i < study.axes.size(); ++i)
    if (const auto unit = si_unit(study.axes[i].key); result.si && !unit.empty())
      result.axes[i] += fmt::format(" [{}]", unit);
  return result;
}

post::Ended run_once(const CaseFile& file, const fs::path& folder) {
  try {
    run(file, {folder, true});
    return {"done"};
  } catch (const CaseError& error) {
    return {"refused", error.what()};
  } catch (const plate::NumericalError& error) {
    return {"failed", error.what()};
  } catch (const plate::Interrupted& asked) {
    return {"interrupted", asked.what()};
  }
}

/// The version and the time of this very program: another build of it may find other numbers.
std::string program() {
  return fmt::format("{} of {}", PDPLATE_VERSION, plate::build());
}

post::RunRecord wanted_record(const StudyRun& run) {
  return {run.folder, post::digest(resolved_toml(run.file.content)), program(), "done"};
}

}  // namespace

std::vector<std::string> StudyPlan::axis_names() const {
  std::vector<std::string> names;
  for (const auto& axis : axes) names.push_back(axis.name);
  return names;
}

post::StudyRow bare_row(const StudyRun& run) {
  post::StudyRow row;
  row.labels = run.labels;
  row.spacing = run.file.content.discretization.spacing;
  row.horizon = run.file.content.discretization.horizon();
  return row;
}

StudyOutcome run_study(const Study& study, const StudyOptions& options) {
  post::StudyJobs work{titles(study), study.axis_names(), {}, study.repeats};
  for (const auto& run : study.runs) {
    const auto& c = run.file.content;
    work.jobs.push_back({wanted_record(run), bare_row(run), run.wanted,
                         post::weight(geometry::area(c.outline), c.discretization.spacing),
                         [&] { return run_once(run.file, options.folder / run.folder); }});
  }
  try {
    return post::run_study(work, options);
  } catch (const post::StudyRefused& refused) {
    throw CaseError({{refused.option, refused.value, refused.what()}});
  }
}

}  // namespace cases
