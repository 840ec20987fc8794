#pragma once
#include <vector>

#include "plate/model/section.hpp"

namespace geometry {
struct Tessellation;
}

namespace plate {

/// The section about every point of a plate: one for all where it is the same everywhere.
class PointSections {
public:
  /// Of a section that is the same everywhere.
  PointSections(const Section& section) : simple_(section.isotropic()), kinds_{LocalSection(section)} {}
  /// Means over the parts of the cells that belong to each point. Throws Refused where a factor is not above 0.
  PointSections(const Section& section, const geometry::Tessellation& cells);

  const LocalSection& operator[](std::size_t k) const { return kinds_[uniform() ? 0 : k]; }
  bool uniform() const { return kinds_.size() == 1; }
  /// The same everywhere and without directions?
  bool simple() const { return simple_ && uniform(); }
  /// Mass that points carry beside that of the plate [mass]. `areas`: of the points.
  void add_masses(const std::vector<double>& masses, const std::vector<double>& areas);
  std::size_t bytes() const { return uniform() ? 0 : kinds_.size() * sizeof(LocalSection); }

private:
  bool simple_;
  std::vector<LocalSection> kinds_;
};

}  // namespace plate
