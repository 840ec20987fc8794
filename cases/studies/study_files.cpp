#include "cases/studies/study_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/studies/ledger.hpp"
#include "cases/studies/orders.hpp"
#include "cases/studies/study_plots.hpp"
#include "post/files/atomic_file.hpp"
#include "post/files/table.hpp"
#include "post/report/html_report.hpp"
#include "post/report/printed.hpp"

namespace cases {
namespace {

/// True where references of the same quantity differ along this axis alone.
bool changes_problem(const std::vector<StudyRow>& rows, std::size_t axis) {
  std::map<std::vector<std::string>, double> known;
  for (const auto& row : rows) {
    if (!row.reference) continue;
    auto key = row.labels;
    key.erase(key.begin() + std::ptrdiff_t(axis));
    for (const auto& word : {row.quantity, row.place, row.method}) key.push_back(word);
    const auto [found, fresh] = known.emplace(std::move(key), *row.reference);
    if (!fresh && std::abs(found->second - *row.reference) > 1e-9 * std::abs(*row.reference)) return true;
  }
  return false;
}

/// Labels of the axes that change the problem, and axes with labels of the others.
struct Split {
  std::vector<std::string> problem;
  std::vector<std::pair<std::string, std::string>> way;
};

Split split(const StudyTable& study, const std::vector<char>& problem, const StudyRow& row) {
  Split result;
  for (std::size_t axis = 0; axis < study.axes.size(); ++axis)
    if (problem[axis])
      result.problem.push_back(row.labels[axis]);
    else
      result.way.emplace_back(study.axes[axis], row.labels[axis]);
  return result;
}

/// Ways that have an error for every problem that any way has.
std::vector<Way> ways(const StudyTable& study) {
  std::vector<char> problem;
  for (std::size_t axis = 0; axis < study.axes.size(); ++axis) problem.push_back(changes_problem(study.rows, axis));
  std::vector<Way> result;
  std::vector<std::set<std::vector<std::string>>> solved;  // by each
  std::map<std::pair<std::string, std::string>, std::set<std::vector<std::string>>> all;
  for (const auto& row : study.rows) {
    const auto error = row.error();
    if (row.quantity.empty() || !error || !std::isfinite(*error) || !row.seconds) continue;
    const auto both = split(study, problem, row);
    const auto& problem_labels = both.problem;
    const auto& way_labels = both.way;
    auto found = std::ranges::find_if(result, [&](const Way& way) {
      return way.quantity == row.quantity && way.place == row.place && way.method == row.method &&
             way.labels == way_labels;
    });
    if (found == result.end()) {
      solved.emplace_back();
      found = result.insert(found, {row.quantity, row.place, way_labels, row.method});
    }
    found->error = std::max(found->error, std::abs(*error));
    found->seconds = std::max(found->seconds, *row.seconds);
    solved[std::size_t(found - result.begin())].insert(problem_labels);
    all[{row.quantity, row.place}].insert(problem_labels);
  }
  std::vector<Way> whole;
  for (std::size_t i = 0; i < result.size(); ++i)
    if (solved[i] == all[{result[i].quantity, result[i].place}]) whole.push_back(result[i]);
  return whole;
}

bool same_quantity(const Way& one, const Way& other) {
  return one.quantity == other.quantity && one.place == other.place;
}

std::string shown(const Way& way) {
  std::vector<std::string> parts;
  for (const auto& [axis, label] : way.labels) parts.push_back(axis + " " + label);
  if (!way.method.empty()) parts.push_back(way.method);
  parts.push_back(fmt::format("{:.2g} s", way.seconds));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string rounded_percent(double share) {
  return fmt::format("{:.2g} %", 100 * share);
}

}  // namespace

std::vector<Way> front(const StudyTable& study) {
  const auto all = ways(study);
  std::vector<Way> result;
  for (const auto& way : all) {
    const bool beaten = std::ranges::any_of(all, [&](const Way& other) {
      return same_quantity(way, other) && other.seconds <= way.seconds && other.error <= way.error &&
             (other.seconds < way.seconds || other.error < way.error);
    });
    if (!beaten) result.push_back(way);
  }
  std::ranges::stable_sort(result, [](const Way& one, const Way& other) { return one.seconds < other.seconds; });
  return result;
}

std::vector<std::string> advice(const StudyTable& study) {
  constexpr double wanted = 0.01;
  const auto ways = front(study);
  std::vector<std::string> result;
  std::vector<Way> said;
  for (const auto& first : ways) {
    if (std::ranges::any_of(said, [&](const Way& way) { return same_quantity(way, first); })) continue;
    said.push_back(first);
    const Way* chosen = nullptr;
    for (const auto& way : ways) {
      if (!same_quantity(way, first) || (chosen && chosen->error <= wanted)) continue;
      if (!chosen || way.error < chosen->error) chosen = &way;  // slower, and more exact
    }
    const auto what = first.place.empty() ? first.quantity : first.quantity + " at " + first.place;
    if (chosen->error <= wanted)
      result.push_back(fmt::format("for {} of {} take {} (error {})", rounded_percent(wanted), what, shown(*chosen),
                                   rounded_percent(chosen->error)));
    else
      result.push_back(fmt::format("nothing here has {} to {}; the most exact, {}, is {}", what,
                                   rounded_percent(wanted), rounded_percent(chosen->error), shown(*chosen)));
  }
  return result;
}

std::string to_json(const std::string& title, const StudyTable& study) {
  using Json = nlohmann::ordered_json;
  std::map<std::vector<std::string>, std::string> outcomes;
  for (const auto& row : study.rows) outcomes[row.labels] = name_of(row.outcome);
  std::map<std::string, std::size_t> counts{{name_of(RunOutcome::done), 0}};
  for (const auto& [labels, outcome] : outcomes) ++counts[outcome];
  Json json{{"title", title}, {"runs", outcomes.size()}, {"outcomes", counts}};
  json["advice"] = advice(study);
  json["front"] = Json::array();
  for (const auto& way : front(study)) {
    Json labels = Json::object();
    for (const auto& [axis, label] : way.labels) labels[axis] = label;
    json["front"].push_back({{"quantity", way.quantity},
                             {"place", way.place},
                             {"labels", labels},
                             {"srif_method", way.method},
                             {"error", way.error},
                             {"seconds", way.seconds}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void write_study(const StudyTable& study, const StudyTitles& titles, const std::filesystem::path& folder) {
  post::write_csv(folder / "study.csv", table(study));
  post::write_atomically(folder / "study.json", to_json(titles.title, study));
  if (refinement(study.rows)) post::write_csv(folder / "orders.csv", orders_table(study));
  for (const auto& [name, plot] : study_plots(study, titles)) post::write_atomically(folder / name, post::to_svg(plot));
  post::write_study_report(folder, titles.title);
}

std::string printed_study(const StudyTable& study, const std::string& title, const std::filesystem::path& folder) {
  std::string text = fmt::format("{}\n{}", title, to_text(study));
  if (!orders(study).empty()) text += fmt::format("\nfitted orders\n{}", orders_text(study));
  text += fmt::format("\nseconds by stage\n{}", costs_text(study));
  for (const auto& sentence : advice(study)) text += sentence + "\n";
  return text + post::results_in(folder);
}

}  // namespace cases
