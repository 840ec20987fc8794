#pragma once
#include "geometry/families.hpp"
#include "plate/horizon_parameters.hpp"
#include "plate/state.hpp"
#include <concepts>

namespace plate {

/// What the solvers ask of a plate: state -> internal force, and two bounds that come from the same bonds.
template <typename T>
concept PlateOperator = requires(T op, const State& state, Forces& forces) {
  { op.points() } -> std::convertible_to<std::size_t>;
  op.internal_force(state, forces);  // forces = -dU/d(state)
  op.absolute_product(state, forces);  // forces >= |K| state, for state >= 0
  op.diagonal(forces);  // forces = diag K
};

/// The ordinary state-based plate on the families of any cloud: geometry by bond vector, parameters by point, forces
/// gathered point by point, so that the result does not depend on the number of threads. Any number of threads gives
/// the same bits.
class FamilyOperator {
public:
  FamilyOperator(geometry::Families families, std::vector<BondShape> shapes, const std::vector<double>& areas,
                 const std::vector<PointParameters>& parameters);

  std::size_t points() const { return families_.points(); }

  /// forces = -dU/d(state): Eqs. 11-13 summed over the family and times the point's area [3 x points].
  void internal_force(const State& state, Forces& forces) const;

  /// An upper bound of |K| state for a state without negative entries, K = d2U/d(state)2 [3 x points].
  void absolute_product(const State& state, Forces& forces) const;

  /// The diagonal of K [3 x points].
  void diagonal(Forces& forces) const;

  /// Strain energy of every point, W_k A_k [points] (Eqs. 1 and 2).
  Eigen::VectorXd energies(const State& state) const;

  const geometry::Families& families() const { return families_; }
  const std::vector<BondShape>& shapes() const { return shapes_; }

private:
  /// Everything that a bond asks of one of its two points, in one cache line.
  struct alignas(64) Packed {
    Kinematics u;
    double q;     // 2 a_b d_b theta_b
    double area;
    double b;     // b_b
    double half_shear;  // C_s / 2
  };

  template <bool absolute>
  void product(const State& state, Forces& forces) const;

  geometry::Families families_;
  std::vector<BondShape> shapes_;
  std::vector<PointParameters> parameters_;
  mutable std::vector<Packed> packed_;
};

static_assert(PlateOperator<FamilyOperator>);

}  // namespace plate
