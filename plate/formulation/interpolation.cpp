#include "plate/formulation/interpolation.hpp"

#include <fmt/format.h>

#include "geometry/cells/tessellation.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/model/dense_algebra.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/space.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plate {

std::vector<PlacedPoint> visible_from(const geometry::Point& at, double reach,
                                      const std::vector<geometry::Point>& points, std::size_t count,
                                      const std::vector<geometry::CrackPath>& cracks) {
  std::vector<PlacedPoint> result;
  for (std::uint32_t k = 0; k < count; ++k) {
    const geometry::Point& x = points[k];
    const auto part = [&](const auto& crack) { return geometry::separates(crack, at, x); };
    if ((x - at).norm() <= reach && std::ranges::none_of(cracks, part)) result.emplace_back(k, x);
  }
  return result;
}

std::vector<Share> interpolation(const std::vector<PlacedPoint>& points, const geometry::Point& at) {
  const auto count = static_cast<Eigen::Index>(points.size());
  if (count == 0) return {};
  Eigen::MatrixXd basis(count, 3);
  Eigen::VectorXd root(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [point, position] = points[static_cast<std::size_t>(i)];
    const geometry::Point x = position - at;
    if (x.squaredNorm() < 1e-12) return {{point, 1.0}};
    basis.row(i) << 1, x.x(), x.y();
    root[i] = 1 / x.norm();
  }
  const Eigen::MatrixXd inverse = pseudo_inverse(root.asDiagonal() * basis).inverse * root.asDiagonal();
  std::vector<Share> shares;
  for (Eigen::Index i = 0; i < count; ++i) shares.push_back({points[static_cast<std::size_t>(i)].first, inverse(0, i)});
  return shares;
}

namespace {

/// True where the shares reproduce all linear fields, by weights that do not enlarge what varies from point to point.
bool spans(const std::vector<Share>& shares, const std::vector<PlacedPoint>& points, const geometry::Point& at) {
  constexpr double largest = 3;  // beside a straight edge 1.5
  double sum = -1;
  geometry::Point moment(0, 0);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (!(std::abs(shares[i].weight) <= largest)) return false;
    sum += shares[i].weight, moment += shares[i].weight * (points[i].second - at);
  }
  return std::abs(sum) < 1e-9 && moment.norm() < 1e-9;
}

}  // namespace

std::vector<PlaceShare> place_shares(const std::vector<PlacedPoint>& points, const geometry::Point& at,
                                     double spacing) {
  if (points.empty()) throw std::invalid_argument("a place without points");
  const auto shares = interpolation(points, at);
  std::vector<PlaceShare> result;
  if (shares.size() < points.size() || spans(shares, points, at)) {
    for (const auto& [point, weight] : shares) result.push_back({point, weight});
    return result;
  }
  double sum = 0;
  for (const auto& [point, position] : points) {
    const geometry::Point way = at - position;
    const double weight = 1 / way.squaredNorm();
    sum += weight;
    result.push_back({point, weight, spacing * weight * way});
  }
  for (auto& share : result) share.weight /= sum, share.lever /= sum;
  return result;
}

std::vector<PlaceShare> visible_place(const geometry::Point& at, const geometry::LatticeUnits& units,
                                      const std::vector<geometry::Point>& points, std::size_t count,
                                      const std::vector<geometry::CrackPath>& cracks) {
  for (const double reach : {reach_of_places, 2 * reach_of_places})
    if (const auto near = visible_from(units.to_lattice(at), reach, points, count, cracks); !near.empty())
      return place_shares(near, units.to_units(at), units.spacing);
  throw Refused(
      {{Subject::geometry, 0,
        fmt::format("({:g}, {:g}) sees no point of the plate within {:g} spacings that no crack parts from it: "
                    "refine, or choose formulation = \"galerkin\"",
                    at.x(), at.y(), 2 * reach_of_places)}});
}

PointValues value_at(const std::vector<PlaceShare>& place, const State& state) {
  PointValues result = PointValues::Zero();
  for (const auto& [k, weight, lever] : place) {
    result += weight * state.col(k);
    if (lever != geometry::Point(0, 0)) result[0] += lever.y() * state(1, k) - lever.x() * state(2, k);
  }
  return result;
}

DofTerms terms_of(const std::vector<PlaceShare>& place, std::uint32_t component) {
  DofTerms result;
  for (const auto& [k, weight, lever] : place) {
    result.emplace_back(dof(k, component), weight);
    if (component > 0 || lever == geometry::Point(0, 0)) continue;
    result.emplace_back(dof(k, 1), lever.y());
    result.emplace_back(dof(k, 2), -lever.x());
  }
  return result;
}

std::vector<PlaceShare> interpolation(const geometry::CellLocator& cells, double spacing, const geometry::Point& at) {
  const auto found = cells(at + spacing * geometry::Point(1e-6, 1e-7), at);
  std::vector<PlaceShare> result;
  for (std::size_t i = 0; i < found.count; ++i) result.push_back({found.points[i], found.weights[i]});
  return result;
}

}  // namespace plate
