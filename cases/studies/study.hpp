#pragma once
#include <string>

#include "cases/input/case_file.hpp"
#include "cases/studies/plan.hpp"
#include "cases/studies/study_run.hpp"

namespace post {
struct Quantity;
}

namespace cases {

/// Reason why a run has no such quantity; empty where it has.
std::string lacking(const Case& c, const post::Quantity& quantity);

/// Run of a study: one point of every axis.
struct StudyRun {
  std::vector<std::string> labels;  // one per axis
  std::string folder;               // its name below the folder of the study; differs from that of every other run
  CaseFile file;
  std::vector<Wanted> wanted;  // in the order in which the references first name them
};

/// A plan with the runs that it asks for.
struct Study : StudyPlan {
  std::vector<StudyRun> runs;
};

/// The row of a run before it has run: labels, spacing, horizon.
StudyRow bare_row(const StudyRun& run);

/// Reads a study file and the cases of all its runs. A run has the overrides of the study, then those of its points in
/// the order of the axes; of two that give the same key, and of two points that choose a case file, the later prevails.
/// Throws CaseError with all problems of the study file and of all cases.
Study read_study(const std::filesystem::path& path);

/// Runs a study, a part of it, or merges its parts, as run_study() does with its jobs. Throws CaseError where another
/// process is at it.
StudyOutcome run_study(const Study& study, const StudyOptions& options);

}  // namespace cases
