#include "post/files/frame.hpp"

#include <algorithm>
#include <limits>

#include "post/factors/srif.hpp"

namespace post {

std::vector<geometry::Point> vertices(const plate::Mesh& mesh) {
  auto result = mesh.positions;
  for (const auto& corner : mesh.corners) result.push_back(corner.position);
  return result;
}

Eigen::MatrixXd at_vertices(const plate::Mesh& mesh, const Eigen::MatrixXd& values, CornerWeight weight) {
  Eigen::MatrixXd result(values.rows(), values.cols() + Eigen::Index(mesh.corners.size()));
  result.leftCols(values.cols()) = values;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    auto value = result.col(Eigen::Index(mesh.positions.size() + i));
    value.setZero();
    for (const auto& source : mesh.corners[i].sources) value += source.*weight * result.col(source.point);
  }
  return result;
}

Cracks given_cracks(const std::vector<geometry::CrackPath>& paths) {
  Cracks result;
  for (const auto& path : paths) result.lines.push_back({path.vertices, std::vector<double>(path.vertices.size(), 0)});
  for (const auto& tip : geometry::tips(paths)) result.tips.push_back({result.tips.size(), tip.crack, tip.position});
  return result;
}

void set_factors(Cracks& cracks, const std::vector<Srif>& factors) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (auto& tip : cracks.tips) {
    const auto found = std::ranges::find(factors, tip.number, &Srif::tip);
    if (found == factors.end()) continue;
    const auto& is = found->resolved;
    tip.factors = {is[0] ? found->K1 : none, is[1] ? found->K2 : none, is[2] ? found->K3 : none};
  }
}

}  // namespace post
