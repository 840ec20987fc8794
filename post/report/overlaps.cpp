#include "post/report/overlaps.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "plate/model/section.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"

namespace post {
namespace {

/// A row of the recommended method.
struct FaceRow {
  double time, K1;
  Overlap where;
};

std::map<std::size_t, std::vector<FaceRow>> rows_by_tip(const Table& srifs, std::vector<FaceOverlaps>& tips) {
  const auto time = srifs.column("time"), tip = srifs.column("tip"), x = srifs.column("x"), y = srifs.column("y"),
             K1 = srifs.column("K1"), where = srifs.column("overlaps_at");
  std::map<std::size_t, std::vector<FaceRow>> result;
  for (std::size_t i = 0; i < srifs.rows.size(); ++i) {
    const auto& row = srifs.rows[i];
    if (i > 0 && srifs.rows[i - 1][time] == row[time] && srifs.rows[i - 1][tip] == row[tip]) continue;
    const auto* word = std::get_if<std::string>(&row[where]);
    const auto* value = std::get_if<double>(&row[K1]);
    const auto number = std::size_t(std::get<double>(row[tip]));
    auto& rows = result[number];
    if (rows.empty()) tips.push_back({number, {std::get<double>(row[x]), std::get<double>(row[y])}});
    const auto which = !word || !value ? Overlap::unknown : *word == "z>0" ? Overlap::above : Overlap::below;
    rows.push_back({std::get<double>(row[time]), value ? *value : 0, which});
  }
  return result;
}

/// Says of the tip of a crack whose K1 is least that its faces overlap; `tips`: of this crack, with K1 < 0.
std::string of_tip(const FaceOverlaps& tip, std::size_t tips, const plate::Section& section,
                   const std::function<std::string(double time)>& row) {
  if (row)
    return fmt::format("K1 is negative in {} of {} rows at tip {}, first at {}: faces overlap", tip.above, tip.rows,
                       tip.tip, row(*tip.first_above));
  Srif least;
  least.K1 = *tip.least, least.position = tip.position;
  const auto overlap = at_faces(least, section, {}).overlap;
  return fmt::format(
      "K1 is negative at {} tip{}, {:.4g} at tip {} ({:.4g}, {:.4g}): faces overlap{}", tips, tips == 1 ? "" : "s",
      *tip.least, tip.tip, tip.position.x(), tip.position.y(),
      overlap ? fmt::format(" by {:.2g} thicknesses", *overlap / section.at(tip.position).thickness) : "");
}

}  // namespace

const char* remedy_of_overlaps(bool may_touch) {
  return may_touch ? "set `contact` = true" : "set loads that open it";
}

std::vector<FaceOverlaps> face_overlaps(const Table& srifs) {
  constexpr double nothing = 1e-3;
  std::vector<FaceOverlaps> result;
  const auto rows = rows_by_tip(srifs, result);
  for (auto& tip : result) {
    const auto& own = rows.at(tip.tip);
    const auto size = [](const FaceRow& row) { return std::abs(row.K1); };
    const double largest = size(*std::ranges::max_element(own, {}, size));
    auto before = Overlap::unknown;
    for (const auto& row : own) {
      ++tip.rows;
      if (row.where == Overlap::unknown || size(row) < nothing * largest) continue;
      if (before != Overlap::unknown && row.where != before && !tip.first_change) tip.first_change = row.time;
      before = row.where;
      if (row.where == Overlap::below) continue;
      ++tip.above;
      if (!tip.first_above) tip.first_above = row.time;
      tip.least = std::min(tip.least.value_or(0), row.K1);
    }
  }
  std::ranges::sort(result, {}, &FaceOverlaps::tip);
  return result;
}

std::vector<std::string> warnings_about_faces(const std::vector<FaceOverlaps>& found, const plate::Section& section,
                                              const std::function<std::size_t(std::size_t tip)>& crack,
                                              const std::function<std::string(double time)>& row, bool may_touch) {
  std::map<std::size_t, std::vector<const FaceOverlaps*>> by_crack;
  for (const auto& tip : found)
    if (tip.above > 0) by_crack[crack ? crack(tip.tip) : 0].push_back(&tip);
  std::vector<std::string> result;
  for (const auto& [number, tips] : by_crack) {
    const auto& worst = **std::ranges::min_element(tips, {}, [](const auto* tip) { return *tip->least; });
    result.push_back(fmt::format("{}: {}; {}", crack ? fmt::format("crack {}", number) : "cracks",
                                 of_tip(worst, tips.size(), section, row), remedy_of_overlaps(may_touch)));
  }
  return result;
}

}  // namespace post
