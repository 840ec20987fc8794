#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "post/figures/curve_plot.hpp"

namespace post {

/// How far a computed curve is from a reference, over the range of time that both cover.
/// A peak is the value of largest magnitude, with its sign.
struct Comparison {
  double relative_rms = 0;  // rms(computed - reference) / rms(reference), at the times of the reference
  double rms_of_peak = 0;   // rms(computed - reference) / |peak_reference|
  double peak_error = 0;    // (peak_computed - peak_reference) / peak_reference
  double peak_computed = 0, peak_reference = 0;
  double time_of_peak_computed = 0, time_of_peak_reference = 0;
  std::size_t samples = 0;  // times of the reference within the common range
};

/// Compares y(t) with reference_y(reference_t); y is linear between its samples.
/// Throws std::invalid_argument where times and values differ in number, times decrease, fewer than two times of the
/// reference lie in the common range, or the reference is zero there.
Comparison compare(const std::vector<double>& t, const std::vector<double>& y, const std::vector<double>& reference_t,
                   const std::vector<double>& reference_y);

/// One quantity of a run against one column of a reference.
struct ComparedQuantity {
  std::string quantity;   // w, theta_x, theta_y, K1 ... K3, F1 ... F3
  std::string reference;  // the column: F1_J is the best value of F1, F1_paper_LS the paper's own recipe
  Comparison comparison;
  Curve computed, known;  // the whole curves, also outside the range that both cover
};

/// Compares the probe and the tip of a finished run with the curves of a reference file, which has a column `t`.
/// The probe is the one called `tip`, or else the first; the tip is the nearest to that probe, or else the first; the
/// method is the first that is listed for it. Columns of the reference that are zero throughout are left out.
/// Throws std::runtime_error where the reference has no column `t`, or run and reference have no curve in common.
std::vector<ComparedQuantity> compare(const std::filesystem::path& results, const std::filesystem::path& reference);

/// The comparisons as lines of text under a header.
std::string to_text(const std::vector<ComparedQuantity>& rows);

/// The computed curves over their references: one panel for each quantity, K left out where F of the same mode is
/// there.
CurvePlot plot(const std::vector<ComparedQuantity>& rows, const std::string& title);

/// The title in summary.json of a finished run, or else the name of its folder.
std::string title_of(const std::filesystem::path& results);

}  // namespace post
