#include "post/report/html/raster.hpp"

#include <algorithm>
#include <cmath>

#include "post/files/vertices.hpp"

namespace post {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Lower left and upper right corner.
std::pair<geometry::Point, geometry::Point> box(const std::vector<geometry::Point>& points) {
  geometry::Point low = points.front(), high = low;
  for (const auto& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return {low, high};
}

}  // namespace

Raster::Raster(const plate::Mesh& mesh, std::size_t pixels) {
  const auto points = vertices(mesh);
  const auto [low, high] = box(points);
  const geometry::Point size = high - low;
  low_ = low;
  pitch_ = std::sqrt(size.x() * size.y() / double(pixels));
  pitch_ = std::max(pitch_, size.maxCoeff() / double(pixels));  // of a plate as thin as a line
  columns_ = std::size_t(std::ceil(size.x() / pitch_)), rows_ = std::size_t(std::ceil(size.y() / pitch_));
  sources_.resize(columns_ * rows_);
  for (const auto& q : mesh.quads) draw(points, {q[0], q[1], q[2]}), draw(points, {q[0], q[2], q[3]});
  for (const auto& t : mesh.triangles) draw(points, t);
  widen();
}

void Raster::draw(const std::vector<geometry::Point>& points, const Triangle& triangle) {
  std::array<Eigen::Vector2d, 3> x;  // in pixels
  for (std::size_t i = 0; i < 3; ++i) x[i] = (points[triangle[i]] - low_) / pitch_;
  const Eigen::Vector2d to_b = x[1] - x[0], to_c = x[2] - x[0];
  const double area = cross(to_b, to_c);
  if (area == 0) return;
  const Eigen::Vector2d least = x[0].cwiseMin(x[1]).cwiseMin(x[2]), most = x[0].cwiseMax(x[1]).cwiseMax(x[2]);
  constexpr double middle = 0.5, slack = 1e-9;  // a pixel between two triangles belongs to one of them at least
  const auto from = [](double at) { return std::ptrdiff_t(std::ceil(std::max(at - middle, 0.0))); };
  const auto to = [](double at, std::size_t size) {
    return std::min(std::ptrdiff_t(at - middle), std::ptrdiff_t(size) - 1);
  };
  for (auto j = from(least.y()); j <= to(most.y(), rows_); ++j)
    for (auto i = from(least.x()); i <= to(most.x(), columns_); ++i) {
      const Eigen::Vector2d at = Eigen::Vector2d(double(i) + middle, double(j) + middle) - x[0];
      const double of_b = cross(at, to_c) / area, of_c = cross(to_b, at) / area;
      if (of_b < -slack || of_c < -slack || of_b + of_c > 1 + slack) continue;
      sources_[std::size_t(j) * columns_ + std::size_t(i)] = {triangle[0], triangle[1], triangle[2], float(of_b),
                                                              float(of_c)};
    }
}

void Raster::widen() {
  const auto inside = sources_;
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    if (inside[k].a != nowhere) continue;
    const auto column = k % columns_, row = k / columns_;
    for (auto j = row > 0 ? row - 1 : row; j <= std::min(row + 1, rows_ - 1); ++j)
      for (auto i = column > 0 ? column - 1 : column; i <= std::min(column + 1, columns_ - 1); ++i)
        if (const auto& beside = inside[j * columns_ + i]; beside.a != nowhere) sources_[k] = beside;
  }
}

}  // namespace post
