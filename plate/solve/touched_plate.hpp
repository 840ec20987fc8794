#pragma once
#include "plate/formulation/attached_stiffness.hpp"
#include "plate/formulation/foundations.hpp"
#include "plate/formulation/operator.hpp"

namespace plate {

/// A plate on soil that lifts off, as if that touched at some of its places and nowhere else: a linear one. Both must
/// outlive it.
class TouchedPlate : public Operator {
public:
  TouchedPlate(const Operator& plate, const AttachedStiffness& attached, Touching touching)
      : plate_(plate), attached_(attached), touching_(std::move(touching)) {}

  std::size_t points() const override { return plate_.points(); }
  void internal_force(const State& state, Forces& forces) const override {
    plate_.internal_force(state, forces);
    attached_.add_change(state, touching_, forces);
  }
  /// Upper bound of |K| state with soil that touches everywhere.
  void absolute_product(const State& state, Forces& forces) const override { plate_.absolute_product(state, forces); }
  Forces diagonal() const override { return plate_.diagonal(); }

  const Touching& touching() const { return touching_; }

private:
  const Operator& plate_;
  const AttachedStiffness& attached_;
  Touching touching_;
};

/// At every place.
inline Touching everywhere(const AttachedStiffness& attached) {
  Touching result;
  for (const auto& part : attached.parts()) result.emplace_back(part->contact ? part->contact->places() : 0, char(1));
  return result;
}

}  // namespace plate
