#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "post/files/summary.hpp"
#include "post/report/quantity.hpp"

namespace post {
struct Table;
}

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

/// Expected outcome of a case at the edge of what can be computed: one oracle or several.
struct Oracles {
  std::string group, title;
  std::optional<KnownValue> value;
  std::optional<EqualValue> equal;
  std::optional<ConservedEnergy> conserved;
  std::string refused, failed, warned;  // part of the message of what forbids the case, of a NumericalError, a warning
};

/// Every row has a name of its own and an oracle; what it should equal stands before it. Keys, and what is wrong.
std::vector<std::pair<std::string, std::string>> errors(const std::vector<Oracles>& rows);

/// The titles of the rows whose group or title contains this, and of those that they should equal.
std::set<std::string> chosen_rows(const std::vector<Oracles>& rows, const std::string& only);

/// Outcome of such a case.
struct ExtremeRun {
  std::filesystem::path folder;
  std::optional<post::Summary> summary;  // of a run that ended well
  std::string refused, failed;           // messages
  double seconds = 0;
};

/// Verdict of an oracle on a row, and what the program did.
struct Verdict {
  std::string group, row, oracle, computed, expected;
  std::optional<double> deviation, allowed;
  bool holds = false;
  double seconds = 0;
  std::string message = {};  // of an error or a warning
};

/// Holds what a run came to against its oracles. `before`: the runs that it may have to equal, by their titles.
std::vector<Verdict> verdicts(const Oracles& row, const ExtremeRun& run,
                              const std::map<std::string, ExtremeRun>& before);

/// The rows of extremes.csv.
post::Table table(const std::vector<Verdict>& verdicts);

/// An aligned table: one line per verdict.
std::string to_text(const std::vector<Verdict>& verdicts);

}  // namespace cases
