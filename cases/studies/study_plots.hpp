#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cases/studies/study_table.hpp"
#include "post/report/curve_plot.hpp"

namespace cases {

/// Text of the plots of a study beside its numbers.
struct StudyTitles {
  std::string title;
  std::vector<std::string> axes;  // with units, where they are known
  bool si = false;                // all cases are in SI units
};

/// The plots of a study by the names of their files: error_against_seconds.svg and error_against_points.svg, and for
/// every axis whose labels are numbers QUANTITY_against_AXIS.svg with the computed values and the references. The
/// lines of errors run along the refinement; without one there are marks, in one look along the last axis. What has
/// nothing to show is left out.
std::map<std::string, post::CurvePlot> study_plots(const StudyTable& study, const StudyTitles& titles);

/// The number that a label is.
std::optional<double> number_of(const std::string& label);

}  // namespace cases
