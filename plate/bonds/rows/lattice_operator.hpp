#pragma once
#include "plate/bonds/rows/lattice_rows.hpp"

namespace plate {

/// The same plate as a FamilyOperator, with the forces of its LatticeRows, in double or single precision. One call at a
/// time.
class LatticeOperator : public FamilyOperator {
public:
  explicit LatticeOperator(FamilyOperator plate) : FamilyOperator(std::move(plate)), rows_(*this) {}

  void internal_force(const State& state, Forces& forces) const override {
    rows_.internal_force(state, forces);
    attached().add_force(state, forces);
  }
  void internal_force_meanwhile(const State& state, Awaited& rest, Forces& forces) const override {
    rows_.internal_force(state, forces, &rest);
    attached().add_force(state, forces);
  }

  const LatticeRows<double>& rows() const { return rows_; }
  LatticeRows<float> single_rows() const { return LatticeRows<float>(*this); }

private:
  LatticeRows<double> rows_;
};

}  // namespace plate
