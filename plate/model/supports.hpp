#pragma once
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/formula.hpp"

namespace plate {

/// Kind of support of an edge (theory.md, "Supports"); psi_n and psi_s: rotation along the normal and along the edge.
enum class SupportKind {
  free,
  clamped,                      // w = psi_n = psi_s = 0 on the line
  simply_supported,             // w = 0 on the line (soft)
  simply_supported_hard,        // w = psi_s = 0 on the line
  symmetry,                     // mirror plane
  clamped_layer,                // Dai et al.: all zero in a layer of one horizon outside the plate
  simply_supported_layer,       // Dai et al.: w = 0 in that layer
  simply_supported_hard_layer,  // w = psi_s = 0 in that layer
  pinned,                       // w = 0 at single points, along lines or on parts of the plate
  in_plane,                     // nothing but what InPlane says
  hub,                          // a rigid disc whose centre is held: in a hole, or on a part of the plate
  u_alone,                      // of a plate in its plane: points, lines and parts that hold u
  v_alone
};

/// Displacements that a support holds in the plane: none, both, of edges that along the normal or the edge, of points,
/// lines and parts that along an axis.
enum class InPlane { free, fixed, normal, tangential, x, y };

/// Direction along w in which a support can push the plate: up of one that stands below it, down of one above. Both
/// ways: it holds w.
enum class Push { both_ways = 0, up = 1, down = -1 };

/// A support of named edges; or within the plate, pinned (w) or clamped (w and rotations), of single points, of a line
/// or of a part. One of the four is given. A hub is of round holes, each of them a disc, or of one circle of the plate.
struct Support {
  SupportKind kind = SupportKind::free;
  std::vector<std::string> edges;
  std::vector<geometry::Point> points;
  geometry::Polyline along = {};
  std::optional<geometry::Hole> patch = {};
  std::optional<InPlane> in_plane = {};
  std::optional<double> k_w = {};    // of a hub against w of its centre [force/length]; absent: rigid
  std::optional<double> k_phi = {};  // of a hub against its turn [force length/rad]; absent: it does not turn
  Push push = Push::both_ways;       // of what holds w alone: simply_supported, pinned

  /// Displacements that it holds in the plane: without a word a symmetry the normal displacement, the kind in_plane
  /// both, others none.
  InPlane held_in_plane() const;
  /// True where it holds nothing across the plane.
  bool holds_nothing() const { return kind == SupportKind::free || kind == SupportKind::in_plane; }
  bool holds_edges() const { return !holds_nothing() && !edges.empty(); }
  /// True of one displacement in the plane.
  bool holds_one_way() const;
  /// True where it holds a line or a part of the plate.
  bool holds_inside() const { return !along.empty() || patch; }
};

/// True for the kinds that hold points outside the plate.
bool is_layer(SupportKind kind);

/// The kind that holds the same in a layer; the kind itself where there is none.
SupportKind in_layer(SupportKind kind);

/// Degrees of freedom that a support holds along the line of an edge: w, the rotation psi_n along its normal, psi_s
/// along it.
struct Held {
  bool w = false, normal = false, tangential = false;
};

Held held_by(SupportKind kind);
/// Likewise of the displacements in the plane.
Held held_in_plane(InPlane in_plane);

/// Share and gaps of the supports that only push, off which a plate at rest has lifted.
struct LiftedSupports {
  double share = 0;        // of their points
  double largest_gap = 0;  // [length]
};

/// Elastic foundation of a plate: soil that answers the deflection w with the pressure -k w + G_p laplace(w) (Winkler
/// 1867; Pasternak 1954).
struct Foundation {
  double modulus = 0;                   // k [force/length^3]
  double shear = 0;                     // G_p [force/length]
  std::optional<geometry::Hole> patch;  // under this part of the plate alone
  bool unilateral = false;              // presses along +w where w < 0, and does not pull
};

/// Springs along edges, along a line, one at a point, or between the faces of cracks: of these four one is given.
struct Spring {
  double deflection = 0;           // against w: [force/length^2], of one [force/length]
  double rotation_normal = 0;      // against psi_n, which bends: [force]; n the normal of the edge or line
  double rotation_tangential = 0;  // against psi_s, which twists: [force]
  double rotation = 0;             // of one, against both rotations [force length]
  std::vector<std::string> edges;
  geometry::Polyline along;
  std::optional<geometry::Point> position;
  std::vector<std::size_t> cracks;  // numbers of cracks; springs resist what parts their faces
  double opening = 0, sliding = 0;  // of cracks, against u_n and u_s in the plane [force/length^2]
  Formula depth;                    // instead of stiffnesses: of cracks through a part of the thickness [length]
  bool from_below = false;          // these begin at z = -h/2

  /// True where it acts in the plane.
  bool stretches() const { return opening > 0 || sliding > 0 || depth.given(); }
};

/// A beam along edges or a line, tied to the plate's deflection and rotations, and with an axial stiffness to its
/// displacements in the plane: it bends, twists and stretches with the plate.
struct Stiffener {
  double bending = 0;           // EI [force length^2]
  double torsion = 0;           // GJ [force length^2]
  std::optional<double> shear;  // k G A [force]; without it the beam's slope is the plate's (Bernoulli)
  double mass = 0;              // rho A [mass/length]
  double axial = 0;             // EA [force]
  double eccentricity = 0;      // z of its axis [length]
  std::vector<std::string> edges;
  geometry::Polyline along;

  /// True where it acts in the plane.
  bool stretches() const { return axial > 0; }
  /// True where it bends as it is pulled.
  bool eccentric() const { return stretches() && eccentricity != 0; }
};

}  // namespace plate
