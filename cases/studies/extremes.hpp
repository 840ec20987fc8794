#pragma once
#include "cases/studies/forms.hpp"
#include "cases/studies/oracles.hpp"

namespace cases {

/// A case at the edge of what can be computed, and what must come out of it.
struct ExtremeRow : Oracles {
  std::optional<std::filesystem::path> case_file;
  std::vector<Setting> set;
  std::optional<double> time_step_share;  // dynamic: time step / the program's stable limit for this row
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

/// Runs the rows in their order, a line per verdict unless quiet; writes extremes.csv.
std::vector<Verdict> run_extremes(const Extremes& extremes, const ExtremeOptions& options);

}  // namespace cases
