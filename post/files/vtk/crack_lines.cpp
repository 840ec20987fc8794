#include <fmt/format.h>

#include <cmath>

#include "post/files/vtk/crack_lines.hpp"
#include "post/files/vtk/data_arrays.hpp"
#include "post/files/vtk/series.hpp"

namespace post {
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

}  // namespace post
