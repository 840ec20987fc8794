#include "cases/studies/oracles.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <functional>

#include "plate/model/wording.hpp"
#include "post/files/table.hpp"

namespace cases {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
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

/// Holds what a run came to against the oracles of its row.
class Judge {
public:
  Judge(const Oracles& row, const ExtremeRun& run, const std::map<std::string, ExtremeRun>& before)
      : row_(row), run_(run), before_(before) {}

  std::vector<Verdict> verdicts() {
    if (row_.value) number(row_.value->quantity, row_.value->is, row_.value->tolerance, row_.value->source);
    if (row_.equal) {
      const auto& equal = *row_.equal;
      const auto other = value_in_run(equal.quantity, before_.at(equal.row));
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
    const auto computed = value_in_run(quantity, run_);
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

  const Oracles& row_;
  const ExtremeRun& run_;
  const std::map<std::string, ExtremeRun>& before_;
  std::vector<Verdict> verdicts_;
};

}  // namespace

std::vector<Verdict> verdicts(const Oracles& row, const ExtremeRun& run,
                              const std::map<std::string, ExtremeRun>& before) {
  return Judge(row, run, before).verdicts();
}

std::vector<std::pair<std::string, std::string>> errors(const std::vector<Oracles>& rows) {
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

std::set<std::string> chosen_rows(const std::vector<Oracles>& rows, const std::string& only) {
  const auto has = [&](const std::string& text) { return text.find(only) != std::string::npos; };
  std::set<std::string> result;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    if (!has(row->group) && !has(row->title) && !result.contains(row->title)) continue;
    result.insert(row->title);
    if (row->equal) result.insert(row->equal->row);
  }
  return result;
}

post::Table table(const std::vector<Verdict>& verdicts) {
  const auto cell = [](const std::optional<double>& x) { return x ? post::Cell(*x) : post::Cell(); };
  post::Table result{
      {"group", "row", "oracle", "computed", "expected", "deviation", "allowed", "holds", "seconds", "message"}, {}};
  for (const auto& v : verdicts)
    result.rows.push_back({v.group, v.row, v.oracle, v.computed, v.expected, cell(v.deviation), cell(v.allowed),
                           std::string(v.holds ? "yes" : "no"), v.seconds, post::one_line(v.message)});
  return result;
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
