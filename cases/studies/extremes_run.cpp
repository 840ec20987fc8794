#include <set>

#include "cases/driver/discretised.hpp"
#include "cases/studies/extremes.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/figures/aligned.hpp"

namespace cases {
namespace {

namespace fs = std::filesystem;

/// What a row's run came to.
struct Run {
  fs::path folder;
  std::optional<post::Summary> summary;  // of a run that ended well
  std::string refused, failed;           // messages
  double seconds = 0;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The time step that is a share of the limit which the program finds for this plate.
void set_time_step(CaseFile& file, double share) {
  const auto found = discretised(file);
  const auto& plate = *found.plate;
  file.content.analysis.time_step =
      share * plate::stable_time_step(plate, plate.constraints(), plate.mass(file.content.analysis.rotary_inertia));
}

Run run_row(const Extremes& extremes, const ExtremeRow& row, const ExtremeOptions& options, const fs::path& folder) {
  std::vector<std::string> overrides;
  for (const auto& setting : extremes.set) overrides.push_back(setting.text);
  overrides.insert(overrides.end(), options.set.begin(), options.set.end());
  for (const auto& setting : row.set) overrides.push_back(setting.text);
  Run result;
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

std::string shown(const std::optional<double>& x) {
  return x ? fmt::format("{:.8g}", *x) : "no number";
}

std::optional<double> relative(const std::optional<double>& computed, const std::optional<double>& expected) {
  if (!computed || !expected) return std::nullopt;
  return std::abs(*computed - *expected) / (*expected == 0 ? 1 : std::abs(*expected));
}

std::optional<double> value(const post::Quantity& quantity, const Run& run) {
  return run.summary ? post::value(quantity, *run.summary, run.folder) : std::nullopt;
}

std::string named(const post::Quantity& quantity) {
  return quantity.name + (quantity.place().empty() ? "" : " at " + quantity.place());
}

/// (largest - smallest) / mean of the discrete energy after a time; nothing with less than two rows.
std::optional<double> drift(const Run& run, double after) {
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

/// Holds what a run came to against the oracles of its row.
class Judge {
public:
  Judge(const ExtremeRow& row, const Run& run, const std::map<std::string, Run>& before)
      : row_(row), run_(run), before_(before) {}

  std::vector<Verdict> verdicts() {
    if (row_.value) number(row_.value->quantity, row_.value->is, row_.value->tolerance, row_.value->source);
    if (row_.equal) {
      const auto& equal = *row_.equal;
      const auto other = value(equal.quantity, before_.at(equal.row));
      const std::string times = equal.factor == 1 ? "" : fmt::format("{:g} x ", equal.factor);
      number(equal.quantity, other ? std::optional(equal.factor * *other) : std::nullopt, equal.tolerance,
             fmt::format("{}\"{}\"", times, equal.row));
    }
    if (row_.conserved) {
      const auto drifted = run_.summary ? drift(run_, row_.conserved->after) : std::nullopt;
      const auto steps = run_.summary ? run_.summary->analysis.steps : std::nullopt;
      add("energy", fmt::format("drift {:.1e} in {} steps", drifted.value_or(NAN), steps.value_or(0)),
          "conserved by central differences", drifted, row_.conserved->tolerance);
    }
    if (!row_.warned.empty()) warning();
    if (!row_.refused.empty()) message("refused", "exit code 2", run_.refused, row_.refused);
    if (!row_.failed.empty()) message("failed", "exit code 3", run_.failed, row_.failed);
    return verdicts_;
  }

private:
  Verdict& add(const std::string& oracle, const std::string& computed, const std::string& expected,
               std::optional<double> deviation, std::optional<double> allowed) {
    verdicts_.push_back({row_.group, row_.title, oracle, computed, expected, deviation, allowed});
    auto& verdict = verdicts_.back();
    verdict.holds = deviation && allowed && *deviation <= *allowed;
    verdict.seconds = run_.seconds;
    if (!run_.summary) {
      verdict.message = run_.refused + run_.failed;
      verdict.computed = run_.refused.empty() ? "failed" : "refused";
    }
    return verdict;
  }

  void number(const post::Quantity& quantity, const std::optional<double>& expected, double tolerance,
              const std::string& source) {
    const auto computed = value(quantity, run_);
    add(named(quantity), shown(computed), fmt::format("{} ({})", shown(expected), source), relative(computed, expected),
        tolerance);
  }

  void warning() {
    Verdict& verdict = add("warned", "no such warning", "\"" + row_.warned + "\"", {}, {});
    if (!run_.summary) return;
    for (const auto& text : run_.summary->warnings)
      if (contains(text, row_.warned)) verdict.holds = true, verdict.computed = "warned", verdict.message = text;
    if (!verdict.holds) verdict.message = fmt::format("{}", fmt::join(run_.summary->warnings, "; "));
  }

  void message(const std::string& oracle, const std::string& code, const std::string& said, const std::string& wanted) {
    Verdict& verdict = add(oracle, "", fmt::format("{}, \"{}\"", code, wanted), {}, {});
    verdict.holds = contains(said, wanted);
    if (run_.summary) verdict.computed = "done";
  }

  const ExtremeRow& row_;
  const Run& run_;
  const std::map<std::string, Run>& before_;
  std::vector<Verdict> verdicts_;
};

post::Table table(const std::vector<Verdict>& verdicts) {
  const auto cell = [](const std::optional<double>& x) { return x ? post::Cell(*x) : post::Cell(); };
  post::Table result{
      {"group", "row", "oracle", "computed", "expected", "deviation", "allowed", "holds", "seconds", "message"}, {}};
  for (const auto& v : verdicts)
    result.rows.push_back({v.group, v.row, v.oracle, v.computed, v.expected, cell(v.deviation), cell(v.allowed),
                           std::string(v.holds ? "yes" : "no"), v.seconds, post::one_line(v.message)});
  return result;
}

/// The titles of the rows that are wanted, and of those that they should equal.
std::set<std::string> chosen(const Extremes& extremes, const std::string& only) {
  std::set<std::string> result;
  for (auto row = extremes.rows.rbegin(); row != extremes.rows.rend(); ++row) {
    if (!contains(row->group, only) && !contains(row->title, only) && !result.contains(row->title)) continue;
    result.insert(row->title);
    if (row->equal) result.insert(row->equal->row);
  }
  return result;
}

}  // namespace

std::vector<Verdict> run_extremes(const Extremes& extremes, const ExtremeOptions& options) {
  const auto wanted = chosen(extremes, options.only);
  fs::create_directories(options.folder);
  std::vector<Verdict> verdicts;
  std::map<std::string, Run> runs;
  std::set<std::string> taken{"extremes.csv"};
  for (const auto& row : extremes.rows) {
    const std::string name = post::folder_name({row.title}, taken);
    taken.insert(name);
    if (!wanted.contains(row.title)) continue;
    const auto& run = runs[row.title] = run_row(extremes, row, options, options.folder / name);
    const auto found = Judge(row, run, runs).verdicts();
    verdicts.insert(verdicts.end(), found.begin(), found.end());
    post::write_csv(options.folder / "extremes.csv", table(verdicts));
    if (!options.quiet)
      fmt::print(stderr, "[{}/{}] {}: {}, {:.1f} s\n", runs.size(), wanted.size(), row.title,
                 std::ranges::all_of(found, &Verdict::holds) ? "holds" : "MISSED", run.seconds);
  }
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
