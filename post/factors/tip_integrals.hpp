#pragma once
#include <memory>
#include "plate/bonds/parameters/weights.hpp"
#include "plate/galerkin/law.hpp"
#include "plate/model/state.hpp"
#include "post/factors/tip_frame.hpp"

namespace post {

/// A bonded plate, as the integrals about a tip see it. What it refers to must outlive it.
struct BondedPlate {
  const std::vector<geometry::Point>& positions;  // plate points first
  const std::vector<double>& areas;
  const geometry::Families& families;
  const std::vector<plate::BondShape>& shapes;
  std::size_t plate_points;
  plate::Section section;
  double spacing;
  const plate::GalerkinFamilies* galerkin = nullptr;  // of the Galerkin plate, with their gradients; `families` are theirs
  const geometry::Tessellation* cells = nullptr;      // of the Galerkin plate; positions: seen_positions()

  bool graded() const { return cells && cells->graded; }
};

/// The annulus in which the extension q falls from 1 to 0 [length].
struct Ring {
  double inner, outer;

  double extension(double r) const;  // q
  double slope(double r) const;      // dq/dr
};

/// A state less the rigid motion of the points next to the tip, which does no work but would cost digits.
class NearField {
public:
  /// `centre`: the points whose mean motion is taken away.
  NearField(const plate::State& state, const std::vector<geometry::Point>& positions,
            const std::vector<std::uint32_t>& centre);

  plate::Kinematics<> operator()(std::uint32_t k) const;

private:
  const plate::State& state_;
  const std::vector<geometry::Point>& positions_;
  geometry::Point place_{0, 0};
  Eigen::Vector3d mean_{0, 0, 0};
};

/// -dU/da [force] of the strain energy of a field carried along with a tip that moves straight ahead, of which only the
/// points of the ring take part.
class EnergyRelease {
public:
  virtual ~EnergyRelease() = default;
  virtual double operator()(const NearField& u) const = 0;
};

/// By moving the bonds of the ring and matching the position-aware weights again (virtual crack extension; theory.md).
std::unique_ptr<EnergyRelease> moved_bonds(const BondedPlate& plate, const TipFrame& frame, const Ring& ring);

/// The same by moving the points of the Galerkin plate.
std::unique_ptr<EnergyRelease> moved_points(const BondedPlate& plate, const TipFrame& frame, const Ring& ring);

/// By the domain integral of moments, shear forces and gradients at the points of the ring (J-integral; theory.md).
std::unique_ptr<EnergyRelease> domain_integral(const BondedPlate& plate, const TipFrame& frame, const Ring& ring);

/// What all integrals about a tip share: the points that their extensions may move, and the work of the forces there.
class TipSurroundings {
public:
  /// All points within `radius` of the tip, the nearest first.
  TipSurroundings(const BondedPlate& plate, const geometry::Tip& tip, double radius);

  const std::vector<std::uint32_t>& points() const { return points_; }
  const std::vector<std::uint32_t>& centre() const { return centre_; }  // within two spacings of the tip
  /// q of a ring at every point.
  Eigen::VectorXd extensions(const Ring& ring) const;
  /// f . du/dx' at every point within `radius`, 0 beyond [force]. `force`: internal force of the state, minus external
  /// forces plus inertia (Operator::internal_force).
  Eigen::VectorXd forward_work(const plate::State& state, const plate::Forces& force, double radius) const;

private:
  BondedPlate plate_;
  TipFrame frame_;
  std::vector<std::uint32_t> points_, centre_;
};

/// Energy release rate of one tip from one ring (theory.md, Eq. 35a).
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

/// G of unit intensity factors: G = g1 (K1^2 + K2^2) + g3 K3^2 (theory.md).
Eigen::Vector3d unit_release(const plate::Section& section);

}  // namespace post
