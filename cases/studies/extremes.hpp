#pragma once
#include "cases/studies/forms.hpp"
#include "post/report/quantity.hpp"

namespace cases {

/// A quantity has this value: a closed form, a series, finite elements.
struct KnownValue {
  post::Quantity quantity;
  double is = 0, tolerance = 0;  // relative
  std::string source;
};

/// A quantity is `factor` times that of a row before: another unit, a mirror image, what should make no difference.
struct EqualValue {
  post::Quantity quantity;
  std::string row;
  double factor = 1, tolerance = 0;  // relative
};

/// The discrete energy of history.csv stays the same.
struct ConservedEnergy {
  double after = 0;      // [time] rows before are left out
  double tolerance = 0;  // (largest - smallest) / mean
};

/// A case at the edge of what can be computed, and what must come out of it: one oracle or several.
struct ExtremeRow {
  std::string group, title;
  std::optional<std::filesystem::path> case_file;
  std::vector<Setting> set;
  std::optional<double> time_step_share;  // dynamic: time step / the program's stable limit for this row
  std::optional<KnownValue> value;
  std::optional<EqualValue> equal;
  std::optional<ConservedEnergy> conserved;
  std::string refused, failed, warned;  // part of the message of what forbids the case, of a NumericalError, a warning
};

struct Extremes {
  std::string title;
  std::vector<Setting> set;  // of all rows
  std::vector<ExtremeRow> rows;
};

/// Reads a table of extremes; its cases are read when they are run, because some must be refused. Throws CaseError.
Extremes read_extremes(const std::filesystem::path& path);

struct ExtremeOptions {
  std::filesystem::path folder;  // one folder per row, and extremes.csv
  std::vector<std::string> set;  // overrides of all rows; those of the rows prevail
  std::string only;              // rows whose group or title contains this, and the rows that they name
  bool quiet = false;
};

/// Verdict of an oracle on a row, and what the program did.
struct Verdict {
  std::string group, row, oracle, computed, expected;
  std::optional<double> deviation, allowed;
  bool holds = false;
  double seconds = 0;
  std::string message = {};  // of an error or a warning
};

/// Runs the rows in their order, a line per verdict unless quiet; writes extremes.csv.
std::vector<Verdict> run_extremes(const Extremes& extremes, const ExtremeOptions& options);

/// An aligned table: one line per verdict.
std::string to_text(const std::vector<Verdict>& verdicts);

}  // namespace cases
