#pragma once
#include <vector>

#include "plate/model/loads.hpp"

namespace plate {

struct Problem;

/// How a load of the kind settlement moves a support: as a rigid body, and every edge about itself.
struct SupportMotion {
  std::size_t load, support;  // their numbers

  double deflection = 0;  // w of the body [length] at `from`
  geometry::Point slope{0, 0}, from{0, 0};
  double rotation = 0;  // psi_n of an edge, n its outward normal

  /// w, theta_x, theta_y of the body at a place.
  Eigen::Vector3d at(const geometry::Point& x) const;
  /// The same of what goes with an edge: `beyond` it [length], where `outward` is its normal.
  Eigen::Vector3d at(const geometry::Point& x, const geometry::Point& outward, double beyond) const;
};

/// Of all loads at factor 1.
std::vector<SupportMotion> support_motions(const Problem& problem);

}  // namespace plate
