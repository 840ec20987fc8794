#pragma once
#include <memory>
#include <span>
#include "geometry/lattice/families.hpp"
#include "plate/bonds/horizon_parameters.hpp"
#include "plate/formulation/elastic_supports.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/point_map.hpp"

namespace plate {

class HaloExchange;

/// A bond of a pattern, with what both ends give to it.
struct PatternBond {
  double mx, my, length;    // as in BondShape
  double D_kj, D_jk;        // weights in the dilatation of either end
  double curvature, shear;  // 2 (A_k B_kj + A_j B_jk), 2 (A_k S_kj + A_j S_jk)
  std::int32_t step;        // neighbour = point + step

  std::uint32_t neighbour(std::uint32_t k) const { return std::uint32_t(std::int64_t(k) + step); }
};

/// Bonds of all patterns, one pattern after the other.
struct Patterns {
  std::vector<PatternBond> bonds;
  std::vector<std::size_t> first;
  std::vector<double> stiffness;  // 2 A a of the points, per pattern

  std::span<const PatternBond> of(std::size_t pattern) const {
    return {bonds.data() + first[pattern], bonds.data() + first[pattern + 1]};
  }
};

/// Part of a distributed plate that a rank computes.
struct OperatedPart {
  const Communicator* communicator = &single_process();
  std::vector<std::uint32_t> block;              // of every point: runs and columns are of one each
  std::vector<char> wanted;                      // points whose dilatations and forces are asked for here
  std::shared_ptr<const HaloExchange> exchange;  // of the dilatations of the others; none: one process holds all
  std::vector<char> pending;                     // points whose values depend on others' (Constraints); empty: none

  /// True where the value of one of some points in a row is pending, or one that they see by these bonds, which all of
  /// them have.
  bool waits(std::uint32_t first, std::uint32_t length, std::span<const PatternBond> bonds) const;
};

/// The ordinary state-based plate on the families of any cloud, point by point and bond by bond: state -> internal
/// force, and the bounds that the solvers need, which come from the same bonds. Bonds are kept by patterns that runs of
/// points share. Forces are gathered: any number of threads gives the same bits. One call at a time.
class FamilyOperator : public Operator {
public:
  FamilyOperator(geometry::Families families, std::vector<BondShape> shapes, const std::vector<double>& areas,
                 HorizonWeights weights, OperatedPart part = {});

  /// Sets the elastic supports, which are part of all forces from now on.
  void set_elastic_supports(ElasticSupports elastic_supports) { elastic_supports_ = std::move(elastic_supports); }
  const ElasticSupports& elastic_supports() const { return elastic_supports_; }

  std::size_t points() const override { return families_.points(); }

  /// forces = -dU/d(state): Dai 11-13 summed over the family [3 x points].
  void internal_force(const State& state, Forces& forces) const override;
  void absolute_product(const State& state, Forces& forces) const override;
  Forces diagonal() const override;

  /// Strain energy of every point, W_k A_k [points] (Dai 1 and 2).
  Eigen::VectorXd energies(const State& state) const;

  const geometry::Families& families() const { return families_; }
  const std::vector<BondShape>& shapes() const { return shapes_; }
  const HorizonWeights& weights() const { return weights_; }

  const geometry::FamilyRuns& runs() const { return runs_; }
  const Patterns& patterns() const { return patterns_; }
  const OperatedPart& part() const { return part_; }
  /// 2 A a of every point [force length].
  const Eigen::ArrayXd& dilatation_stiffness() const { return dilatation_stiffness_; }

private:
  PatternBond bond(std::size_t k, std::size_t i) const;
  template <bool absolute>
  void product(const State& state, const Patterns& patterns, const Eigen::ArrayXd& stiffness, Forces& forces) const;

  geometry::Families families_;
  geometry::FamilyRuns runs_;
  std::vector<BondShape> shapes_;
  HorizonWeights weights_;
  Eigen::ArrayXd area_, dilatation_stiffness_;  // by point: A, 2 A a
  Patterns patterns_;
  ElasticSupports elastic_supports_;
  OperatedPart part_;
};

/// The bonds of every point of a plate, which must outlive this.
class PointBonds {
public:
  explicit PointBonds(const FamilyOperator& plate) : patterns_(plate.patterns()), pattern_(plate.points()) {
    for (const auto& run : plate.runs().runs)
      for (std::uint32_t i = 0; i < run.length; ++i) pattern_[run.first_point + i] = run.pattern;
  }
  std::span<const PatternBond> of(std::size_t k) const { return patterns_.of(pattern_[k]); }

private:
  const Patterns& patterns_;
  std::vector<std::uint32_t> pattern_;
};

/// Nodal forces [3 x points] of a free thermal curvature kappa_0 given by points of the plate: minus the derivative of
/// the terms of the bond energies in s xi kappa_0 xi, theory (79). Collective.
Forces force_of_curvature(const geometry::Families& families, const std::vector<BondShape>& shapes,
                          const std::vector<double>& areas, const HorizonWeights& weights,
                          const Eigen::VectorXd& curvature, const PointMap& map = {});

}  // namespace plate
