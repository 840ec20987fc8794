#include "cases/studies/extremes.hpp"

#include <array>
#include <map>
#include <set>

#include "cases/driver/prepared.hpp"
#include "cases/driver/run.hpp"
#include "cases/studies/study_table.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "post/report/html_report.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

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

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Every row has a name of its own and an oracle; what it should equal stands before it. Keys, and what is wrong.
std::vector<std::pair<std::string, std::string>> errors(const std::vector<ExtremeRow>& rows) {
  std::vector<std::pair<std::string, std::string>> found;
  std::set<std::string> before;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    const std::string key = fmt::format("row[{}]", i);
    const bool ends = row.value || row.equal || row.conserved || !row.warned.empty();
    const int oracles = ends + !row.refused.empty() + !row.failed.empty();
    if (oracles == 0) found.emplace_back(key, "has no oracle: value, equal, conserved, refused, failed or warned");
    if (oracles > 1) found.emplace_back(key, "cannot be refused, fail and give a result at once");
    if (row.equal && !row.equal->row.empty() && !before.contains(row.equal->row))
      found.emplace_back(key + ".equal.row",
                         fmt::format("no row \"{}\" before this one{}", row.equal->row,
                                     plate::did_you_mean(row.equal->row, {before.begin(), before.end()})));
    if (!row.title.empty() && !before.insert(row.title).second)
      found.emplace_back(key + ".title", fmt::format("\"{}\" is given twice", row.title));
  }
  if (rows.empty()) found.emplace_back("row", "is missing, must be [[row]]");
  return found;
}

}  // namespace

Extremes read_extremes(const std::filesystem::path& path) {
  const toml::table root = parsed(path, "extremes");
  Reading reading(path.string());
  Extremes extremes;
  extremes.title = path.stem().string();
  read_fields(extremes_fields(), Value(root, "", reading), extremes);
  for (const auto& [key, what] : errors(extremes.rows))
    if (reading.sound(key)) reading.report_error(key, what);
  if (!reading.problems().empty()) throw CaseError(reading.problems());
  return extremes;
}

namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

/// Outcome of a row.
struct ExtremeRun {
  fs::path folder;
  std::optional<post::Summary> summary;  // of a run that ended well
  std::string refused, failed;           // messages
  double seconds = 0;
};

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
    file.content.output.errors = false;
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

/// The titles of the rows whose group or title contains this, and of those that they should equal.
std::set<std::string> chosen_rows(const std::vector<ExtremeRow>& rows, const std::string& only) {
  std::set<std::string> result;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    if (!contains(row->group, only) && !contains(row->title, only) && !result.contains(row->title)) continue;
    result.insert(row->title);
    if (row->equal) result.insert(row->equal->row);
  }
  return result;
}

std::string shown(const std::optional<double>& x) {
  return x ? fmt::format("{:.8g}", *x) : "no number";
}

std::optional<double> relative(const std::optional<double>& computed, const std::optional<double>& expected) {
  if (!computed || !expected) return std::nullopt;
  return std::abs(*computed - *expected) / (*expected == 0 ? 1 : std::abs(*expected));
}

std::optional<double> value_in_run(const post::Quantity& quantity, const ExtremeRun& run) {
  return run.summary ? post::value(quantity, *run.summary, run.folder) : std::nullopt;
}

std::string named(const post::Quantity& quantity) {
  return quantity.name + (quantity.place().empty() ? "" : " at " + quantity.place());
}

/// (largest - smallest) / mean of the discrete energy after a time; nothing with less than two rows.
std::optional<double> drift(const ExtremeRun& run, double after) {
  const auto table = post::read_csv(run.folder / "history.csv");
  double low = INFINITY, high = -INFINITY, sum = 0;
  int count = 0;
  for (const auto& row : table.rows) {
    const double* time = std::get_if<double>(&row[table.column("time")]);
    const double* energy = std::get_if<double>(&row[table.column("discrete_energy")]);
    if (!time || *time <= after) continue;
    if (!energy || !std::isfinite(*energy)) return std::nullopt;
    low = std::min(low, *energy), high = std::max(high, *energy), sum += *energy, ++count;
  }
  if (count < 2) return std::nullopt;
  return (high - low) / std::abs(sum / count);
}

