#include <fmt/format.h>

#include <stdexcept>

#include "post/files/vertices.hpp"
#include "post/files/vtk/data_arrays.hpp"
#include "post/files/vtk/series.hpp"

namespace post {
namespace {

/// GridCells as VTK lists them: the points of all, where the points of each end, what each is.
struct GridCells {
  enum Type : std::uint8_t { vertex = 1, triangle = 5, quad = 9 };  // VTK's numbers
  std::vector<std::int64_t> points, ends;
  std::vector<std::uint8_t> types;

  void add(Type type, const auto& cell) {
    points.insert(points.end(), cell.begin(), cell.end());
    ends.push_back(std::int64_t(points.size()));
    types.push_back(type);
  }
};

/// Every point that no cell uses is a cell by itself, unless it is another process's.
GridCells cells_of(const Mesh& mesh) {
  GridCells cells;
  for (const auto& quad : mesh.quads) cells.add(GridCells::quad, quad);
  for (const auto& triangle : mesh.triangles) cells.add(GridCells::triangle, triangle);
  std::vector<bool> used(mesh.positions.size() + mesh.corners.size(), false);
  for (const auto k : cells.points) used.at(std::size_t(k)) = true;
  const auto own = mesh.positions.size() - mesh.others;
  for (std::size_t k = 0; k < used.size(); ++k)
    if (!used[k] && (k < own || k >= mesh.positions.size())) cells.add(GridCells::vertex, std::array{k});
  return cells;
}

/// Values of points, one row per component, with those of corners behind; throws where the points are not those of the
/// mesh.
template <typename Rows>
std::string point_data(const Mesh& mesh, const char* name, CornerWeight weight, const Eigen::MatrixBase<Rows>& rows) {
  if (const auto points = mesh.positions.size(); std::size_t(rows.cols()) != points)
    throw std::invalid_argument(fmt::format("{} has {} values for {} points", name, rows.cols(), points));
  const Eigen::MatrixXd values = at_vertices(mesh, rows, weight);
  return data_array(name, {values.data(), std::size_t(values.size())}, std::size_t(values.rows()));
}

Eigen::Map<const Eigen::RowVectorXd> field_row(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

std::string fields_of(const Mesh& mesh, const Frame& frame) {
  const auto& [moments, shear, von_mises] = frame.resultants;
  std::string text;
  const auto add = [&](const char* name, CornerWeight weight, const auto& rows) {
    text += point_data(mesh, name, weight, rows);
  };
  constexpr auto linear = &Mesh::Source::linear, mean = &Mesh::Source::mean;
  add("w", linear, frame.state.row(0));
  add("theta", linear, frame.state.bottomRows<2>());
  add("damage", mean, field_row(frame.damage));
  add("cut", mean, field_row(mesh.cut));
  add("Mxx", mean, moments.row(0));
  add("Myy", mean, moments.row(1));
  add("Mxy", mean, moments.row(2));
  add("Qx", mean, shear.row(0));
  add("Qy", mean, shear.row(1));
  add("von_mises", mean, von_mises.transpose());
  Eigen::Matrix3Xd displacement = Eigen::Matrix3Xd::Zero(3, frame.state.cols());
  displacement.row(2) = frame.state.row(0);
  add("displacement", linear, displacement);
  return text;
}

}  // namespace

std::string vtu(const Mesh& mesh, const Frame& frame) {
  const auto all = vertices(mesh);
  std::vector<double> positions;
  positions.reserve(3 * all.size());
  for (const auto& x : all) positions.insert(positions.end(), {x.x(), x.y(), 0});
  const auto cells = cells_of(mesh);
  return vtk_file(
      "UnstructuredGrid",
      fmt::format("<FieldData>\n{}</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
                  "<PointData>\n{}</PointData>\n<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n</Piece>\n",
                  data_array("TimeValue", std::array{frame.time}), all.size(), cells.types.size(),
                  fields_of(mesh, frame), data_array("Points", positions, 3), data_array("connectivity", cells.points),
                  data_array("offsets", cells.ends), data_array("types", cells.types)));
}

}  // namespace post
