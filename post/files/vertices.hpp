#pragma once
#include <vector>

#include "plate/formulation/mesh.hpp"

namespace post {

/// Which of the weights of a corner's sources: `linear` for displacements, `mean` for what is derived from them.
using CornerWeight = double plate::Mesh::Source::*;

/// The vertices of a mesh: its points, then the corners of cells on edges and cracks [length].
std::vector<geometry::Point> vertices(const plate::Mesh& mesh);

/// Finds the values of the corners from those of the points. `values`: [components x vertices], of which the points are
/// set.
void continue_to_corners(const plate::Mesh& mesh, Eigen::Ref<Eigen::MatrixXd> values, CornerWeight weight);

/// Values of points [components x points] as values of vertices [components x vertices].
Eigen::MatrixXd at_vertices(const plate::Mesh& mesh, const Eigen::MatrixXd& values, CornerWeight weight);

}  // namespace post
