#pragma once
#include <memory>
#include "plate/solve/assembled_plate.hpp"

#include "plate/bonds/stiffness.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/preconditioner.hpp"
#include "plate/solve/matrices/factor.hpp"
#include "plate/solve/touched_plate.hpp"

namespace plate {

/// The same plate with a horizon of 1.5 spacings and without dilatation, factorised, between two Jacobi sweeps: its
/// stiffness follows that of the plate for every wave that the lattice carries (theory.md, "Statics").
class LocalPlate : public Preconditioner {
public:
  /// `plate` and `boundary` must outlive this. `added`: to the diagonal of what is factorised; empty: nothing.
  LocalPlate(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
             const Discretization& discretization, const Forces& added = {});

  void apply(const Forces& residual, State& result) const override;

  std::size_t bytes() const override { return factor_->bytes(); }

private:
  TouchedPlate plate_;  // on soil that lifts off as if it touched everywhere
  const Constraints& constraints_;
  Forces inverse_diagonal_;  // of the plate, times the weight of a sweep
  Unknowns unknowns_;
  std::unique_ptr<Factor> factor_;
  mutable Forces product_, rest_;
};

/// The plate of LocalPlate: bonds up to 1.5 spacings, bond-based, with the stiffness of the plate given.
FamilyOperator local_operator(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                              const Discretization& discretization);

}  // namespace plate
