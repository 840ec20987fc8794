#pragma once
#include "cases/studies/forms.hpp"
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

/// Runs of one case, or of a few, for error against run time: all combinations of the points of the axes, the first
/// axis outermost.
struct StudyPlan {
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

  std::vector<std::string> axis_names() const;
};

/// The keys of a study file; nothing is written from them.
Fields<StudyPlan> study_fields();

}  // namespace cases
