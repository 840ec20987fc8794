#include "post/files/frame.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "post/factors/srif.hpp"
#include "post/files/data_arrays.hpp"
#include "post/files/vtk_series.hpp"

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

namespace {

/// Arrays of numbers with names, a row at a time.
template <std::size_t N>
class Columns {
public:
  explicit Columns(const std::array<const char*, N>& names) : names_(names) {}
  void add(const std::array<double, N>& row) {
    for (std::size_t i = 0; i < N; ++i) columns_[i].push_back(row[i]);
  }
  std::string text() const {
    std::string result;
    for (std::size_t i = 0; i < N; ++i) result += data_array(names_[i], columns_[i]);
    return result;
  }

private:
  std::array<const char*, N> names_;
  std::array<std::vector<double>, N> columns_;
};

/// Polylines of points that follow each other.
struct Polylines {
  std::vector<std::int64_t> points, ends;

  void add(std::int64_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) points.push_back(first + std::int64_t(i));
    ends.push_back(std::int64_t(points.size()));
  }
  std::string text() const { return data_array("connectivity", points) + data_array("offsets", ends); }
};

}  // namespace

std::string vtp(const Cracks& cracks) {
  constexpr double none = -1;
  std::vector<double> positions;
  Polylines lines, tips;
  Columns<2> of_cells({"crack", "tip"});  // those of vertices come first, as VTK counts cells
  Columns<5> of_points({"advance", "tip", "K1", "K2", "K3"});
  const auto points = [&] { return std::int64_t(positions.size() / 3); };
  for (const auto& tip : cracks.tips) of_cells.add({double(tip.crack), double(tip.number)});
  for (const auto& line : cracks.lines) {
    lines.add(points(), line.vertices.size());
    of_cells.add({double(&line - cracks.lines.data()), none});
    for (std::size_t i = 0; i < line.vertices.size(); ++i) {
      positions.insert(positions.end(), {line.vertices[i].x(), line.vertices[i].y(), 0});
      of_points.add({line.advances[i], none, NAN, NAN, NAN});
    }
  }
  for (const auto& tip : cracks.tips) {
    tips.add(points(), 1);
    positions.insert(positions.end(), {tip.position.x(), tip.position.y(), 0});
    const auto [K1, K2, K3] = tip.factors.value_or(std::array<double, 3>{NAN, NAN, NAN});
    of_points.add({0, double(tip.number), K1, K2, K3});
  }
  return vtk_file("PolyData",
                  fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\">\n"
                              "<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n<Points>\n{}</Points>\n"
                              "<Verts>\n{}</Verts>\n<Lines>\n{}</Lines>\n</Piece>\n",
                              points(), tips.ends.size(), lines.ends.size(), of_points.text(), of_cells.text(),
                              data_array("Points", positions, 3), tips.text(), lines.text()));
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