/// Holds what a run came to against its oracles. `before`: the runs that it may have to equal, by their titles.
std::vector<Verdict> verdicts(const ExtremeRow& row, const ExtremeRun& run,
                              const std::map<std::string, ExtremeRun>& before) {
  std::vector<Verdict> result;
  const auto& summary = run.summary;
  const auto add = [&](const std::string& oracle, const std::string& computed, const std::string& expected,
                       std::optional<double> deviation = {}, std::optional<double> allowed = {}) -> Verdict& {
    const bool holds = deviation && allowed && *deviation <= *allowed;
    result.push_back({row.group, row.title, oracle, computed, expected, deviation, allowed, holds, run.seconds});
    if (!summary) {
      result.back().message = run.refused + run.failed;
      result.back().computed = run.refused.empty() ? "failed" : "refused";
    }
    return result.back();
  };
  const auto number = [&](const post::Quantity& quantity, const std::optional<double>& expected, double tolerance,
                          const std::string& source) {
    const auto computed = value_in_run(quantity, run);
    add(named(quantity), shown(computed), fmt::format("{} ({})", shown(expected), source), relative(computed, expected),
        tolerance);
  };
  if (row.value) number(row.value->quantity, row.value->is, row.value->tolerance, row.value->source);
  if (const auto& equal = row.equal) {
    const auto other = value_in_run(equal->quantity, before.at(equal->row));
    const std::string times = equal->factor == 1 ? "" : fmt::format("{:g} x ", equal->factor);
    number(equal->quantity, other ? std::optional(equal->factor * *other) : std::nullopt, equal->tolerance,
           fmt::format("{}\"{}\"", times, equal->row));
  }
  if (row.conserved) {
    const auto drifted = summary ? drift(run, row.conserved->after) : std::nullopt;
    const auto steps = summary ? summary->analysis.steps : std::nullopt;
    add("energy", fmt::format("drift {:.1e} in {} steps", drifted.value_or(NAN), steps.value_or(0)),
        "conserved by central differences", drifted, row.conserved->tolerance);
  }
  if (!row.warned.empty()) {
    auto& verdict = add("warned", "no such warning", "\"" + row.warned + "\"");
    for (const auto& text : summary ? summary->warnings : std::vector<std::string>())
      if (contains(text, row.warned)) verdict.holds = true, verdict.computed = "warned", verdict.message = text;
    if (summary && !verdict.holds) verdict.message = fmt::format("{}", fmt::join(summary->warnings, "; "));
  }
  for (const auto& [oracle, code, said, wanted] : {std::array{"refused"s, "exit code 2"s, run.refused, row.refused},
                                                   {"failed"s, "exit code 3"s, run.failed, row.failed}}) {
    if (wanted.empty()) continue;
    auto& verdict = add(oracle, "", fmt::format("{}, \"{}\"", code, wanted));
    verdict.holds = contains(said, wanted);
    if (summary) verdict.computed = "done";
  }
  return result;
}

/// The rows of extremes.csv.
post::Table table(const std::vector<Verdict>& verdicts) {
  post::Table result{
      {"group", "row", "oracle", "computed", "expected", "deviation", "allowed", "holds", "seconds", "message"}, {}};
  for (const auto& v : verdicts)
    result.rows.push_back({v.group, v.row, v.oracle, v.computed, v.expected, post::cell(v.deviation),
                           post::cell(v.allowed), std::string(v.holds ? "yes" : "no"), v.seconds,
                           post::one_line(v.message)});
  return result;
}

}  // namespace

std::vector<Verdict> run_extremes(const Extremes& extremes, const ExtremeOptions& options) {
  const auto wanted = chosen_rows(extremes.rows, options.only);
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

std::string to_text(const std::vector<Verdict>& verdicts) {
  using Text = std::function<std::string(const Verdict&)>;
  std::vector<post::TextColumn> columns;
  const auto add = [&](const std::string& title, bool number, const Text& text) {
    columns.push_back({title, number});
    for (const auto& verdict : verdicts) columns.back().cells.push_back(text(verdict));
  };
  const auto ratio = [](const std::optional<double>& x) { return x ? fmt::format("{:.1e}", *x) : std::string(); };
  add("group", false, [](const Verdict& v) { return v.group; });
  add("row", false, [](const Verdict& v) { return v.row; });
  add("oracle", false, [](const Verdict& v) { return v.oracle; });
  add("computed", false, [](const Verdict& v) { return v.computed; });
  add("expected", false, [](const Verdict& v) { return v.expected; });
  add("deviation", true, [&](const Verdict& v) { return ratio(v.deviation); });
  add("allowed", true, [&](const Verdict& v) { return ratio(v.allowed); });
  add("", false, [](const Verdict& v) { return v.holds ? "holds" : "MISSED"; });
  add("s", true, [](const Verdict& v) { return fmt::format("{:.1f}", v.seconds); });
  add("", false, [](const Verdict& v) { return post::one_line(v.message); });
  return post::aligned(columns);
}

}  // namespace cases
