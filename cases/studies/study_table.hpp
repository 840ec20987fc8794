#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "post/report/curve_plot.hpp"
#include "post/report/quantity.hpp"

namespace post {
struct Table;
}

namespace cases {

enum class RunOutcome;

/// The reference is the run of the finest points: see `refer_to_finest`.
struct Finest {};

/// The reference is a curve in time, from a column of a file with a column t.
struct KnownCurve {
  std::filesystem::path file;
  std::string column;
  post::Curve curve = {};
};

using Known = std::variant<double, Finest, KnownCurve>;  // a number of 0 needs a scale

/// Reference of a quantity in all runs with these labels.
struct Reference {
  post::Quantity quantity;
  std::map<std::string, std::string> where = {};  // axis -> label; the other axes match any label
  Known known = 0.0;
  std::string source = {};
  std::optional<double> scale = std::nullopt;  // what errors are relative to, instead of the reference
};

/// True where the reference is one for the run with these labels, one per axis.
bool matches(const Reference& reference, const std::vector<std::string>& axes, const std::vector<std::string>& labels);

/// True where both can match the same run with the same quantity. False where an axis that both name has different
/// labels.
bool overlap(const Reference& one, const Reference& other);

/// A quantity of one run, and what it should be where that is known.
struct Wanted {
  post::Quantity quantity;
  std::optional<Known> reference;
  std::string source = {};
  std::optional<double> scale = std::nullopt;  // of the reference
};

/// Quantities wanted of the run with these labels: the listed quantities, which it has, then the distinct others of all
/// references, in their order, as far as the run has them. `has` says whether it has the quantity of a reference, which
/// `matches` the run or does not.
std::vector<Wanted> wanted(const std::vector<post::Quantity>& listed, const std::vector<Reference>& references,
                           const std::vector<std::string>& axes, const std::vector<std::string>& labels,
                           const std::function<bool(std::size_t reference, bool matches)>& has);

/// Combinations of one point of every axis, as indices, in the order of the runs: the first axis outermost.
std::vector<std::vector<std::size_t>> combinations(const std::vector<std::size_t>& sizes);

/// The text as part of a file's name: letters, digits and + - . _ only, at most 100 of them.
std::string plain_name(const std::string& text);

/// Name of the folder of the run with these labels: a plain name, none that is taken, and none of a file of the study.
std::string folder_name(const std::vector<std::string>& labels, const std::set<std::string>& taken);

/// Quantity of a run; a run that failed has a row with a message and no numbers.
struct StudyRow {
  std::vector<std::string> labels;  // one per axis
  std::string quantity, place, method;
  std::optional<double> computed, reference;      // compared with a curve: the peaks of both
  std::optional<double> scale = {};               // what errors are relative to, instead of the reference
  std::optional<double> estimated = {};           // error of `computed`, as the run estimates it, in its units
  std::optional<double> rms_error;                // compared with a curve: rms difference / |peak of the curve|
  bool against_finest = false;                    // the reference is another row: see `refer_to_finest`
  std::string source;                             // of the reference
  std::optional<std::size_t> points, iterations;  // iterations, or steps of a dynamic run
  std::optional<double> spacing, horizon;         // [length]
  std::optional<double> seconds, solve_seconds;   // of the run in total, and of its solution; medians of repetitions
  std::optional<double> seconds_min = {}, seconds_max = {};        // of a run that was repeated
  std::vector<std::pair<std::string, double>> stage_seconds = {};  // by the stages of summary.json
  RunOutcome outcome{};
  std::string message = {};

  double seconds_of(const std::string& stage) const;  // 0 where the run has no such stage
  /// rms_error, or else (computed - reference) / scale, or / reference, where these are known and not zero.
  std::optional<double> error() const;
  /// `estimated` relative to the same, or, without a reference, to `computed`.
  std::optional<double> estimated_error() const;
};

/// The rows of a finished run, one per quantity, or one without quantity where none is wanted. `run` has what is the
/// same in all of them and does not come from the summary: labels, spacing, horizon.
std::vector<StudyRow> study_rows(const StudyRow& run, const std::vector<Wanted>& wanted, const post::Summary& summary,
                                 const std::filesystem::path& folder);

/// Error against run time, over many runs.
struct StudyTable {
  std::vector<std::string> axes;
  std::vector<StudyRow> rows;
};

/// The columns of study.csv behind those of the axes. An axis may be named `spacing` or `horizon`, and its column then
/// stands for the study's own.
const std::vector<std::string>& study_columns();

/// The rows of study.csv.
post::Table table(const StudyTable& study);

/// The seconds of all runs by stage, with their spread, as an aligned table.
std::string costs_text(const StudyTable& study);

/// "pressure, 0.1: F1 at tip 0 = 0.3627, error +0.01 %, 62500 points, 731 iterations, 9.8 s", or with the message.
std::string to_text(const StudyRow& row);

/// An aligned table: one line per row, errors in percent.
std::string to_text(const StudyTable& study);

}  // namespace cases
