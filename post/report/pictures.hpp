#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plate/formulation/mesh.hpp"
#include "post/files/frame.hpp"

namespace post {

/// The cells of a plate as pixels, however many points it has: which three vertices a pixel has its value from. Pixels
/// whose middle is just beyond the cells have that of a neighbour inside.
class Raster {
public:
  /// Constructs a raster of about so many pixels, square.
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

/// The fields of a run as pictures for its report: all of the last frame (of load cases that which governs), and w, von
/// Mises stress and damage of a few before it, spread over the run. However many points and frames there are, the
/// pictures take the same room.
class Pictures {
public:
  Pictures();
  ~Pictures();

  /// The cells of the frames from now on.
  void open(const Mesh& mesh);
  /// Takes what is wanted of a frame; `last`: in the place of the last one, of which all fields are kept.
  void look(const Frame& frame, bool last = true);

  /// Returns JSON, "null" without frames: `frames`, each with its `time`, `columns`, `rows`, `pitch`, `corner` and
  /// `data`, per field the 16 bits of each pixel in base64; `fields`, each with its `name`, its `least` and `largest`
  /// value at any point of the last frame, the `range` of colours between the percentiles `shares` of all frames, and
  /// the values `low` and `high` of the codes 1 and 65535. Code 0 is no plate.
  std::string json() const;

  /// Saves or restores the frames taken so far; the cells are opened again.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(earlier_, last_, frames_, stride_);
  }

private:
  struct Field {
    std::string name;
    std::vector<float> pixels;
    double least = 0, largest = 0;  // of the points

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(name, pixels, least, largest);
    }
  };
  struct Picture {
    std::size_t number;
    double time;
    std::size_t columns, rows;
    double pitch;
    geometry::Point corner;
    std::vector<Field> fields;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(number, time, columns, rows, pitch, corner, fields);
    }
  };
  struct Scale;

  Picture picture(const Frame& frame) const;
  Scale scale_of(const Field& field) const;

  Mesh mesh_;
  std::unique_ptr<Raster> raster_;
  std::vector<Picture> earlier_;
  std::optional<Picture> last_;
  std::size_t frames_ = 0, stride_ = 1;
};

}  // namespace post
