#pragma once
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/outline.hpp"

namespace post {

/// A force along w and the moments about the x and y axes through the origin; sums of nodal forces.
struct Wrench {
  double force = 0;                   // [force]
  double moment_x = 0, moment_y = 0;  // [force length], as theta_x and theta_y turn

  Wrench& operator+=(const Wrench& other);
};

/// What supports do to a plate at an instant (theory (67), (68)).
struct Balance {
  std::vector<Wrench> supports;   // by every holder
  Wrench loads;                   // that act
  std::optional<Wrench> inertia;  // of a motion: mass times acceleration
  /// What is left of loads and reactions less inertia, relative to the sum of the sizes of all nodal loads or to the
  /// largest reaction or the inertia, whichever is most; moments over half the diagonal of the plate.
  double residual = 0;

  Wrench sum() const;  // of the supports
};

/// What edges and pins do to the plate, and its balance with the loads.
struct ReactionSummary {
  struct Support {
    std::string name;                         // of edges; of pins: pin0, pin1, ...
    std::optional<geometry::Point> position;  // of a pin
  };
  struct Largest {
    double time, force;
  };
  std::vector<Support> supports;
  double time = 0;               // of the last row; quasi-static growth: the number of the advance
  Balance balance;               // at this time
  double largest_residual = 0;   // of all rows
  std::vector<Largest> largest;  // force of every support, of all rows
  /// Estimated error of them by the truncation of Lanczos vectors, relative to the largest.
  std::optional<double> truncation = {};
};

}  // namespace post
