#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cases/studies/curve_norms.hpp"
#include "post/report/curve_plot.hpp"

namespace cases {

/// Quantity of a run compared with a column of a reference.
struct ComparedQuantity {
  std::string quantity;   // w, theta_x, theta_y, u, v, K1 ... K3, F1 ... F3, N1, N2
  std::string reference;  // the column: F1_J is the best value of F1, F1_paper_LS the paper's own recipe
  Comparison comparison;
  post::Curve computed, known;  // the whole curves, also outside the range that both cover
  std::string note = {};        // why the difference says little, and what to compare instead
};

/// Compares the probe and the tip of a finished run with the curves of a reference file, which has a column `t`.
/// The probe is the one called `tip`, or else the first; one called `ahead` is compared with the columns w_a, tx_a and
/// ty_a. Rotations of a probe at a crack tip get a note: they are singular there. The tip is the nearest to that probe,
/// or else the first; the method is the first that is listed for it. Columns of the reference that are zero throughout
/// are left out. Throws std::invalid_argument where the reference has no column `t`, or run and reference have no
/// curve, or fewer than two times of one, in common.
std::vector<ComparedQuantity> compare(const std::filesystem::path& results, const std::filesystem::path& reference);

/// A measure that is above its tolerance.
struct Exceeded {
  std::string quantity, reference, measure;
  double found, allowed;
};

/// Tolerances by measure (see `measures`), or for all of them. NaN is above every tolerance.
struct Tolerances {
  std::map<std::string, double> by_measure;
  std::optional<double> all;
};

/// "l2=0.01" and so on. Throws std::invalid_argument, saying what is wrong with a text.
Tolerances tolerances(const std::vector<std::string>& texts, std::optional<double> all);

std::vector<Exceeded> exceeded(const std::vector<ComparedQuantity>& rows, const Tolerances& tolerances);

/// The comparisons, and what of them exceeds the tolerances.
std::string to_json(const std::vector<ComparedQuantity>& rows, const std::vector<Exceeded>& above);

/// Lists the quantities that exceed the tolerances, one line each.
std::string to_text(const std::vector<Exceeded>& above);

/// The comparisons as lines of text under a header; where the run does not cover the whole reference, a line says
/// so.
std::string to_text(const std::vector<ComparedQuantity>& rows);

/// The computed curves over their references: one panel for each quantity, K left out where F of the same mode is
/// there; `si`: with units.
post::CurvePlot plot(const std::vector<ComparedQuantity>& rows, const std::string& title, bool si = false);

/// The title in summary.json of a finished run, or else the name of its folder.
std::string title_of(const std::filesystem::path& results);

/// A finished run against a reference curve: what there is, and what of it exceeds the tolerances.
struct ComparedRun {
  std::filesystem::path folder;
  std::vector<ComparedQuantity> rows;
  std::vector<Exceeded> above;
};

/// Throws as compare() does.
ComparedRun compared(const std::filesystem::path& folder, const std::filesystem::path& reference,
                     const Tolerances& tolerances);

std::string to_text(const ComparedRun& run);

/// Writes the curves as a drawing (SVG), or a page (.html), and all numbers as JSON, where these have a name.
void write(const ComparedRun& run, const std::filesystem::path& drawing, const std::filesystem::path& json);

}  // namespace cases
