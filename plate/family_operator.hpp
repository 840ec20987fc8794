#pragma once
#include "geometry/family_runs.hpp"
#include "plate/bond_weights.hpp"
#include "plate/state.hpp"

namespace plate {

/// The ordinary state-based plate on the families of any cloud: state -> internal force, and the bounds that the
/// solvers need, which come from the same bonds. Bonds are kept by patterns that runs of points share, so that a vector
/// of points is treated at once where they follow each other. Forces are gathered point by point: any number of threads
/// gives the same bits. One call at a time.
class FamilyOperator {
public:
  FamilyOperator(geometry::Families families, std::vector<BondShape> shapes, const std::vector<double>& areas,
                 HorizonWeights weights);

  std::size_t points() const { return families_.points(); }

  /// forces = -dU/d(state): Eqs. 11-13 summed over the family [3 x points].
  void internal_force(const State& state, Forces& forces) const;

  /// An upper bound of |K| state for a state without negative entries, K = d2U/d(state)2 [3 x points].
  void absolute_product(const State& state, Forces& forces) const;

  /// The diagonal of K [3 x points].
  Forces diagonal() const;

  /// Strain energy of every point, W_k A_k [points] (Eqs. 1 and 2).
  Eigen::VectorXd energies(const State& state) const;

  const geometry::Families& families() const { return families_; }
  const std::vector<BondShape>& shapes() const { return shapes_; }
  const HorizonWeights& weights() const { return weights_; }

private:
  /// A bond of a pattern, with what both ends give to it.
  struct Bond {
    double mx, my, length;     // as in BondShape
    double D_kj, D_jk;         // weights in the dilatation of either end
    double curvature, shear;   // 2 (A_k B_kj + A_j B_jk), 2 (A_k S_kj + A_j S_jk)
    std::int32_t step;         // neighbour = point + step
  };
  /// Bonds of all patterns, one pattern after the other.
  struct Patterns {
    std::vector<Bond> bonds;
    std::vector<std::size_t> first;
  };

  Bond bond(std::size_t k, std::size_t i) const;
  Patterns absolute_patterns() const;
  template <bool absolute>
  void product(const State& state, const Patterns& patterns, const Eigen::ArrayXd& stiffness, Forces& forces) const;
  template <bool absolute, typename Value>
  void dilatations(std::size_t k, const Bond* begin, const Bond* end, const Eigen::ArrayXd& stiffness) const;
  template <bool absolute, typename Value>
  void gather(std::size_t k, const Bond* begin, const Bond* end, Forces& forces) const;
  template <typename Value>
  Kinematics<Value> kinematics(std::size_t k) const;

  geometry::Families families_;
  geometry::FamilyRuns runs_;
  std::vector<BondShape> shapes_;
  HorizonWeights weights_;
  Eigen::ArrayXd area_, dilatation_stiffness_;        // by point: A, 2 A a
  Patterns patterns_;
  mutable Eigen::ArrayXd w_, theta_x_, theta_y_, q_;  // by point, of the state in hand; q = 2 A a theta
};

}  // namespace plate
