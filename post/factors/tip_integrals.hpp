#pragma once
#include <memory>
#include <vector>

#include "plate/formulation/tip_view.hpp"

namespace post {

using plate::EnergyRelease, plate::NearField, plate::Ring, plate::TipFrame, plate::TipView;

/// Energy release rate by the domain integral of moments, shear forces and gradients at the points of the ring
/// (J-integral; theory (48)).
std::unique_ptr<EnergyRelease> domain_integral(const TipView& plate, const TipFrame& frame, const Ring& ring);

/// Curvatures xx, yy, 2 xy that points would have without a moment, as from heat; in the plane strains that the
/// deflections give, where displacements are -psi [3 x points].
using FreeCurvatures = Eigen::Matrix3Xd;

/// Change of free curvatures ahead at a point, by its family.
Eigen::Vector3d change_ahead(const TipView& plate, std::uint32_t k, const TipFrame& frame, const FreeCurvatures& free);

/// Contribution to -dU/da of a ring of free curvatures that vary about a tip (theory (80)) [force]. `field`: less a
/// free curvature of the whole plate, as `free`; `near`: the same field.
double release_of_free_curvatures(const TipView& plate, const TipFrame& frame, const Ring& ring,
                                  const plate::State& field, const NearField& near, const FreeCurvatures& free);

/// Data shared by all integrals about a tip: the points that their extensions may move, and the work of the forces
/// there.
class TipSurroundings {
public:
  /// Constructs from all points within `radius` of the tip, the nearest first. `plate` must outlive this.
  TipSurroundings(const TipView& plate, const TipFrame& frame, double radius);

  const std::vector<std::uint32_t>& points() const { return points_; }
  const std::vector<std::uint32_t>& centre() const { return centre_; }  // within two spacings of the tip
  /// q of a ring at every point.
  Eigen::VectorXd extensions(const Ring& ring) const;
  const TipFrame& frame() const { return frame_; }
  /// f . du/dx' at every point within `radius`, 0 beyond [force]. `force`: internal force of the state, minus external
  /// forces plus inertia (Operator::internal_force).
  Eigen::VectorXd forward_work(const plate::State& state, const plate::Forces& force, double radius) const;

private:
  const TipView* plate_;
  TipFrame frame_;
  std::vector<std::uint32_t> points_, centre_;
};

/// Energy release rate of one tip from one ring (theory (47)).
class TipIntegral {
public:
  TipIntegral(const TipSurroundings& surroundings, const Ring& ring, std::unique_ptr<EnergyRelease> release)
      : extensions_(surroundings.extensions(ring)), release_(std::move(release)) {}

  /// G [force]. `forward_work`: of the state, at the points of the surroundings.
  double operator()(const NearField& field, const Eigen::VectorXd& forward_work) const {
    return (*release_)(field) + extensions_.dot(forward_work);
  }

private:
  Eigen::VectorXd extensions_;
  std::unique_ptr<EnergyRelease> release_;
};

/// Axes at a tip, of which the crack behind it may be a curve. `curved`: false takes every crack as straight pieces.
TipFrame frame_of(const geometry::CrackPath& path, const geometry::Tip& tip, double spacing, bool curved = true);

/// Length over which the curve of a tip follows its circle, by at most half a radian [length].
double unbent_length(const TipFrame& frame, double spacing);

/// Distance from a tip within which the plate is whole but for its own crack, which is straight there or follows a
/// circle by at most half a radian: from edges, holes, other cracks, other ends and bends of its own [length].
double clear_distance(const geometry::Outline& outline, const std::vector<geometry::CrackPath>& paths,
                      const geometry::Tip& tip, double spacing, bool curved = true);

/// The tip moved half way between the points on either side of the last sixteen spacings of the crack: on a lattice,
/// the crack is what parts the points, wherever between them it is drawn.
geometry::Tip centred(const geometry::Tip& tip, const TipView& plate);

/// The rings about a tip, the recommended one first: outer radii of 16, 11, 24 and 7 spacings, inner radii half of
/// them, as far as they fit into `clear`; where none does, one as large as fits. Empty where not even 4 spacings fit.
/// In graded points, where any ring has as many points across as another that is as wide in proportion, shares of
/// `clear`, and an eighth inside. `spacing`: at the tip.
std::vector<Ring> rings(double clear, double spacing, bool graded);

}  // namespace post
