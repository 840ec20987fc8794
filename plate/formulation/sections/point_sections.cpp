#include "plate/formulation/sections/point_sections.hpp"

#include <fmt/format.h>

#include <array>

#include "geometry/cells/tessellation.hpp"
#include "plate/model/refused.hpp"

namespace plate {
namespace {

using geometry::Point;
using Corners = std::array<Point, 3>;

Point middle(const Corners& t) {
  return (t[0] + t[1] + t[2]) / 3;
}

/// Middles of the four parts of a triangle that its sides' middles make.
std::array<Point, 4> samples(const Corners& t) {
  const Point a = (t[1] + t[2]) / 2, b = (t[2] + t[0]) / 2, c = (t[0] + t[1]) / 2;
  return {middle({t[0], c, b}), middle({c, t[1], a}), middle({b, a, t[2]}), middle({a, b, c})};
}

LocalSection local(const Section& section, const Point& x) {
  const Section own = section.at(x);
  const auto refuse = [&](Subject subject, const char* words, double value) {
    throw Refused({{subject, 0,
                    fmt::format("the {} is {:.4g} at ({:.6g}, {:.6g}), must be > 0 and finite all over the "
                                "plate",
                                words, value, x.x(), x.y())}});
  };
  if (!(own.thickness > 0) || !std::isfinite(own.thickness))
    refuse(Subject::thickness_factor, "thickness", own.thickness);
  if (own.isotropic() && (!(own.young > 0) || !std::isfinite(own.young)))
    refuse(Subject::young_factor, "modulus", own.young);
  return own;
}

}  // namespace

PointSections::PointSections(const Section& section, const geometry::Tessellation& cells)
    : simple_(section.isotropic()) {
  if (section.uniform()) {
    kinds_.emplace_back(section);
    return;
  }
  kinds_.resize(cells.positions.size());
  std::vector<double> weight(kinds_.size(), 0);
  // the part of a triangle that is a corner's: between it, the middles of its sides and that of the triangle
  const auto add = [&](const geometry::Tessellation::Triangle& cell) {
    const Corners t{cells.positions[cell[0]], cells.positions[cell[1]], cells.positions[cell[2]]};
    const Point m = middle(t), side = t[1] - t[0], other = t[2] - t[0];
    const double part = std::abs(side.x() * other.y() - side.y() * other.x());
    for (std::size_t i = 0; i < 3; ++i) {
      const Point &own = t[i], next = (t[i] + t[(i + 1) % 3]) / 2, last = (t[i] + t[(i + 2) % 3]) / 2;
      for (const auto& half : {Corners{own, next, m}, Corners{own, m, last}})
        for (const auto& x : samples(half)) kinds_[cell[i]].add(local(section, x), part), weight[cell[i]] += part;
    }
  };
  for (const auto& [a, b, c, d] : cells.squares)  // along both diagonals, as families are; each half as much
    for (const auto& half : {geometry::Tessellation::Triangle{a, b, c}, {a, c, d}, {a, b, d}, {b, c, d}}) add(half);
  for (const auto& cell : cells.triangles) add(cell), add(cell);
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    LocalSection mean;
    mean.add(kinds_[k], 1 / weight[k]);
    kinds_[k] = mean;
  }
}

void PointSections::add_masses(const std::vector<double>& masses, const std::vector<double>& areas) {
  if (masses.empty()) return;
  if (uniform()) kinds_.assign(areas.size(), kinds_.front());
  for (std::size_t k = 0; k < areas.size(); ++k) kinds_[k].mass += masses[k] / areas[k];
}

}  // namespace plate
