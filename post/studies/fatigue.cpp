#include "post/studies/fatigue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "plate/model/numerical_error.hpp"

namespace post {

std::vector<double> cycles(const ParisLaw& law, const std::vector<double>& lengths, const std::vector<double>& ranges) {
  if (lengths.size() != ranges.size()) throw std::invalid_argument("as many ranges as lengths are needed");
  const auto rate = [&](std::size_t i) {
    if (ranges[i] <= law.threshold) return 0.0;
    const double growth = law.coefficient * std::pow(ranges[i], law.exponent);
    if (!std::isnormal(growth))
      throw plate::NumericalError(
          fmt::format("Paris' law gives a growth of {:g} per cycle at a range of {:g}", growth, ranges[i]));
    return growth;
  };
  std::vector<double> result;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (i == 0) {
      result.push_back(0);
      continue;
    }
    const double a = lengths[i - 1], b = lengths[i];
    if (!(0 < a && a < b)) throw std::invalid_argument("lengths must ascend");
    double more = std::numeric_limits<double>::infinity();
    if (rate(i - 1) > 0 && rate(i) > 0) {
      const double power = std::log(rate(i) / rate(i - 1)) / std::log(b / a), left = 1 - power;  // rate ~ a^power
      const double growth = std::abs(left) < 1e-9 ? std::log(b / a) : (std::pow(b / a, left) - 1) / left;
      more = a / rate(i - 1) * growth;
    }
    if (std::isnan(more))
      throw plate::NumericalError(fmt::format("the cycles from length {:g} to {:g} are not a number", a, b));
    result.push_back(result.back() + more);
  }
  return result;
}

Table fatigue(const Table& growth, const Table& tip_table, const plate::Section& section, const ParisLaw& law,
              double load, double ratio) {
  const auto value = [&](const std::vector<Cell>& row, const char* name) {
    return std::get<double>(row.at(tip_table.column(name)));
  };
  std::map<double, double> load_factors;  // by advance
  for (const auto& row : growth.rows)
    load_factors[std::get<double>(row.at(growth.column("advance")))] =
        std::get<double>(row.at(growth.column("load_factor")));
  struct Way {
    std::vector<double> lengths, ranges;
    double crack = 0;      // length of the whole crack at the last row
    double own_share = 0;  // of what the crack grows to the next row
  };
  const auto tips = [&](double advance, double crack, const char* only) {
    return std::ranges::count_if(tip_table.rows, [&](const auto& row) {
      return value(row, "advance") == advance && value(row, "crack") == crack && (!only || value(row, only) > 0);
    });
  };
  std::map<double, Way> ways;  // by tip
  for (const auto& row : tip_table.rows) {
    auto& way = ways[value(row, "tip")];
    const double crack = value(row, "crack"), length = value(row, "length"), advance = value(row, "advance");
    const double own = way.lengths.empty() ? length / double(tips(advance, crack, nullptr))
                                           : way.lengths.back() + way.own_share * (length - way.crack);
    way.crack = length;
    way.own_share = value(row, "moves") > 0 ? 1 / double(tips(advance, crack, "moves")) : 0;
    if (!way.lengths.empty() && own <= way.lengths.back()) continue;  // this tip has not moved
    const double full = std::sqrt(3 * section.young * value(row, "G") / section.thickness) / load_factors.at(advance);
    way.lengths.push_back(own);
    way.ranges.push_back((1 - ratio) * load * full);
  }
  Table result{{"tip", "length", "K_range", "cycles"}, {}};
  for (const auto& [tip, way] : ways) {
    const auto found = cycles(law, way.lengths, way.ranges);
    for (std::size_t i = 0; i < found.size(); ++i)
      result.rows.push_back({tip, way.lengths[i], way.ranges[i], found[i]});
  }
  if (result.rows.size() <= ways.size())
    throw std::runtime_error("tips.csv has no tip that moved: there is no way to count cycles on");
  return result;
}

}  // namespace post
