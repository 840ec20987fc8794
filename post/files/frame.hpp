#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/mesh.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/model/state.hpp"

namespace post {

struct Srif;

/// Weight of a corner's sources: `linear` for displacements, `mean` for what is derived from them.
using CornerWeight = double plate::Mesh::Source::*;

/// The vertices of a mesh: its points, then the corners of cells on edges and cracks [length].
std::vector<geometry::Point> vertices(const plate::Mesh& mesh);

/// Values of points [components x points] as values of vertices [components x vertices]: those of corners from their
/// sources.
Eigen::MatrixXd at_vertices(const plate::Mesh& mesh, const Eigen::MatrixXd& values, CornerWeight weight);

/// Values of points, a number for each, as a matrix.
inline Eigen::Map<const Eigen::RowVectorXd> row_of(const std::vector<double>& values) {
  return {values.data(), Eigen::Index(values.size())};
}

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

using plate::Mesh;

/// Displacements u, v and membrane forces Nxx, Nyy, Nxy of points in the plane.
struct InPlaneFields {
  Eigen::Matrix2Xd displacement;  // [length]
  Eigen::Matrix3Xd force;         // [force/length]
};

/// Frame at one instant. Arrays have one entry per point of the mesh.
struct Frame {
  double time = 0;
  std::size_t step = 0;
  plate::State state;  // w, theta_x, theta_y
  plate::Resultants resultants;
  std::vector<double> damage;                  // 1 - intact weight / weight at the start; all zero without growth
  std::optional<Cracks> cracks = {};           // where they change
  std::optional<InPlaneFields> in_plane = {};  // where loads act there
};

}  // namespace post
