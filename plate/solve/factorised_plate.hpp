#pragma once
#include <memory>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/solve/matrices/factor.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

class DistributedInverse;

/// The plate itself, assembled and factorised: conjugate gradients with it end after one or two iterations.
class AssembledPlate : public Preconditioner {
public:
  /// `stiffness`: K of all degrees of freedom. `plate`: for its diagonal. `constraints` must outlive this. `shared`: of
  /// the plate, where ranks share it; as of distributed_factor(). Collective there.
  AssembledPlate(const Operator& plate, const Constraints& constraints, const PointMatrix& stiffness,
                 const Boundary* shared = nullptr);

  void apply(const Forces& residual, State& result) const override;

  /// P^T K P u = P^T f for several loads at once.
  std::vector<State> solve(const std::vector<Forces>& loads) const;

  std::size_t bytes() const override { return factor_->bytes(); }

private:
  const Constraints& constraints_;
  Unknowns unknowns_;
  std::unique_ptr<Factor> factor_;
};

/// The factor of a matrix (lower triangle) that is positive but for zeros, which are lifted.
std::unique_ptr<Factor> factorised(const Eigen::SparseMatrix<double>& matrix);

/// Unknowns of a factor that ranks share: all degrees of freedom of owned points, also held ones, which stay zero.
/// `points`: those of the plate, or twice as many with its plane behind it.
Unknowns owned_unknowns(const Boundary& boundary, std::size_t points);

/// The factor of P^T K P that ranks share, of the points of a plate or of them and its plane. `constraints`: of these,
/// and with a halo exchange of all points that those here are coupled to. `free`: above 0 where there is stiffness.
/// `shift` times the diagonal is added. Collective.
std::unique_ptr<Factor> distributed_factor_of_any_sign(PointMatrix folded, const Boundary& boundary,
                                                       const Constraints& constraints, State free, double shift = 0);
/// Likewise of a matrix that must be positive.
/// @throws NumericalError  where the matrix is not positive
std::unique_ptr<Factor> distributed_factor(PointMatrix folded, const Boundary& boundary, const Constraints& constraints,
                                           State free, double shift = 0);

/// The unknowns of nodal forces, one after the other.
Eigen::VectorXd gathered(const Unknowns& unknowns, const Forces& forces);

/// The states of several loads by the factor of the unknowns, with constraints imposed.
std::vector<State> solutions(const Factor& factor, const Unknowns& unknowns, const Constraints& constraints,
                             const std::vector<Forces>& loads);

/// The diagonal of P^T K P, zero at held degrees of freedom.
Forces folded_diagonal(const Operator& plate, const Constraints& constraints);

/// The inverse of a distributed plate, as the libraries of several processes find it: exact as far as they factorise.
class DistributedFactor : public Preconditioner {
public:
  /// `stiffness`: right in the rows and columns of owned points. `seen`: of all points that these are coupled to, where
  /// that are more than the ghosts of `boundary`. `plate`, `boundary` must outlive this.
  DistributedFactor(const Operator& plate, const Boundary& boundary, const PointMatrix& stiffness,
                    const HaloExchange* seen = nullptr);
  ~DistributedFactor() override;

  void apply(const Forces& residual, State& result) const override;
  std::size_t bytes() const override { return 0; }  // the libraries do not say

private:
  const Boundary& boundary_;
  std::vector<std::uint32_t> own_;  // owned points
  std::unique_ptr<DistributedInverse> inverse_;
};

}  // namespace plate
