#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geometry/lattice/families.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/elastic_supports.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/point_map.hpp"
#include "plate/model/supports.hpp"

namespace plate {

/// A straight edge or a circle of the outline, in lattice units, and how it is held.
struct Side {
  std::string name;
  bool circle = false;
  geometry::Edge edge;           // straight
  geometry::Point centre{0, 0};  // circle
  double radius = 0;
  SupportKind kind = SupportKind::free;
  /// Kind of the same edge in the plane, or for a plate in its plane across it, where both have the same points.
  SupportKind other = SupportKind::free;
  std::optional<std::size_t> support = {};  // number of that whose part or disc of the plate this is the rim of

  /// True where the plate ends here: not at the rim of a part that only the plane holds, or only the plate.
  bool parts() const { return !support || kind != SupportKind::free; }
  double inside(const geometry::Point& u) const;            // distance from the side, positive on the plate's side
  geometry::Point outward(const geometry::Point& u) const;  // unit normal at the side's point next to u
  /// Parallel to the lattice and on a boundary between cells: points mirrored at it are lattice points.
  bool along_lattice() const;
  int normal_axis() const;  // 0: x, 1: y; -1: neither
  geometry::Point mirrored(const geometry::Point& u) const;
  /// True where the segment pq meets the side, be it in one point.
  bool meets(const geometry::Point& p, const geometry::Point& q) const;
};

/// A point outside the plate that stands for what a support does there. It is seen across one side, or across two
/// at a corner.
struct FictitiousPoint {
  std::array<int, 2> sides{-1, -1};
  bool layer = false;  // of a layer in the manner of Dai et al.: stores energy, not tied to a point of the plate
  bool exact = false;  // the exact mirror image of a point of the plate
  bool bonded = true;  // false: only the other of a plate and its plane has bonds to it
};

/// Support that reactions are attributed to: all edges of one name, a point, a line or a part of the plate.
struct Holder {
  enum class Place { edge, point, inside };
  std::string name;  // of the edges; pin0, ..., line0, ..., part0, ..., hub0, ... in the order of the case
  SupportKind kind = SupportKind::free;
  std::optional<geometry::Point> position;  // of a point or the centre of a hub [length]
  Place place = Place::edge;
  Push push = Push::both_ways;
  std::size_t support = 0;  // its number
};

/// Support that holds a point of the plate: its deflection, or its rotations.
struct Hold {
  std::uint32_t point, holder;
  bool rotations;
};

/// Supports as constraints: fictitious points beyond the edges, degrees of freedom that follow others or are zero.
/// Mirror images (clamped: rotations odd, w odd with the lever of the rotation; simply supported hard: w and psi_s odd;
/// symmetry: psi_n odd; psi_n, psi_s: rotation along the normal and along the edge) where an edge lies along the
/// lattice; elsewhere lattice points outside that follow the place of their image, or the point nearest to it, by the
/// distances from the line. Simply supported (w only): the outermost row follows the second so that w = 0 on the line.
/// theory.md, "Supports".
struct Boundary {
  geometry::Cloud cloud;                 // points of the plate, then fictitious points
  std::vector<geometry::Point> lattice;  // the same points in lattice units
  std::vector<Side> sides;
  std::vector<FictitiousPoint> fictitious;  // cloud.positions[plate_points + i]
  Constraints constraints;                  // resolved
  std::vector<char> active;                 // points that store energy
  std::vector<Holder> holders;
  std::vector<Hold> holds;  // of points of the plate; a fictitious point is held by its sides
  /// Number of the support whose clamped part or disc has the point, -1 elsewhere [plate points]; empty without them
  /// and where cells end at rims.
  std::vector<std::int32_t> body = {};
  std::vector<std::string> warnings;
  ElasticSupports elastic_supports = {};  // of foundations and springs
  PointMap map = {};

  bool owns(std::size_t k) const { return map.owns(k); }
  /// True where the point of the plate nearest to a place is owned.
  bool here(const geometry::Point& x) const {
    return map.owned.empty() || (cloud.seeded(x) && map.owned[geometry::nearest_plate_point(cloud, x)]);
  }
  bool is_plate(std::uint32_t k) const { return k < cloud.plate_points; }
  std::int32_t body_of(std::uint32_t k) const { return body.empty() || !is_plate(k) ? -1 : body[k]; }

  /// True if `test` is for the straight bond k - j or for one of its mirror images: what lies beyond a mirror
  /// is what lies before it.
  bool any_image(std::uint32_t k, std::uint32_t j,
                 const std::function<bool(const geometry::Point&, const geometry::Point&)>& test) const;
};

/// The edges and circles of an outline, and how the supports hold them.
std::vector<Side> sides_of(const geometry::Outline& outline, const std::vector<Support>& supports);

/// Every edge that is held, by its name, and every point, line and part.
std::vector<Holder> holders_of(const std::vector<Support>& supports);

/// The number of the holder of edges; that of holders where there is none.
std::uint32_t holder(const std::vector<Holder>& holders, const std::string& name);
/// Likewise of a side, which may be the rim of a part that is held.
std::uint32_t holder(const std::vector<Holder>& holders, const Side& side);

/// Points that a rank knows beside its owned points, where more are requested than their forces need.
struct Surroundings {
  std::vector<char> known;                       // points whose states are known
  std::shared_ptr<const HaloExchange> exchange;  // of those that others own
};

}  // namespace plate
