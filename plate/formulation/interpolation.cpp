#include "plate/formulation/interpolation.hpp"

#include "geometry/cells/locator.hpp"
#include "plate/model/algebra/dense.hpp"

#include <algorithm>

namespace plate {

std::vector<PlacedPoint> seen_from(const geometry::Point& at, double reach, const std::vector<geometry::Point>& points,
                                   std::size_t count, const std::vector<geometry::CrackPath>& cracks) {
  std::vector<PlacedPoint> result;
  for (std::uint32_t k = 0; k < count; ++k) {
    const geometry::Point& x = points[k];
    const auto part = [&](const auto& crack) { return geometry::severs(crack, at, x); };
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

std::vector<Share> interpolation(const geometry::CellLocator& cells, double spacing, const geometry::Point& at) {
  const auto found = cells(at + spacing * geometry::Point(1e-6, 1e-7), at);
  std::vector<Share> result;
  for (std::size_t i = 0; i < found.count; ++i) result.push_back({found.points[i], found.weights[i]});
  return result;
}

}  // namespace plate
