#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "post/studies/plots.hpp"
#include "post/studies/runs/isolated.hpp"
#include "post/studies/runs/ledger.hpp"
#include "post/studies/runs/parts.hpp"

namespace post {

/// A run of a study, and how it is made.
struct StudyJob {
  RunRecord wanted;  // as it would be were it done; without cost
  StudyRow row;      // before it has run: labels, spacing, horizon
  std::vector<Wanted> quantities;
  std::uint64_t weight;        // beside the others: see `weight`
  std::function<Ended()> run;  // into the folder `wanted.run` below that of the study
};

struct StudyJobs {
  StudyTitles titles;
  std::vector<std::string> axes;  // without units
  std::vector<StudyJob> jobs;
  std::size_t repeats;
};

struct StudyOptions {
  std::filesystem::path folder;  // one folder per run, and the tables
  bool quiet = false;
  bool again = false;             // makes runs anew that are done already
  std::optional<Part> part = {};  // makes these runs alone, and no tables
  bool merge = false;             // makes no run: tables of what there is
};

struct StudyOutcome {
  StudyTable table;
  std::size_t wrong_cases = 0, failed_numbers = 0, killed = 0;  // runs by what ended them
  std::size_t missing = 0;                                      // to be made yet
};

/// Another process is at the same work, or there is nothing to merge.
class StudyRefused : public std::runtime_error {
public:
  StudyRefused(std::string of, std::string given, const std::string& what)
      : runtime_error(what), option(std::move(of)), value(std::move(given)) {}
  std::string option, value;  // of the command line
};

/// Makes the runs of a study, each in a process and into a folder of its own, unless it is done already, with the same
/// settings and by the same program; after every run study.csv, study.json, orders.csv, runs.csv and the plots. With a
/// part, those of its share, and no tables: parts work side by side in one folder, on several machines too. A run that
/// another process makes is waited for. With `merge` no run, and the tables of those that are done; one that is not,
/// or not with these settings, is a row with the outcome `missing`.
/// A run that is refused, fails or is killed becomes a row with its message; other errors (disk full) end the study.
/// A line per run, unless quiet; failures are always said. Throws StudyRefused, plate::Interrupted.
StudyOutcome run_study(const StudyJobs& study, const StudyOptions& options);

}  // namespace post
