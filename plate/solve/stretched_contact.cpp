#include "plate/solve/stretched_contact.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "plate/solve/complementarity.hpp"
#include "plate/solve/large_deflections.hpp"

namespace plate {

StretchedContact::StretchedContact(const Formulation& plate, const MiddlePlane& plane)
    : points_(plate.points()),
      plane_(plane),
      rows_(plate),
      of_plane_(rows_.compliance(points_, [&](const auto& loads) { return plane.solve(loads); })) {
  lifted_ = lift_compliance(of_plane_);
}

Eigen::VectorXd StretchedContact::part(const State& bending, State& membrane, const Eigen::VectorXd& like) const {
  const auto count = rows_.arms().size();
  const Eigen::VectorXd openings = rows_.openings(bending, membrane);
  const Eigen::VectorXd slopes = (openings.head(count) - openings.tail(count)) / 2;
  const double error = rows_.error_of_openings(bending, membrane);
  // about `like`, so that what the compliance has more than the plane does nothing where nothing changes
  const Eigen::VectorXd least =
      openings.head(count).cwiseMin(openings.tail(count)) - lifted_ * (like.head(count) + like.tail(count));
  const Complementarity found(of_plane_, (least.array().abs() > error).select(least, 0));
  Eigen::VectorXd result = Eigen::VectorXd::Zero(2 * count);
  if (found.x.isZero(0)) return result;
  Forces ignored = zero_forces(points_), load = zero_forces(points_);
  rows_.press(found.x.replicate(2, 1) / 2, ignored, load);
  membrane += plane_.solve({load}).front();
  const double straight = error / 10;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double both = like[i] + like[count + i];
    double at_top = slopes[i] > 0 ? 0 : 1;
    if (std::abs(slopes[i]) <= straight) at_top = both > 0 ? like[i] / both : 0.5;
    result[i] = at_top * found.x[i], result[count + i] = (1 - at_top) * found.x[i];
  }
  return result;
}

/// Takes in the rows that are closed and, one set after the other, those that overlap without being among them.
Eigen::VectorXd StretchedContact::forces(const Tangent& tangent, const Solutions& solutions) const {
  constexpr double rounding = 1e-10;
  const auto& [bending, membrane, before, kept, apart] = tangent;
  const double error = rows_.error_of_openings(bending, membrane);
  const Eigen::VectorXd free = rows_.openings(bending, membrane);
  const auto has = [](const std::vector<char>& set, Eigen::Index i) { return !set.empty() && set[std::size_t(i)]; };
  std::vector<Eigen::Index> rows;
  std::vector<char> taken(std::size_t(free.size()), 0);
  const auto take = [&](Eigen::Index i) { rows.push_back(i), taken[std::size_t(i)] = 1; };
  for (Eigen::Index i = 0; i < free.size(); ++i)
    if (before[i] > 0 || has(kept, i) || (free[i] < -error && !has(apart, i))) take(i);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(free.size());
  Eigen::MatrixXd of_rows(free.size(), 0);
  for (std::size_t known = 0; known < rows.size();) {
    const auto added = rows_.columns(std::span(rows).subspan(known), points_, solutions);
    of_rows.conservativeResize(Eigen::NoChange, Eigen::Index(rows.size()));
    of_rows.rightCols(added.cols()) = added, known = rows.size();
    Eigen::MatrixXd C = of_rows(rows, Eigen::all);
    C = (C + C.transpose()).eval() / 2;
    const double lifted = lift_compliance(C);
    const Eigen::VectorXd openings = free - of_rows * before(rows);
    Eigen::VectorXd c = openings(rows) - lifted * before(rows);
    c = (c.array().abs() > error).select(c, 0);
    std::vector<char> closed;
    for (const auto i : rows)
      if (!kept.empty()) closed.push_back(kept[std::size_t(i)]);
    const Complementarity found(C, c, closed);
    result.setZero(), result(rows) = found.x;
    const Eigen::VectorXd rest = openings + of_rows * found.x;
    const double overlap = std::max(error, rounding * c.cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < rest.size(); ++i)
      if (!taken[std::size_t(i)] && !has(apart, i) && rest[i] < -overlap) take(i);
  }
  return result;
}

}  // namespace plate
