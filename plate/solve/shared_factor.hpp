#pragma once
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/formulation/preconditioner.hpp"
#include "plate/model/ranks/ranks.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// The inverse of a plate that processes share, as the libraries behind Ranks::inverse() find it: exact as far as they
/// factorise.
class SharedFactor : public Preconditioner {
public:
  /// `stiffness`: right in the rows and columns of own points. `seen`: of all points that these are coupled to, where
  /// that are more than the copies of `boundary`. `plate`, `boundary` must outlive this.
  SharedFactor(const Ranks& all, const Operator& plate, const Boundary& boundary, const PointMatrix& stiffness,
               const Exchange* seen = nullptr);

  void apply(const Forces& residual, State& result) const override;
  std::size_t bytes() const override { return 0; }  // the libraries do not say

private:
  const Boundary& boundary_;
  std::vector<std::uint32_t> own_;  // points of this process
  std::unique_ptr<SharedInverse> inverse_;
};

}  // namespace plate
