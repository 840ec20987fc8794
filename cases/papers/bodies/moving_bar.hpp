#pragma once
#include <Eigen/Core>
#include <vector>

/// The bar of ScaDyn: 1 m long, held at 0, free at its end, set free with a hump 0.02 m high in its middle; 1000 nodes,
/// horizon 0.1 m, speed of waves 5000 m/s.
namespace boundary_bodies {

constexpr int moving_bar_nodes = 1000;
constexpr double moving_bar_spacing = 0.001, moving_bar_step = 2e-7;  // [m], [s]

/// Displacement at x before the motion [m].
double moving_bar_hump(double x);

/// Displacements of the nodes at a time [s]: ScaDyn 7 to m = 80 [m].
Eigen::VectorXd moving_bar_series(double time);

/// Nodes beyond the ends of the bar.
enum class BarEnds {
  bare,       ///< no fictitious nodes, the first node held
  surface,    ///< fictitious nodes about surface nodes (ScaDyn 4, 5)
  multiplied  ///< fictitious nodes about real nodes, conditions held by multipliers (Sca21)
};

/// Way to compute the motion. `kernel` scales all bonds: m / (m - 1/2), m = 100, puts right that sums over the lattice
/// lack the cell of the node itself.
struct MovingBar {
  BarEnds ends = BarEnds::surface;
  int order = 1;  // of the expansions
  double kernel = 1;
};

/// State of the bar at an instant, with its errors.
struct BarInstant {
  int step;
  Eigen::VectorXd u;     // of the nodes [m]
  double largest, mean;  // error against the series: largest [m]; root of the mean square over that of the series
  double violated = 0;   // largest amount by which held conditions are missed
};

/// Central differences from rest, looked at after these numbers of steps, which ascend.
std::vector<BarInstant> moving_bar(const MovingBar& way, const std::vector<int>& steps);

}  // namespace boundary_bodies
