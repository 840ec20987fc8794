#include "cases/driver/fatigue.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include "plate/model/errors.hpp"

namespace cases {
namespace {

/// a + factor b
std::vector<double> sum(std::vector<double> a, double factor, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
  return a;
}

}  // namespace

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

namespace {

/// Finite number in a column of a row. Throws std::runtime_error where the table is damaged.
double number_in(const char* file, const post::Table& table, const std::vector<post::Cell>& row, const char* column) {
  if (std::ranges::find(table.columns, column) == table.columns.end())
    throw std::runtime_error(fmt::format("{}: there is no column {}", file, column));
  const auto* number = std::get_if<double>(&row[table.column(column)]);
  if (!number || !std::isfinite(*number))
    throw std::runtime_error(fmt::format("{}, row {}: {} is no number", file, &row - table.rows.data() + 1, column));
  return *number;
}

/// A load factor of growth.csv and its estimated error, relative; absent where it is not known.
struct LoadFactor {
  double value = 0;
  std::optional<double> error = {};
};

/// Load factors by advance.
std::map<double, LoadFactor> load_factors_of(const post::Table& growth) {
  const bool has_errors = std::ranges::count(growth.columns, "critical_load_factor_error") > 0;
  std::map<double, LoadFactor> result;
  for (const auto& row : growth.rows) {
    if (!std::holds_alternative<double>(row[growth.column("load_factor")])) continue;  // one may have none
    auto& factor = result[number_in("growth.csv", growth, row, "advance")];
    factor.value = number_in("growth.csv", growth, row, "load_factor");
    if (!has_errors) continue;
    if (const auto* error = std::get_if<double>(&row[growth.column("critical_load_factor_error")]))
      factor.error = *error;
  }
  return result;
}

}  // namespace

post::Table fatigue(const post::Table& growth, const post::Table& tip_table, const plate::Section& section,
                    const ParisLaw& law, double load, double ratio) {
  const auto value = [&](const std::vector<post::Cell>& row, const char* name) {
    return number_in("tips.csv", tip_table, row, name);
  };
  const auto load_factors = load_factors_of(growth);
  struct TipHistory {
    std::vector<double> lengths, ranges, errors;  // the last: absolute, of the ranges
    double crack = 0;                             // length of the whole crack at the last row
    double own_share = 0;                         // of what the crack grows to the next row
  };
  const auto tips = [&](double advance, double crack, const char* only) {
    return std::ranges::count_if(tip_table.rows, [&](const auto& row) {
      return value(row, "advance") == advance && value(row, "crack") == crack && (!only || value(row, only) > 0);
    });
  };
  std::map<double, TipHistory> histories;  // by tip
  for (const auto& row : tip_table.rows) {
    auto& history = histories[value(row, "tip")];
    const double crack = value(row, "crack"), length = value(row, "length"), advance = value(row, "advance");
    const double own = history.lengths.empty() ? length / double(tips(advance, crack, nullptr))
                                               : history.lengths.back() + history.own_share * (length - history.crack);
    history.crack = length;
    history.own_share = value(row, "moves") > 0 ? 1 / double(tips(advance, crack, "moves")) : 0;
    if (!history.lengths.empty() && own <= history.lengths.back()) continue;  // this tip has not moved
    const double G = std::max(value(row, "G"), 0.0);
    const auto factor = load_factors.find(advance);
    if (factor == load_factors.end() || !(factor->second.value > 0))
      throw std::runtime_error(fmt::format("growth.csv: the advance {:g} of tips.csv has no load factor > 0", advance));
    const auto here = section.uniform() ? section : section.at({value(row, "x"), value(row, "y")});
    const double full = std::sqrt(3 * here.young * G / here.thickness) / factor->second.value;
    history.lengths.push_back(own);
    history.ranges.push_back((1 - ratio) * load * full);
    if (const auto error = factor->second.error) history.errors.push_back(*error * history.ranges.back());
  }
  post::Table result{{"tip", "length", "K_range", "cycles", "K_range_error", "cycles_least", "cycles_most"}, {}};
  for (const auto& [tip, history] : histories) {
    const auto found = cycles(law, history.lengths, history.ranges);
    std::vector<double> least, most;
    if (history.errors.size() == found.size())
      least = cycles(law, history.lengths, sum(history.ranges, 1, history.errors)),
      most = cycles(law, history.lengths, sum(history.ranges, -1, history.errors));
    for (std::size_t i = 0; i < found.size(); ++i) {
      result.rows.push_back(
          {tip, history.lengths[i], history.ranges[i], found[i], post::Cell(), post::Cell(), post::Cell()});
      if (!least.empty()) {
        auto& row = result.rows.back();
        row[4] = history.errors[i], row[5] = least[i], row[6] = most[i];
      }
    }
  }
  if (result.rows.size() <= histories.size())
    throw std::runtime_error("tips.csv has no tip that moved: there is no way to count cycles on");
  return result;
}

}  // namespace cases
