#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/case_file.hpp"
#include "cases/studies/forms.hpp"
#include "cases/studies/ledger.hpp"
#include "cases/studies/study_table.hpp"

namespace cases {

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

/// Run of a study: one point of every axis.
struct StudyRun {
  std::vector<std::string> labels;  // one per axis
  std::string folder;               // its name below the folder of the study; differs from that of every other run
  CaseFile file;
  std::vector<Wanted> wanted;  // in the order in which the references first name them
  RunRecord record;            // as it would be were it done; without cost
};

/// Runs of one case, or of a few, for error against run time: all combinations of the points of the axes, the first
/// axis outermost.
struct Study {
  /// A quantity that is listed for every run that has it, with a reference or without.
  struct Listed {
    post::Quantity quantity;
  };

  std::string title, source;
  std::optional<std::filesystem::path> case_file;
  std::vector<Setting> set;  // of all runs
  std::vector<Axis> axes;
  std::vector<Listed> quantities;
  std::vector<Reference> references;
  std::size_t repeats = 1;  // of every run, for the spread of its time
  std::vector<StudyRun> runs;

  std::vector<std::string> axis_names() const;
};

/// Reason why a run has no such quantity; empty where it has.
std::string lacking(const Case& c, const post::Quantity& quantity);

/// Reads a study file and the cases of all its runs. A run has the overrides of the study, then those of its points in
/// the order of the axes; of two that give the same key, and of two points that choose a case file, the later prevails.
/// Throws CaseError with all problems of the study file and of all cases.
Study read_study(const std::filesystem::path& path);

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

/// Row of a run before it has run: labels, spacing, horizon.
StudyRow bare_row(const StudyRun& run);

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

/// Makes the runs of a study, each in a process and into a folder of its own, unless it is done already, with the same
/// settings and by the same program; after every run study.csv, study.json, orders.csv, runs.csv and the plots. With a
/// part, those of its share, and no tables: parts work side by side in one folder, on several machines too. A run that
/// another process makes is waited for. With `merge` no run, and the tables of those that are done; one that is not,
/// or not with these settings, is a row with the outcome `missing`.
/// A run that is refused, fails or is killed becomes a row with its message; other errors (disk full) end the study.
/// A line per run, unless quiet; failures are always said. Throws CaseError where another process does the same work,
/// or where there is nothing to merge, and plate::Interrupted.
StudyOutcome run_study(const Study& study, const StudyOptions& options);

}  // namespace cases
