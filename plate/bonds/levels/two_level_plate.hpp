#pragma once
#include "plate/bonds/levels/coarse_plate.hpp"
#include "plate/bonds/levels/local_plate.hpp"
#include "plate/bonds/levels/transfer.hpp"

namespace plate {

/// The local plate (LocalPlate) on every second point in both directions, factorised, between Jacobi sweeps on the
/// plate itself: a quarter of the unknowns, for plates of many points (theory.md, "Statics").
class TwoLevelPlate : public Preconditioner {
public:
  /// `plate` and `boundary` must outlive this.
  TwoLevelPlate(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                const Discretization& discretization);

  void apply(const Forces& residual, State& result) const override;

  std::size_t bytes() const override { return coarse_plate_->bytes(); }

private:
  TouchedPlate plate_;  // on soil that lifts off as if it touched everywhere: another plate would not be linear
  const Constraints& constraints_;
  Forces inverse_diagonal_;  // of the plate, times the weight of a sweep
  Transfer transfer_;
  std::unique_ptr<CoarsePlate> coarse_plate_;
  mutable Forces product_, rest_, coarse_force_;
  mutable State coarse_;
};

}  // namespace plate
