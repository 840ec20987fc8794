#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cases {

/// Outcome of a run of a study: it is done; its case is refused; its numbers failed; the user ended it; a signal ended
/// its process; its record is missing; the machine failed (no memory, disk full), which ends the study.
enum class RunOutcome { done, refused, failed, interrupted, killed, missing, broken };
/// Name of an outcome in files and tables.
const char* name_of(RunOutcome outcome);
/// Outcome of a name; none of any other text.
std::optional<RunOutcome> run_outcome(std::string_view name);

/// The seconds of a run that was repeated: medians by stage, `total` among them, and the shortest and longest total.
struct Cost {
  std::size_t repeats = 0;
  std::vector<std::pair<std::string, double>> seconds = {};
  double least = 0, most = 0;
};

/// `seconds` of every repetition, by stage. Stages are those of the first.
Cost cost_of(const std::vector<std::vector<std::pair<std::string, double>>>& seconds);

/// Record of a run of a study; a row of runs.csv.
struct RunRecord {
  std::string run, digest, version;  // its folder; of its settings; of the program
  RunOutcome outcome = RunOutcome::done;
  std::string message = {};
  Cost cost = {};
};

/// Ledger of the outcomes of all runs of a study, so that it can go on where it was ended: a file for each, so that
/// processes on several machines keep one ledger. One process at a time writes the file of a run (NamedLock); readers
/// find a file whole.
class Ledger {
public:
  /// Constructs a ledger in a separate folder below that of the study, whose name no run has (plain_name).
  explicit Ledger(const std::filesystem::path& study) : folder_(study / ".runs") {}

  /// Record of a run; none where there is no record or it is damaged, even by one bit.
  std::optional<RunRecord> known(const std::string& run) const;
  /// The record of a run that is done, with the same settings, by the same program and at least so often.
  std::optional<RunRecord> done(const RunRecord& wanted, std::size_t repeats) const;
  void put(const RunRecord& record) const;
  /// Forgets a run, which is about to be made anew.
  void forget(const std::string& run) const { std::filesystem::remove(file_of(run)); }

  /// The file of the locks of its writers.
  std::filesystem::path locks() const { return folder_ / "locks"; }

private:
  std::filesystem::path file_of(const std::string& run) const { return folder_ / (run + ".csv"); }

  std::filesystem::path folder_;
};

/// True where a run has been made by the program that is wanted, or by that of another instruction set beside it. A
/// package holds several, of which every processor takes its own: they differ by rounding.
bool same_program(const RunRecord& record, const RunRecord& wanted);

/// Writes runs.csv: a row and a line for each record.
void write_records(const std::filesystem::path& file, std::vector<RunRecord> records);

}  // namespace cases
