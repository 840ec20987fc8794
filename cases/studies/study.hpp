#pragma once
#include "cases/input/case_file.hpp"
#include "cases/studies/plan.hpp"

namespace cases {

/// One run of a study: one point of every axis.
struct StudyRun {
  std::vector<std::string> labels;  // one per axis
  std::string folder;               // its name below the folder of the study; differs from that of every other run
  CaseFile file;
  std::vector<post::Wanted> wanted;  // in the order in which the references first name them
};

/// A plan with the runs that it asks for.
struct Study : StudyPlan {
  std::vector<StudyRun> runs;
};

/// The row of a run before it has run: labels, spacing, horizon.
post::StudyRow bare_row(const StudyRun& run);

/// Reads a study file and the cases of all its runs. A run has the overrides of the study, then those of its points in
/// the order of the axes; of two that give the same key, and of two points that choose a case file, the later prevails.
/// Throws CaseError with all problems of the study file and of all cases.
Study read_study(const std::filesystem::path& path);

struct StudyOptions {
  std::filesystem::path folder;  // one folder per run, and the tables
  bool quiet = false;
  bool again = false;  // makes runs anew that are done already
};

struct StudyOutcome {
  post::StudyTable table;
  std::size_t wrong_cases = 0, failed_numbers = 0, killed = 0;  // runs by what ended them
};

/// Runs a study: each run in a process and into a folder of its own, unless it is done already, with the same settings
/// and by the same program; study.csv, study.json, orders.csv, runs.csv and the plots after every run. A run that is
/// refused, fails or is killed becomes a row with its message; other errors (disk full) end the study. A line per run,
/// unless quiet; failures are always said.
StudyOutcome run_study(const Study& study, const StudyOptions& options);

}  // namespace cases
