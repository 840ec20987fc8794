#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

namespace plate {

/// A surface node: stands for the face of an outer cell (Sca23 3).
struct SurfaceNode {
  int inner;        // the real node of its cell
  int axis, side;   // outward normal: axis 0, 1, 2, side -1 or +1
  double distance;  // from the inner node, in spacings, between 0 and 1; 1/2 in the papers
};

/// A fictitious node as it is seen through the faces of one axis, straight behind one of them.
struct Sight {
  int node, surface;  // the fictitious node, the nearest surface node before it
};

/// Real nodes on a lattice, in one to three dimensions, and fictitious nodes about them. Lengths in spacings; of
/// indices and positions only the first `dimension` components are used, the others are 0.
struct LatticeBody {
  using Index = Eigen::Array3i;

  int dimension = 0;
  std::vector<Index> nodes;  // real nodes, then fictitious nodes
  int real = 0;
  std::vector<SurfaceNode> surface;
  /// Sights of the fictitious nodes that lie straight behind faces of more than one axis, beyond a re-entrant corner:
  /// one for each axis. Their values differ: through whichever face a bond leaves the body, the edge runs on beyond the
  /// corner.
  std::vector<Sight> sights;

  int count() const { return int(nodes.size()); }
  int fictitious() const { return count() - real; }
  /// Values that nodes have: one each, and behind them one of each sight.
  int values() const { return count() + int(sights.size()); }
  /// Index of the value that node k has where it is seen through faces of this axis.
  int value(int k, int axis) const;
  /// The node at a place of the lattice; -1: none.
  int node(const Index& place) const;
  /// The surface node of a real node's face; -1: none.
  int surface_node(int inner, int axis, int side) const;
  Eigen::Vector3d position(int k) const { return nodes[std::size_t(k)].matrix().cast<double>(); }
  Eigen::Vector3d surface_position(int s) const;

  // of the look-up
  Index lowest{0, 0, 0}, extent{0, 0, 0};
  std::vector<int> at;                      // node of each place in the box, -1: none
  std::vector<std::array<int, 3>> seen{};   // per fictitious node: its sight through each axis, -1: its only value
  std::vector<std::array<int, 6>> faces{};  // per real node: its surface nodes, -1: none; axis * 2 + (side > 0)
};

/// Distance of a face from the real node of its cell, in spacings.
using FaceDistance = std::function<double(const LatticeBody::Index& inner, int axis, int side)>;

/// The body of these real nodes, with a surface node wherever a neighbour is missing and with fictitious nodes up to
/// `reach` spacings away in each direction.
/// @throws std::invalid_argument  a dimension other than 1, 2, 3; a distance that is not between 0 and 1; no nodes
LatticeBody lattice_body(int dimension, std::vector<LatticeBody::Index> real, int reach, const FaceDistance& distance);

/// Constructs the body without surface nodes.
/// @throws std::invalid_argument  a dimension other than 1, 2, 3; no nodes
LatticeBody lattice_body(int dimension, std::vector<LatticeBody::Index> real, int reach);

/// Rule for the faces to which the force of a bond that leaves the body belongs. crossing_point: to the face that it
/// crosses, half or a quarter of it where it crosses an edge or a vertex of faces (Sca23 35, alpha). lever: along the
/// bond cut at t of its length, t to the face in whose column its outer node lies and 1 - t to that of its inner node,
/// wherever these are faces: also exact for constant forces, and what it makes of free edges in two dimensions has no
/// negative eigenvalues, which the crossing point's has.
enum class FluxRule { crossing_point, lever };

/// A share of a bond's force in the flux through a face.
struct Crossing {
  int surface;   // the surface node
  double share;  // of the force
  double cut;    // where the face cuts the bond, from its inner node, over its length
};

/// Shares of the bond from node `inner` to node `outer` in the fluxes of the faces that it leaves the body through. A
/// bond that enters the body leaves it the other way round. Bonds between fictitious nodes count as well.
std::vector<Crossing> crossings(const LatticeBody& body, int inner, int outer, FluxRule rule);

}  // namespace plate
