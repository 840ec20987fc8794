#pragma once
#include <optional>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"

namespace plate {

/// Data that every formulation derives from a problem: points, supports, nodal loads.
struct Layout {
  Problem problem;
  std::vector<geometry::CrackPath> paths;  // [length]
  std::vector<geometry::Tip> tips;
  Boundary boundary;
  std::vector<double> cut;  // per point of the plate: share of its surroundings that cracks cut
  std::vector<TimedLoad> loads;
  std::vector<Piece> pieces = {};
  Mechanisms mechanisms = {};
  std::optional<PointSections> sections = {};  // where not given: of the problem's section, the same everywhere
};

}  // namespace plate
