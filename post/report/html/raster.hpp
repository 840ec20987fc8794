#pragma once
#include <cstdint>
#include <vector>

#include "plate/formulation/mesh.hpp"

namespace post {

/// The cells of a plate as pixels, however many points it has: which three vertices a pixel has its value from. Pixels
/// whose middle is just beyond the cells have that of a neighbour inside.
class Raster {
public:
  /// About so many pixels, square.
  Raster(const plate::Mesh& mesh, std::size_t pixels);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  double pitch() const { return pitch_; }                 // [length]
  const geometry::Point& corner() const { return low_; }  // lower left, of the first pixel [length]

  /// Values of the vertices of the mesh, an array or one row of a matrix, as values of pixels, row by row from below;
  /// not a number where there is no plate.
  template <typename Values>
  std::vector<float> pixels(const Values& values) const {
    std::vector<float> result;
    result.reserve(sources_.size());
    for (const auto& [a, b, c, of_b, of_c] : sources_) {
      if (a == nowhere) {
        result.push_back(NAN);
        continue;
      }
      const double at_a = values[a];
      result.push_back(float(at_a + of_b * (values[b] - at_a) + of_c * (values[c] - at_a)));
    }
    return result;
  }

private:
  static constexpr auto nowhere = std::uint32_t(-1);
  struct Source {
    std::uint32_t a = nowhere, b = 0, c = 0;
    float of_b = 0, of_c = 0;
  };
  using Triangle = std::array<std::uint32_t, 3>;

  void draw(const std::vector<geometry::Point>& points, const Triangle& triangle);
  void widen();

  geometry::Point low_;
  double pitch_;
  std::size_t columns_, rows_;
  std::vector<Source> sources_;  // of every pixel
};

}  // namespace post
