#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace post {

/// The seconds of a run that was repeated: medians by stage, `total` among them, and the shortest and longest total.
struct Cost {
  std::size_t repeats = 0;
  std::vector<std::pair<std::string, double>> seconds = {};
  double least = 0, most = 0;
};

/// `seconds` of every repetition, by stage. Stages are those of the first.
Cost cost_of(const std::vector<std::vector<std::pair<std::string, double>>>& seconds);

/// What is known of a run of a study; a row of runs.csv.
struct RunRecord {
  std::string run, digest, version;  // its folder; of its settings; of the program
  std::string outcome, message = {};
  Cost cost = {};
};

/// runs.csv: what became of every run of a study, so that it can go on where it was ended.
class Ledger {
public:
  /// Takes what an earlier study left in `file`, as far as it can be read.
  explicit Ledger(std::filesystem::path file);

  /// The record of a run that is done, with the same settings, by the same program and at least so often.
  std::optional<RunRecord> done(const RunRecord& wanted, std::size_t repeats) const;
  /// Writes the file.
  void put(RunRecord record);
  /// Forgets a run, which is about to be made anew.
  void forget(const std::string& run);

private:
  void write() const;

  std::filesystem::path file_;
  std::vector<RunRecord> records_;
};

}  // namespace post
