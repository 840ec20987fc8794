#pragma once
#include "plate/model/resultants.hpp"
#include "plate/model/state.hpp"
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace post {

/// What does not change during a run: the points of the plate and the cells drawn between them.
struct Mesh {
  std::vector<Eigen::Vector2d> positions;            // [length]
  std::vector<double> areas;                         // [length^2]
  std::vector<double> cut;                           // share of each point's full family severed by cracks and edges
  std::vector<std::array<std::uint32_t, 4>> quads;   // of neighbouring points that see each other
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double spacing = 0, thickness = 0;                 // [length]
};

/// One instant. Arrays have one entry per point of the mesh.
struct Frame {
  double time = 0;
  std::size_t step = 0;
  plate::State state;           // w, theta_x, theta_y
  plate::Resultants resultants;
  std::vector<double> damage;   // 1 - intact weight / weight at the start; all zero without growth
};

}  // namespace post
