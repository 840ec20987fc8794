#pragma once
#include <array>
#include <optional>
#include <vector>
#include "geometry/shape/crack_path.hpp"

namespace post {

struct Srif;

/// A crack as a polyline.
struct CrackLine {
  std::vector<Eigen::Vector2d> vertices;  // [length]
  std::vector<double> advances;           // at which a vertex was reached
};

struct CrackTip {
  std::size_t number, crack;
  geometry::Point position;                           // [length]
  std::optional<std::array<double, 3>> factors = {};  // K1, K2, K3
};

/// Cracks at an instant, as they are drawn.
struct Cracks {
  std::vector<CrackLine> lines;
  std::vector<CrackTip> tips;
};

/// Cracks that were there from the start.
Cracks given_cracks(const std::vector<geometry::CrackPath>& paths);

/// The intensity factors of the tips: of each the first.
void set_factors(Cracks& cracks, const std::vector<Srif>& factors);

}  // namespace post
