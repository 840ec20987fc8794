#pragma once
#include <memory>
#include <optional>
#include <string>

#include "post/files/frame.hpp"

namespace post {

class Raster;

/// The fields of a run as pictures for its report: all of the last frame, and w, von Mises stress and damage of a few
/// before it, spread over the run. However many points and frames there are, the pictures take the same room.
class Pictures {
public:
  Pictures();
  ~Pictures();

  /// The cells of the frames from now on.
  void open(const Mesh& mesh);
  /// Takes what is wanted of a frame.
  void look(const Frame& frame);

  /// As JSON, "null" without frames: `frames`, each with its `time`, `columns`, `rows`, `pitch`, `corner` and `data`,
  /// per field the 16 bits of each pixel in base64; `fields`, each with its `name`, its `least` and `largest` value at
  /// any point of the last frame, the `range` of colours between the percentiles `shares` of all frames, and the values
  /// `low` and `high` of the codes 1 and 65535. Code 0 is no plate.
  std::string json() const;

  /// What has been looked at; the cells are opened again.
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
