#pragma once
#include <limits>
#include <optional>
#include <vector>

#include "plate/formulation/formulation.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/space.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// The plate as parts that are rigid in themselves, and hinges between them.
class RigidParts {
  using Point = geometry::Point;

public:
  static constexpr int motions = 3;  // of a part: its deflection and two slopes; in the plane u, v and its turn

  RigidParts(const Boundary& boundary, const geometry::Families& families, PlateLaw law = PlateLaw::bending);

  std::size_t count() const { return first_.size(); }
  /// Number of rigid parts over all ranks. Collective.
  std::size_t count_of_all();
  std::uint32_t part(std::uint32_t k) const { return part_[k]; }
  bool has(std::uint32_t k) const { return part_[k] != none; }  // not images, nor fictitious points without a bond
  std::uint32_t first(std::uint32_t part) const { return first_[part]; }
  std::size_t points(std::uint32_t part) const { return points_[part]; }
  bool on_line(std::uint32_t k) const { return line_[k] != Point(0, 0); }
  const Point& line(std::uint32_t k) const { return line_[k]; }  // unit vector along its bonds

  /// w [spacings] and slopes at a place as linear functions of the part's unknowns, columns 0, 1, 2: all of the
  /// order of 1 within the part.
  Eigen::Vector3d deflection(std::uint32_t part, const Point& u) const {
    const Point r = (u - boundary_.lattice[first_[part]]) / extent_[part];
    return {1, r.x(), r.y()};
  }
  Eigen::Vector3d slope(std::uint32_t part, const Point& n) const {
    return Eigen::Vector3d(0, n.x(), n.y()) / extent_[part];
  }
  /// Returns the row of a degree of freedom, deflections in spacings; in the plane those of theta_x = -v, theta_y = u.
  Eigen::Vector3d row(const Dof& dof) const {
    const auto k = dof.point, own = part(k);
    if (law_ == PlateLaw::membrane) {
      const Point r = (boundary_.lattice[k] - boundary_.lattice[first_[own]]) / extent_[own];
      if (is_deflection(dof)) return Eigen::Vector3d::Zero();
      return dof.component == 1 ? Eigen::Vector3d(0, -1, -r.x()) : Eigen::Vector3d(1, 0, -r.y());
    }
    if (is_deflection(dof)) return deflection(own, boundary_.lattice[k]);
    return dof.component == 1 ? slope(own, {0, 1}) : slope(own, {-1, 0});
  }

  /// Every pair of bonded points that stores energy, once.
  template <typename Visit>
  void for_each_bond(const Visit& visit) const {
    for (std::uint32_t k = 0; k < families_.points(); ++k)
      for (const auto& bond : families_[k])
        if (const auto j = bond.neighbour; j < k && (boundary_.active[k] || boundary_.active[j])) visit(k, j);
  }

private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Numbers the sets, in the order of their first points.
  void number();

  Point to(std::uint32_t k, std::uint32_t j) const { return boundary_.lattice[j] - boundary_.lattice[k]; }

  /// Direction of the bonds where they lie on one line, else zero.
  Point line_of(std::uint32_t k) const;
  /// Two bonded points and a third that is bonded to both beside their line: none can turn against the others.
  void join_triangle(std::uint32_t k, std::uint32_t j);
  bool stores(std::uint32_t k, std::uint32_t i) const {
    return !follows_[i] && (boundary_.active[k] || boundary_.active[i]);
  }

  const Boundary& boundary_;
  const geometry::Families& families_;
  PlateLaw law_;
  DisjointSets sets_;
  std::vector<char> follows_;  // images: all that they do is what others do
  std::vector<Point> line_;
  std::vector<std::uint32_t> part_;   // of each point
  std::vector<std::uint32_t> first_;  // its first point
  std::vector<std::size_t> points_;
  std::vector<double> extent_;
};

/// A part of the plate that moves without resistance against the part that it hangs on.
struct LoosePart {
  std::size_t points = 0;
  geometry::Point position{0, 0};  // of its first point [length]
  geometry::Point ligament{0, 0};  // a point of the line that it turns about [length]
};

/// Mechanisms: motions that no bond resists although every piece is held. A bond ties two points together but for the
/// rotation about its own line, so that bonds along one line, a ligament one row of points wide, are a hinge. In the
/// plane a bond resists the motion along its line alone.
struct Mechanisms {
  std::size_t twisting = 0;          // points whose bonds all lie on one line: their turn about it has no stiffness
  std::optional<LoosePart> twisted;  // one of them that the load turns
  int motions = 0;                   // of whole parts against each other
  std::optional<LoosePart> driven;   // the largest part that the load sets in motion
  std::size_t parts = 0;             // rigid in themselves
  bool searched = true;              // false: too many parts to look for motions, or several processes share them
};

/// `pieces` of the same plate; `load` of all points, as nodal forces.
Mechanisms mechanisms(const Boundary& boundary, const geometry::Families& families, const std::vector<Piece>& pieces,
                      const Forces& load, PlateLaw law = PlateLaw::bending);

/// Ties the turn of every point about the line of its bonds to that of the next point that has bonds in two directions,
/// so that it moves with the plate and has no motion of its own. Changes no other point. Of one process.
void tie_twists(Boundary& boundary, const geometry::Families& families);

/// Refusals for parts that supports do not hold: pieces that may move as rigid bodies, or, where all are held, a part
/// that hangs by bonds along one line and that the load turns. Empty for a plate that can be in equilibrium with its
/// loads.
std::vector<Refusal> loose(const Formulation& plate);

/// Warnings about parts that can move without resistance.
std::vector<std::string> warnings_about_mechanisms(const Formulation& plate);

/// The part that hangs by bonds along one line and has the frequency 0 although every piece is held. Empty for a plate
/// that has no such part.
std::vector<Refusal> unresisted_motions(const Formulation& plate);

}  // namespace plate
