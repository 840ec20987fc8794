#pragma once
#include "cases/studies/forms.hpp"
#include "post/studies/study.hpp"

namespace cases {

struct RunOptions;

/// A point of an axis: what is different in its runs.
struct AxisPoint {
  std::string label;
  std::optional<std::filesystem::path> case_file;
  std::vector<Setting> set;
};

struct Axis {
  std::string name, key;  // key: of the short form, which gives the values of one key; otherwise empty
  std::vector<AxisPoint> points;
};

/// One run of a study: one point of every axis.
struct StudyRun {
  std::vector<std::string> labels;  // one per axis
  std::string folder;               // its name below the folder of the study; differs from that of every other run
  CaseFile file;
  std::vector<post::Wanted> wanted;  // in the order in which the references first name them
};

/// Many runs of one case, or of a few, for error against run time: all combinations of the points of the axes, the
/// first axis outermost.
struct Study {
  std::string title, source;
  std::optional<std::filesystem::path> case_file;
  std::vector<Setting> set;  // of all runs
  std::vector<Axis> axes;
  std::vector<post::Reference> references;
  std::vector<StudyRun> runs;

  std::vector<std::string> axis_names() const;
};

/// The row of a run before it has run: labels, spacing, horizon.
post::StudyRow bare_row(const StudyRun& run);

/// Reads a study file and the cases of all its runs. A run has the overrides of the study, then those of its points in
/// the order of the axes; of two that give the same key, and of two points that choose a case file, the later prevails.
/// Throws CaseError with all problems of the study file and of all cases.
Study read_study(const std::filesystem::path& path);

struct StudyOutcome {
  post::StudyTable table;
  std::size_t wrong_cases = 0, failed_numbers = 0;  // runs that ended in CaseError, in plate::NumericalError
};

/// Runs a study: each run into a folder of its own; study.csv, orders.csv and the plots after every run. What fails
/// becomes a row with its message; other errors (disk full) end the study. A line per run, unless quiet; failures are
/// always said.
StudyOutcome run_study(const Study& study, const RunOptions& options);

}  // namespace cases
