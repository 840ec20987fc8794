#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>
#include "plate/formulation/mesh.hpp"
#include "plate/formulation/resultants.hpp"
#include "plate/model/state.hpp"
#include "post/files/vtk/crack_lines.hpp"

namespace post {

using plate::Mesh;

/// One instant. Arrays have one entry per point of the mesh.
struct Frame {
  double time = 0;
  std::size_t step = 0;
  plate::State state;  // w, theta_x, theta_y
  plate::Resultants resultants;
  std::vector<double> damage;         // 1 - intact weight / weight at the start; all zero without growth
  std::optional<Cracks> cracks = {};  // where they change
};

}  // namespace post
