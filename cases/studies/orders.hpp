#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cases/studies/study_table.hpp"

namespace cases {

/// The axis along which the points become finer, and by which length that is measured.
struct Refinement {
  std::size_t axis;
  bool by_horizon = false;  // the spacing stays and the horizon changes

  std::optional<double> length(const StudyRow& row) const { return by_horizon ? row.horizon : row.spacing; }
};

/// The first axis along which the spacing changes while the labels of all others stay, or else the first along which
/// the horizon does; nothing where neither changes.
std::optional<Refinement> refinement(const std::vector<StudyRow>& rows);

/// The rows of one quantity along one axis.
struct StudyLine {
  StudyRow first;                 // for its labels, those of the other axes; quantity, place, method
  std::vector<std::size_t> rows;  // as indices, in their order
};

/// Groups all rows of quantities into lines along an axis, or each row into a line; in the order of their first rows.
std::vector<StudyLine> lines(const std::vector<StudyRow>& rows, std::optional<std::size_t> axis);

/// Gives the rows that are `against_finest` their reference: of their line along the refinement the row of least
/// spacing, of several such that of most points. That row itself has none. Rows that failed do not count.
void refer_to_finest(StudyTable& study);

/// Order of convergence of the errors of a line: least squares through log |error|.
struct Order {
  StudyRow line;                  // for its labels, those of the other axes; quantity, place, method
  std::size_t runs = 0;           // with an error other than zero
  std::optional<double> order;    // |error| ~ length^order
  std::optional<double> misfit;   // rms distance of log10 |error| from that [decades]
  std::optional<double> seconds;  // |error| ~ seconds^this, of the run in total
};

/// Convergence of all lines along the refinement that have an error in two runs or more, with an order from three runs
/// on; none without a refinement.
std::vector<Order> orders(const StudyTable& study);

/// The columns of orders.csv behind those of the other axes.
const std::vector<std::string>& order_columns();

/// The rows of orders.csv; `against` says whether by spacing or by horizon.
post::Table orders_table(const StudyTable& study);

/// Returns orders_table() as aligned text.
std::string orders_text(const StudyTable& study);

/// Least squares: y = y0 + slope x. Nothing for fewer than two different x.
struct Slope {
  double slope, misfit;  // misfit: rms distance from the line
};
std::optional<Slope> slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace cases
