#include "cases/studies/extremes.hpp"

#include <set>

#include "cases/driver/prepared.hpp"
#include "cases/driver/run.hpp"
#include "cases/studies/study_table.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/files/table.hpp"
#include "post/report/html_report.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

template <class T>
Fields<T> joined(Fields<T> fields, Fields<T> more) {
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

template <class T>
Field<T> tolerance() {
  return number<T>("tolerance", "-", &T::tolerance, positive, "").required();
}

Fields<Extremes> extremes_fields() {
  const auto value =
      joined<KnownValue>(quantity_fields<KnownValue>(),
                         {number<KnownValue>("is", "", &KnownValue::is, finite, "").required(), tolerance<KnownValue>(),
                          word<KnownValue>("source", &KnownValue::source).required()});
  const auto equal =
      joined<EqualValue>(quantity_fields<EqualValue>(),
                         {word<EqualValue>("row", &EqualValue::row).required(),
                          number<EqualValue>("factor", "-", &EqualValue::factor, finite, ""), tolerance<EqualValue>()});
  const Fields<ConservedEnergy> conserved{number<ConservedEnergy>("after", "time", &ConservedEnergy::after, {0}, ""),
                                          tolerance<ConservedEnergy>()};
  const Fields<ExtremeRow> row{
      word<ExtremeRow>("group", &ExtremeRow::group).required(),
      word<ExtremeRow>("title", &ExtremeRow::title).required(),
      case_file<ExtremeRow>().required(),
      settings<ExtremeRow>(),
      number<ExtremeRow>("time_step_share", "-", &ExtremeRow::time_step_share, positive, ""),
      table<ExtremeRow, KnownValue>("value", Layout::inline_, &ExtremeRow::value, value),
      table<ExtremeRow, EqualValue>("equal", Layout::inline_, &ExtremeRow::equal, equal),
      table<ExtremeRow, ConservedEnergy>("conserved", Layout::inline_, &ExtremeRow::conserved, conserved),
      word<ExtremeRow>("refused", &ExtremeRow::refused),
      word<ExtremeRow>("failed", &ExtremeRow::failed),
      word<ExtremeRow>("warned", &ExtremeRow::warned)};
  return {word<Extremes>("title", &Extremes::title), settings<Extremes>(),
          tables<Extremes, ExtremeRow>("row", Layout::block, &Extremes::rows, row)};
}

}  // namespace

Extremes read_extremes(const std::filesystem::path& path) {
  const toml::table root = parsed(path, "extremes");
  Reading reading(path.string());
  Extremes extremes;
  extremes.title = path.stem().string();
  read_fields(extremes_fields(), Value(root, "", reading), extremes);
  for (const auto& [key, what] : errors({extremes.rows.begin(), extremes.rows.end()}))
    if (reading.sound(key)) reading.report_error(key, what);
  if (!reading.problems().empty()) throw CaseError(reading.problems());
  return extremes;
}

namespace {

namespace fs = std::filesystem;

/// The time step that is a share of the limit which the program finds for this plate.
void set_time_step(CaseFile& file, double share) {
  const auto found = discretised(file);
  const auto& plate = *found.plate;
  file.content.analysis.time_step =
      share * plate::stable_time_step(plate, plate.constraints(), plate.mass(file.content.analysis.rotary_inertia));
}

ExtremeRun run_row(const Extremes& extremes, const ExtremeRow& row, const ExtremeOptions& options,
                   const fs::path& folder) {
  std::vector<std::string> overrides;
  for (const auto& setting : extremes.set) overrides.push_back(setting.text);
  overrides.insert(overrides.end(), options.set.begin(), options.set.end());
  for (const auto& setting : row.set) overrides.push_back(setting.text);
  ExtremeRun result;
  result.folder = folder;
  plate::Stopwatch stopwatch;
  try {
    auto file = read_case(*row.case_file, overrides);
    if (row.time_step_share) set_time_step(file, *row.time_step_share);
    result.summary = run(file, {folder, true});
  } catch (const CaseError& error) {
    result.refused = error.what();
  } catch (const plate::NumericalError& error) {
    result.failed = error.what();
  }
  stopwatch.lap("row");
  result.seconds = stopwatch.total();
  return result;
}

}  // namespace

std::vector<Verdict> run_extremes(const Extremes& extremes, const ExtremeOptions& options) {
  const auto wanted = chosen_rows({extremes.rows.begin(), extremes.rows.end()}, options.only);
  fs::create_directories(options.folder);
  std::vector<Verdict> verdicts;
  std::map<std::string, ExtremeRun> runs;
  std::set<std::string> taken{"extremes.csv"};
  for (const auto& row : extremes.rows) {
    const std::string name = folder_name({row.title}, taken);
    taken.insert(name);
    if (!wanted.contains(row.title)) continue;
    const auto& run = runs[row.title] = run_row(extremes, row, options, options.folder / name);
    const auto found = cases::verdicts(row, run, runs);
    verdicts.insert(verdicts.end(), found.begin(), found.end());
    post::write_csv(options.folder / "extremes.csv", table(verdicts));
    if (!options.quiet)
      post::say(fmt::format("[{}/{}] {}: {}, {:.1f} s\n", runs.size(), wanted.size(), row.title,
                            std::ranges::all_of(found, &Verdict::holds) ? "holds" : "MISSED", run.seconds));
  }
  if (!verdicts.empty()) post::write_extremes_report(options.folder, extremes.title);
  return verdicts;
}

}  // namespace cases
