#include "post/studies/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "post/studies/compare.hpp"

namespace post {
namespace {

/// Compares the history of a quantity with a curve.
void compare_with(StudyRow& row, const KnownCurve& known, const Curve& computed) {
  row.source = fmt::format("{} {}", known.file.filename().string(), known.column);
  try {
    const auto result = compare(computed.t, computed.y, known.curve.t, known.curve.y);
    row.computed = result.peak_computed;
    row.reference = result.peak_reference;
    row.rms_error = result.rms_of_peak;
  } catch (const std::invalid_argument& error) {
    row.message = error.what();
  }
}

}  // namespace

bool matches(const Reference& reference, const std::vector<std::string>& axes, const std::vector<std::string>& labels) {
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const auto label = reference.where.find(axes[axis]);
    if (label != reference.where.end() && label->second != labels.at(axis)) return false;
  }
  return true;
}

bool overlap(const Reference& one, const Reference& other) {
  const bool apart = std::ranges::any_of(one.where, [&](const auto& entry) {
    const auto same = other.where.find(entry.first);
    return same != other.where.end() && same->second != entry.second;
  });
  return !apart && one.quantity == other.quantity;
}

std::vector<Wanted> wanted(const std::vector<Quantity>& listed, const std::vector<Reference>& references,
                           const std::vector<std::string>& axes, const std::vector<std::string>& labels,
                           const std::function<bool(std::size_t reference, bool matches)>& has) {
  std::vector<Wanted> result;
  for (const auto& quantity : listed)
    if (std::ranges::find(result, quantity, &Wanted::quantity) == result.end())
      result.push_back({quantity, std::nullopt});
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto& quantity = references[i].quantity;
    const bool matched = matches(references[i], axes, labels);
    if (!has(i, matched)) continue;
    auto known = std::ranges::find(result, quantity, &Wanted::quantity);
    if (known == result.end()) known = result.insert(known, {quantity, std::nullopt});
    if (!matched) continue;
    known->reference = references[i].known;
    known->source = references[i].source;
    known->scale = references[i].scale;
  }
  return result;
}

std::vector<std::vector<std::size_t>> combinations(const std::vector<std::size_t>& sizes) {
  std::vector<std::vector<std::size_t>> result{{}};
  for (const std::size_t size : sizes) {
    std::vector<std::vector<std::size_t>> longer;
    for (const auto& combination : result)
      for (std::size_t i = 0; i < size; ++i) {
        longer.push_back(combination);
        longer.back().push_back(i);
      }
    result = std::move(longer);
  }
  return result;
}

std::string plain_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' ||
                       c == '-' || (c == '.' && !name.empty());
    if (plain || !name.ends_with('_')) name += plain ? c : '_';
  }
  constexpr std::size_t longest = 100;  // file systems take 255
  name = name.substr(0, longest);
  return name.ends_with('_') && name.size() > 1 ? name.substr(0, name.size() - 1) : name;
}

std::string folder_name(const std::vector<std::string>& labels, const std::set<std::string>& taken) {
  std::string name = plain_name(fmt::format("{}", fmt::join(labels, "_")));
  if (name.empty()) name = "run";
  const auto is_file = [](const std::string& text) {
    return std::ranges::any_of(std::array{".csv", ".svg", ".json", ".html", ".partial"},
                               [&](const char* end) { return text.ends_with(end); });
  };
  std::string free = name;
  for (int count = 2; taken.contains(free) || is_file(free); ++count) free = fmt::format("{}-{}", name, count);
  return free;
}

std::optional<double> StudyRow::error() const {
  const auto unit = scale ? scale : reference;
  if (rms_error || !computed || !reference || *unit == 0) return rms_error;
  return (*computed - *reference) / *unit;
}

std::optional<double> StudyRow::estimated_error() const {
  const auto unit = scale ? scale : reference ? reference : against_finest ? std::nullopt : computed;
  if (rms_error || !estimated || !unit || *unit == 0) return std::nullopt;
  return *estimated / std::abs(*unit);
}

double StudyRow::seconds_of(const std::string& stage) const {
  for (const auto& [name, spent] : stage_seconds)
    if (name == stage) return spent;
  return 0;
}

std::vector<StudyRow> study_rows(const StudyRow& run, const std::vector<Wanted>& wanted, const Summary& summary,
                                 const std::filesystem::path& folder) {
  StudyRow common = run;
  common.points = summary.points;
  common.stage_seconds = summary.seconds;
  common.outcome = "done";
  common.iterations = summary.analysis.iterations ? summary.analysis.iterations : summary.analysis.steps;
  for (const auto& [stage, spent] : summary.seconds) {
    if (stage == "total") common.seconds = spent;
    if (stage == "solve") common.solve_seconds = spent;
  }
  std::vector<StudyRow> rows;
  for (const auto& [quantity, reference, source, scale] : wanted) {
    auto& row = rows.emplace_back(common);
    row.quantity = quantity.name;
    row.place = quantity.place();
    row.method = quantity.method;
    row.source = source;
    row.computed = value(quantity, summary, folder);
    if (!row.computed) row.message = lack(quantity, summary);
    if (row.computed) row.estimated = estimated_error(quantity, summary);
    if (!reference || !row.computed) continue;
    row.scale = scale;
    row.against_finest = std::holds_alternative<Finest>(*reference);
    if (const auto* number = std::get_if<double>(&*reference)) row.reference = *number;
    if (const auto* known = std::get_if<KnownCurve>(&*reference)) compare_with(row, *known, history(quantity, folder));
  }
  return rows.empty() ? std::vector{common} : rows;
}

}  // namespace post
