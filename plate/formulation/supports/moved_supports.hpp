#pragma once
#include <vector>

#include "plate/formulation/constraints.hpp"
#include "plate/model/loading/support_motion.hpp"

namespace plate {

struct Boundary;
struct Side;

/// What is held, where settlements move what holds it: every rule of a support is one for the difference from the
/// motion of the support (theory.md, "Supports that move"). Without settlements everything here is empty.
class MovedSupports {
public:
  using Offsets = std::vector<Constraints::Offset>;
  using Leaders = std::vector<Constraints::Leader>;

  /// `boundary` must outlive this.
  MovedSupports(const Boundary& boundary, const std::vector<SupportMotion>& motions)
      : boundary_(&boundary), motions_(motions) {}

  /// Of a degree of freedom that a side holds by these leaders.
  Offsets of(std::uint32_t dof, const Side& side, const Leaders& leaders) const;
  /// Of the image in `second` of the image in `first` of a point, with the signs by which each follows the other.
  Offsets of_corner(std::uint32_t image, std::uint32_t point, std::uint32_t component, const Side& first,
                    double first_sign, const Side& second, double second_sign) const;
  /// Of the body of a support at a place: component 0 to 2 of w, theta_x, theta_y.
  Offsets inside(std::size_t support, const geometry::Point& x, std::uint32_t component) const;

private:
  Eigen::Vector3d at(const SupportMotion& motion, const geometry::Point& lattice, const Side& side) const;
  bool moves(const SupportMotion& motion, const Side& side) const;

  const Boundary* boundary_;
  std::vector<SupportMotion> motions_;
};

}  // namespace plate
