#pragma once
#include "geometry/family_runs.hpp"
#include "plate/horizon_parameters.hpp"
#include "plate/state.hpp"

namespace plate {

/// The ordinary state-based plate on the families of any cloud: state -> internal force, and the bounds that the
/// solvers need, which come from the same bonds. Parameters by point; bonds by patterns that runs of points share, so
/// that a vector of points is treated at once where they follow each other. Forces are gathered point by point: any number
/// of threads gives the same bits. One call at a time.
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
  Forces diagonal() const;

  /// Strain energy of every point, W_k A_k [points] (Eqs. 1 and 2).
  Eigen::VectorXd energies(const State& state) const;

  const geometry::Families& families() const { return families_; }
  const std::vector<BondShape>& shapes() const { return shapes_; }

private:
  template <bool absolute>
  void product(const State& state, Forces& forces) const;
  template <bool absolute, typename Value>
  void dilatations(std::size_t k, std::uint32_t pattern, const std::vector<BondShape>& shapes) const;
  template <bool absolute, typename Value>
  void gather(std::size_t k, std::uint32_t pattern, const std::vector<BondShape>& shapes, Forces& forces) const;
  template <typename Value>
  Kinematics<Value> kinematics(std::size_t k) const;

  geometry::Families families_;
  geometry::FamilyRuns runs_;
  std::vector<BondShape> shapes_;
  Eigen::ArrayXd area_, a_, b_, d_, half_shear_;            // by point: A, a_b, b_b, d_b, C_s / 2
  mutable Eigen::ArrayXd w_, theta_x_, theta_y_, q_;        // by point, of the state in hand; q = 2 a_b d_b theta_b
};

}  // namespace plate
