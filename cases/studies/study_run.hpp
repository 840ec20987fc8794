#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/studies/isolated_runs.hpp"
#include "cases/studies/ledger.hpp"
#include "cases/studies/study_plots.hpp"

namespace cases {

/// A share of the runs of a study: the `number`-th, from 1, of `of`.
struct StudyPart {
  std::size_t number = 1, of = 1;

  std::string text() const { return std::to_string(number) + "/" + std::to_string(of); }
};

/// "3/16": decimal digits, 1 <= 3 <= 16 <= 10,000; nothing where it is none.
std::optional<StudyPart> part_of(const std::string& text);

/// Describes the error in the text of a part; empty where there is none.
std::string wrong_part(const std::string& text);

/// The runs of a part, as indices in rising order: the dearest first, each to the part that has least to do so far, of
/// equals the first. Whole numbers, so that all machines find the same shares; every run is in one of them.
std::vector<std::size_t> share(const std::vector<std::uint64_t>& weights, const StudyPart& part);

/// Estimated cost of a run beside others of its study: (sqrt(area) / spacing)^3, the points of an even plate times its
/// iterations or steps, which go with the points across it. `area` [length^2], `spacing` [length].
std::uint64_t weight(double area, double spacing);

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
  bool again = false;                  // makes runs anew that are done already
  std::optional<StudyPart> part = {};  // makes these runs alone, and no tables
  bool merge = false;                  // makes no run: tables of what there is
};

struct StudyOutcome {
  StudyTable table;
  std::size_t wrong_cases = 0, failed_numbers = 0, killed = 0;  // runs by what ended them
  std::size_t missing = 0;                                      // to be made yet
};

/// Thrown where another process does the same work, or where there is nothing to merge.
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

}  // namespace cases
