#pragma once
#include "plate/bond_weights.hpp"
#include "plate/state.hpp"
#include "post/tip_field.hpp"
#include <cmath>
#include <memory>

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
};

/// The annulus in which the extension q falls from 1 to 0 [length].
struct Ring {
  double inner, outer;

  double extension(double r) const;   // q
  double slope(double r) const;       // dq/dr
};

/// -dU/da of the strain energy of a field carried along with a tip that moves straight ahead: a symmetric bilinear form of two
/// fields, of which only the points of the ring take part.
class EnergyRelease {
public:
  virtual ~EnergyRelease() = default;
  virtual double operator()(const plate::State& u, const plate::State& v) const = 0;
};

/// By moving the bonds of the ring and matching the position-aware weights again (virtual crack extension; theory.md).
std::unique_ptr<EnergyRelease> moved_bonds(const BondedPlate& plate, const TipFrame& frame, const Ring& ring);

/// By the domain integral of moments, shear forces and gradients at the points of the ring (J-integral; theory.md).
std::unique_ptr<EnergyRelease> domain_integral(const BondedPlate& plate, const TipFrame& frame, const Ring& ring);

/// Energy release rate [force] and intensity factors of one tip from one ring.
struct TipRates {
  double G = 0;
  Eigen::Vector3d K{0, 0, 0};
};

/// Energy release rate of a field, and K1, K2, K3 by its interaction with the three fields of a tip.
class TipIntegral {
public:
  TipIntegral(const BondedPlate& plate, const geometry::Tip& tip, const Ring& ring, std::unique_ptr<EnergyRelease> release);

  /// `force`: internal force of the state, minus external forces plus inertia (FamilyOperator::internal_force).
  TipRates operator()(const plate::State& state, const plate::Forces& force) const;

private:
  /// The derivative along the crack at a point, by least squares over its family.
  struct Slope {
    struct Term {
      std::uint32_t neighbour;
      double share;
      plate::BondShape bond;
    };
    geometry::Point ahead;
    std::vector<Term> terms;

    Eigen::Vector3d operator()(const plate::State& state, std::uint32_t k) const;
  };
  /// A point that the extension moves.
  struct Inside {
    std::uint32_t point;
    double extension;  // q
    Slope slope;
    std::array<Eigen::Vector3d, 3> auxiliary_slope;  // of the three unit fields
  };

  plate::State without_rigid_motion(const plate::State& state) const;
  Slope slope_at(const BondedPlate& plate, const TipFrame& frame, std::uint32_t k) const;

  plate::Section section_;
  const std::vector<geometry::Point>& positions_;
  std::unique_ptr<EnergyRelease> release_;
  std::vector<Inside> inside_;
  std::array<plate::State, 3> auxiliary_;
  std::vector<std::uint32_t> centre_;  // points next to the tip
};

/// G of unit intensity factors: G = g1 (K1^2 + K2^2) + g3 K3^2 (theory.md).
Eigen::Vector3d unit_release(const plate::Section& section);

}  // namespace post
