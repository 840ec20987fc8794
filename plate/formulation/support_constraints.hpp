#pragma once
#include <string>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/state.hpp"

namespace plate {

struct Problem;

/// Offsets of held degrees of freedom where settlements move the supports: every rule of a support applies to the
/// difference from the motion of the support (theory.md, "Supports that move"). Without settlements everything here is
/// empty.
class SupportOffsets {
public:
  using Offsets = std::vector<Constraints::Offset>;
  using Leaders = std::vector<Constraints::Leader>;

  /// `boundary` must outlive this.
  SupportOffsets(const Boundary& boundary, const std::vector<SupportMotion>& motions)
      : boundary_(&boundary), motions_(motions) {}

  /// Number of the motion by which a point leaves a support that only pushes: behind those of all settlements.
  static constexpr std::size_t gap(std::uint32_t point) { return (std::size_t(1) << 32) + point; }
  /// Adds the offset by which a unit gap at its point moves a deflection that this holder holds; none of rotations, and
  /// of holders that pull too.
  void add_gap(std::uint32_t holder, const Dof& dof, double value, Offsets& offsets) const;

  /// Offsets of a degree of freedom that a side holds by these leaders.
  Offsets of(const Dof& dof, const Side& side, const Leaders& leaders) const;
  /// Offsets at a corner: of the image in `second` of the image in `first` of a point, with the signs by which each
  /// follows the other.
  Offsets of_corner(std::uint32_t image, std::uint32_t point, std::uint32_t component, const Side& first,
                    double first_sign, const Side& second, double second_sign) const;
  /// Offsets by the motion of the body of a support at a place: component 0 to 2 of w, theta_x, theta_y.
  Offsets inside(std::size_t support, const geometry::Point& x, std::uint32_t component) const;

private:
  PointValues at(const SupportMotion& motion, const geometry::Point& lattice, const Side& side) const;
  bool moves(const SupportMotion& motion, const Side& side) const;

  const Boundary* boundary_;
  std::vector<SupportMotion> motions_;
};

/// Points of the plate that lie on a part of it, those on its boundary included, ascending.
std::vector<std::uint32_t> points_on(const geometry::Hole& part, const geometry::Cloud& cloud);

/// Adds what supports along lines and on parts of the plate hold. Of a part: the points in it. Along a line: at every
/// point next to it the value at the piece of the line that is next to the point, w + (x - x_k) . psi.
void hold_inside(Boundary& boundary, const std::vector<Support>& supports, const SupportOffsets& moved);

/// Components that a support of a point, a line or a part holds: w, and of a clamp the rotations; in the plane, where
/// nothing acts on w, one of them or both.
std::vector<std::uint32_t> held_at_point(SupportKind kind);

/// Fixes what a holder holds of a point.
void hold_point(Boundary& boundary, std::uint32_t point, std::uint32_t holder, const SupportOffsets& moved);

/// Holds a place next to a point: w + (x - x_k) . psi is held there, or of a clamp the point itself.
void hold_place(Boundary& boundary, std::uint32_t point, const geometry::Point& at, std::uint32_t holder,
                const SupportOffsets& moved);

/// Places that lie on the lines and boundaries of parts that supports hold, at most `spacing` apart [length]; none
/// nearer to edges and cracks than half of that.
std::vector<geometry::Point> places_inside(const std::vector<Support>& supports, const geometry::Outline& outline,
                                           const std::vector<geometry::CrackPath>& cracks, double spacing);

/// True of supports that hold a part of the plate as a rigid body: clamped parts and discs of hubs.
bool is_body(const Support& support);

/// Rigid body along whose rim the cells of a plate are parted: the rim then has points of the plate about it, and
/// points of the body.
struct PartedBody {
  std::size_t support;   // its number
  geometry::Hole shape;  // [length]

  std::string name() const;  // of the rim among the names of cells
  /// The rim within the plate, of a circle by chords of `spacing` [length]: closed, or from edge to edge.
  std::vector<geometry::CrackPath> rims(const geometry::Outline& outline, double spacing) const;
  /// True where a place is closer to the rim than `beside` [length].
  bool on_rim(const geometry::Point& x, double spacing, double beside) const;
};

/// Bodies whose rims part cells. No rim comes closer than half a spacing to an edge that it does not cross, a crack or
/// another place that gets a point, and each body has room for two points across.
std::vector<PartedBody> parted_bodies(const Problem& problem, const std::vector<geometry::CrackPath>& paths,
                                      double spacing);

/// The places where loads and supports act, which get a point of their own, but for the rims of parted_bodies().
/// `spacing`: between those on lines.
std::vector<geometry::Point> own_places(const Problem& problem, const std::vector<geometry::CrackPath>& paths,
                                        double spacing);

}  // namespace plate
