#pragma once
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "geometry/shape/outline.hpp"

namespace plate {

/// A pressure by its values at places, from a CSV text with the columns x, y and pressure: bilinear between the places
/// of a grid in any order, else linear on the triangles of Delaunay.
class PressureTable {
public:
  PressureTable() = default;
  /// `content`: of the file. Throws std::invalid_argument: what is wrong, with the number of the line.
  PressureTable(const std::string& content, const std::filesystem::path& file);

  bool given() const { return bool(values_); }
  const std::filesystem::path& file() const;
  /// Of the content, 16 digits.
  const std::string& digest() const;
  bool gridded() const;
  /// Times a factor.
  PressureTable times(double factor) const;

  bool reaches(const geometry::Point& x) const;
  /// [force/length^2]; beyond its places what it has at the next of them.
  double operator()(const geometry::Point& x) const;

private:
  struct Values;
  std::shared_ptr<const Values> values_;
  double factor_ = 1;
};

}  // namespace plate
