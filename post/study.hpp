#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "post/summary.hpp"
#include "post/table.hpp"

namespace post {

/// A number that runs are compared by: K1, K2, K3, F1, F2, F3 of a tip, w, theta_x, theta_y at a probe, or
/// strain_energy. Has a tip, a probe or neither, as its name asks for.
struct Quantity {
  std::string name;
  std::optional<std::size_t> tip = std::nullopt;
  std::optional<std::string> probe = std::nullopt;

  /// "tip 0", the probe's name, or "".
  std::string place() const;
  bool operator==(const Quantity&) const = default;
};

/// The quantity at the last time of a finished run, from its summary and the probes.csv and history.csv of its folder;
/// of a tip with several methods that of the first. Nothing where the run has no such number, or it is not finite.
std::optional<double> value(const Quantity& quantity, const Summary& summary, const std::filesystem::path& folder);

/// The names that a quantity can have.
const std::vector<std::string>& quantity_names();

/// What a quantity of this name is of: "tip", "probe", or "" for the whole plate.
std::string kind_of_place(const std::string& quantity);

/// What a quantity should be, in all runs with these labels.
struct Reference {
  Quantity quantity;
  std::map<std::string, std::string> where = {};  // axis -> label; the other axes match any label
  double value = 0;                               // not 0: errors are relative to it
  std::string source = {};
};

/// Is the reference one for the run with these labels, one per axis?
bool matches(const Reference& reference, const std::vector<std::string>& axes, const std::vector<std::string>& labels);

/// Can both match the same run with the same quantity? Not where an axis that both name has different labels.
bool overlap(const Reference& one, const Reference& other);

/// A quantity of one run, and the value that it should have where one is known.
struct Wanted {
  Quantity quantity;
  std::optional<double> reference;
};

/// What is compared in the run with these labels: the distinct quantities of all references, in their order, as far as
/// the run has them. `has` says whether it has the quantity of a reference, which `matches` the run or does not.
std::vector<Wanted> wanted(const std::vector<Reference>& references, const std::vector<std::string>& axes,
                           const std::vector<std::string>& labels,
                           const std::function<bool(std::size_t reference, bool matches)>& has);

/// One point of every axis, as indices, in the order of the runs: the first axis outermost.
std::vector<std::vector<std::size_t>> combinations(const std::vector<std::size_t>& sizes);

/// Name of the folder of the run with these labels: letters, digits and + - . _ only; none that is taken, and none of a
/// file of the study.
std::string folder_name(const std::vector<std::string>& labels, const std::set<std::string>& taken);

/// One quantity of one run; a run that failed has a row with a message and no numbers.
struct StudyRow {
  std::vector<std::string> labels;  // one per axis
  std::string quantity, place;
  std::optional<double> computed, reference;
  std::optional<std::size_t> points, iterations;  // iterations, or steps of a dynamic run
  std::optional<double> spacing;                  // [length]
  std::optional<double> seconds, solve_seconds;   // of the run in total, and of its solution
  std::string message = {};

  /// (computed - reference) / reference, where both are known and the reference is not zero.
  std::optional<double> error() const;
};

/// The rows of a finished run, one per quantity, or one without quantity where none is wanted. `run` has what is the
/// same in all of them and does not come from the summary: labels, spacing.
std::vector<StudyRow> study_rows(const StudyRow& run, const std::vector<Wanted>& wanted, const Summary& summary,
                                 const std::filesystem::path& folder);

/// Error against run time, over many runs.
struct StudyTable {
  std::vector<std::string> axes;
  std::vector<StudyRow> rows;
};

/// The columns of study.csv behind those of the axes.
const std::vector<std::string>& study_columns();

/// The rows of study.csv.
Table table(const StudyTable& study);

/// "pressure, 0.1: F1 at tip 0 = 0.3627, error +0.01 %, 62500 points, 731 iterations, 9.8 s", or with the message.
std::string to_text(const StudyRow& row);

/// An aligned table: one line per row, errors in percent.
std::string to_text(const StudyTable& study);

}  // namespace post
