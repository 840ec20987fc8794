#include "post/files/vertices.hpp"

namespace post {

std::vector<geometry::Point> vertices(const plate::Mesh& mesh) {
  auto result = mesh.positions;
  for (const auto& corner : mesh.corners) result.push_back(corner.position);
  return result;
}

void continue_to_corners(const plate::Mesh& mesh, Eigen::Ref<Eigen::MatrixXd> values, CornerWeight weight) {
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    auto value = values.col(Eigen::Index(mesh.positions.size() + i));
    value.setZero();
    for (const auto& source : mesh.corners[i].sources) value += source.*weight * values.col(source.point);
  }
}

Eigen::MatrixXd at_vertices(const plate::Mesh& mesh, const Eigen::MatrixXd& values, CornerWeight weight) {
  Eigen::MatrixXd result(values.rows(), values.cols() + Eigen::Index(mesh.corners.size()));
  result.leftCols(values.cols()) = values;
  continue_to_corners(mesh, result, weight);
  return result;
}

}  // namespace post
