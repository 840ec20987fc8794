#include "cases/studies/curve_norms.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace cases {
namespace {

/// Returns what is wrong with a curve, empty where nothing is.
std::string error_of(const std::vector<double>& t, const std::vector<double>& y, const char* which) {
  if (t.size() != y.size()) return fmt::format("{}: {} times, {} values", which, t.size(), y.size());
  if (t.empty()) return fmt::format("{}: no samples", which);
  if (!std::ranges::is_sorted(t)) return fmt::format("{}: time goes back", which);
  return "";
}

/// Linear between the samples; beyond them their ends.
double interpolated(const std::vector<double>& t, const std::vector<double>& y, double time) {
  const auto above = static_cast<std::size_t>(std::ranges::lower_bound(t, time) - t.begin());
  if (above == 0) return y.front();
  if (above == t.size()) return y.back();
  const double share = (time - t[above - 1]) / (t[above] - t[above - 1]);
  return y[above - 1] + share * (y[above] - y[above - 1]);
}

struct Extremum {
  double time = 0, value = 0;
};

Extremum peak(const std::vector<double>& t, const std::vector<double>& y, double from, double to) {
  Extremum result;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] >= from && t[i] <= to && std::abs(y[i]) > std::abs(result.value)) result = {t[i], y[i]};
  }
  return result;
}

/// The times of both curves from the first to the last common one.
std::vector<double> common_times(const post::Curve& one, const post::Curve& other, double from, double to) {
  std::vector<double> times{from, to};
  for (const auto* t : {&one.t, &other.t})
    std::ranges::copy_if(*t, std::back_inserter(times), [&](double time) { return time > from && time < to; });
  std::ranges::sort(times);
  const auto [last, end] = std::ranges::unique(times);
  times.erase(last, end);
  return times;
}

/// L2 norm and maximum of the difference of two curves that are linear between their samples: exact.
void add_norms(Comparison& result, const post::Curve& computed, const post::Curve& reference) {
  const auto times = common_times(computed, reference, result.from, result.to);
  std::vector<double> difference, known;
  for (const double time : times) {
    known.push_back(interpolated(reference.t, reference.y, time));
    difference.push_back(interpolated(computed.t, computed.y, time) - known.back());
    result.relative_max = std::max(result.relative_max, std::abs(difference.back() / result.peak_reference));
  }
  double differences = 0, squares = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const auto square = [&](const std::vector<double>& y) {
      return (times[i] - times[i - 1]) * (y[i - 1] * y[i - 1] + y[i - 1] * y[i] + y[i] * y[i]) / 3;
    };
    differences += square(difference), squares += square(known);
  }
  result.relative_l2 = squares > 0 ? std::sqrt(differences / squares) : result.relative_rms;
}

/// Correlation of computed(t + lag) and reference(t) where both are known; none where one of them is constant there.
std::optional<double> correlation(const post::Curve& computed, const post::Curve& reference, double from, double to,
                                  double lag) {
  constexpr int samples = 1000;
  const double first = std::max(from, from - lag), last = std::min(to, to - lag);
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (int i = 0; i <= samples; ++i) {
    const double time = first + (last - first) * i / samples;
    const double y = interpolated(computed.t, computed.y, time + lag), r = interpolated(reference.t, reference.y, time);
    a += y, b += r, aa += y * y, bb += r * r, ab += y * r;
  }
  const double n = samples + 1, yy = aa - a * a / n, rr = bb - b * b / n;
  constexpr double nothing = 1e-12;  // of the squares: rounding
  if (yy <= nothing * aa || rr <= nothing * bb) return std::nullopt;
  return (ab - a * b / n) / std::sqrt(yy * rr);
}

/// The lag of the best correlation: tried in steps, then between the neighbours of the best by golden sections.
std::optional<double> shift(const post::Curve& computed, const post::Curve& reference, double from, double to) {
  constexpr int steps = 200;  // each way
  constexpr double as_good = 1e-9;
  const double longest = (to - from) / 4, step = longest / steps;
  const auto at = [&](double lag) { return correlation(computed, reference, from, to, lag); };
  const auto none = at(0);
  if (!none || !(longest > 0)) return std::nullopt;
  double best = 0, most = *none;
  for (int i = 1; i <= steps; ++i)
    for (const double lag : {i * step, -i * step})
      if (const auto found = at(lag); found && *found > most + as_good) best = lag, most = *found;
  constexpr double golden = 0.6180339887498949;
  double low = best - step, high = best + step;
  while (high - low > 1e-9 * longest) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    if (at(left).value_or(-1) > at(right).value_or(-1))
      high = right;
    else
      low = left;
  }
  const double refined = (low + high) / 2;
  return at(refined).value_or(-1) > most + 1e-15 ? refined : best;
}

}  // namespace

std::variant<Comparison, std::string> compare(const std::vector<double>& t, const std::vector<double>& y,
                                              const std::vector<double>& reference_t,
                                              const std::vector<double>& reference_y) {
  if (auto error = error_of(t, y, "computed"); !error.empty()) return error;
  if (auto error = error_of(reference_t, reference_y, "reference"); !error.empty()) return error;
  const double from = std::max(t.front(), reference_t.front()), to = std::min(t.back(), reference_t.back());
  Comparison result;
  double differences = 0, squares = 0;
  for (std::size_t i = 0; i < reference_t.size(); ++i) {
    if (reference_t[i] < from || reference_t[i] > to) continue;
    const double difference = interpolated(t, y, reference_t[i]) - reference_y[i];
    differences += difference * difference;
    squares += reference_y[i] * reference_y[i];
    ++result.samples;
  }
  if (result.samples < 2)
    return fmt::format(
        "{} samples in common, where two are needed: computed are times {:g} to {:g}, the reference has {:g} to {:g}",
        result.samples, t.front(), t.back(), reference_t.front(), reference_t.back());
  if (squares == 0) return "the reference is zero where the curves overlap";
  const Extremum computed = peak(t, y, from, to), reference = peak(reference_t, reference_y, from, to);
  result.relative_rms = std::sqrt(differences / squares);
  result.rms_of_peak = std::sqrt(differences / static_cast<double>(result.samples)) / std::abs(reference.value);
  result.peak_error = (computed.value - reference.value) / reference.value;
  result.peak_computed = computed.value;
  result.peak_reference = reference.value;
  result.time_of_peak_computed = computed.time;
  result.time_of_peak_reference = reference.time;
  result.from = from, result.to = to;
  const double range = reference_t.back() - reference_t.front();
  result.covered = range > 0 ? (to - from) / range : 1;
  add_norms(result, {t, y}, {reference_t, reference_y});
  if (to > from) result.peak_time_error = (computed.time - reference.time) / (to - from);
  result.shift = shift({t, y}, {reference_t, reference_y}, from, to);
  return result;
}

std::vector<std::pair<std::string, double>> measures(const Comparison& comparison) {
  std::vector<std::pair<std::string, double>> result{{"l2", comparison.relative_l2},
                                                     {"max", comparison.relative_max},
                                                     {"peak", std::abs(comparison.peak_error)},
                                                     {"peak_time", std::abs(comparison.peak_time_error)}};
  if (const auto shift = comparison.relative_shift()) result.emplace_back("shift", std::abs(*shift));
  return result;
}

}  // namespace cases
