#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "post/report/curve_plot.hpp"

namespace cases {

/// Difference of a computed curve from a reference, over the range of time that both cover; both are linear between
/// their samples. A peak is the value of largest magnitude, with its sign.
struct Comparison {
  double relative_rms = 0;  // rms(computed - reference) / rms(reference), at the times of the reference
  double rms_of_peak = 0;   // rms(computed - reference) / |peak_reference|
  double peak_error = 0;    // (peak_computed - peak_reference) / peak_reference
  double peak_computed = 0, peak_reference = 0;
  double time_of_peak_computed = 0, time_of_peak_reference = 0;
  std::size_t samples = 0;      // times of the reference within the common range
  double from = 0, to = 0;      // the common range [time]
  double covered = 0;           // its share of the range of the reference
  double relative_l2 = 0;       // integral of (computed - reference)^2 over that of reference^2, roots of both
  double relative_max = 0;      // max |computed - reference| / |peak_reference|
  double peak_time_error = 0;   // (time_of_peak_computed - time_of_peak_reference) / (to - from)
  std::optional<double> shift;  // by which the computed curve comes late [time]; none where one of them is constant

  /// `shift` over the common range.
  std::optional<double> relative_shift() const { return shift ? std::optional(*shift / (to - from)) : std::nullopt; }
};

/// Compares y(t) with reference_y(reference_t). The shift is that by which the two correlate best, at most a quarter of
/// the common range each way; of several such the smallest. Returns the reason instead where times and values differ
/// in number, times decrease, fewer than two times of the reference lie in the common range, or the reference is zero
/// there.
std::variant<Comparison, std::string> compare(const std::vector<double>& t, const std::vector<double>& y,
                                              const std::vector<double>& reference_t,
                                              const std::vector<double>& reference_y);

/// The relative numbers of a comparison that a script may hold against a tolerance, by name: l2, max, peak, peak_time,
/// shift; without sign. A shift that is not known is left out.
std::vector<std::pair<std::string, double>> measures(const Comparison& comparison);

}  // namespace cases
