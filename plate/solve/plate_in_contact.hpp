#pragma once
#include "plate/formulation/elastic_supports.hpp"
#include "plate/formulation/foundations.hpp"
#include "plate/formulation/operator.hpp"

namespace plate {

/// A plate on soil that lifts off, as if that touched at some of its places and nowhere else: a linear one. Both must
/// outlive it.
class PlateInContact : public Operator {
public:
  PlateInContact(const Operator& plate, const ElasticSupports& elastic_supports, ContactState touching)
      : plate_(plate), elastic_supports_(elastic_supports), touching_(std::move(touching)) {}

  std::size_t points() const override { return plate_.points(); }
  void internal_force(const State& state, Forces& forces) const override {
    plate_.internal_force(state, forces);
    elastic_supports_.add_change(state, touching_, forces);
  }
  /// Upper bound of |K| state with soil that touches everywhere.
  void absolute_product(const State& state, Forces& forces) const override { plate_.absolute_product(state, forces); }
  Forces diagonal() const override { return plate_.diagonal(); }

  const ContactState& touching() const { return touching_; }

private:
  const Operator& plate_;
  const ElasticSupports& elastic_supports_;
  ContactState touching_;
};

/// At every place.
inline ContactState everywhere(const ElasticSupports& elastic_supports) {
  ContactState result;
  for (const auto& part : elastic_supports.parts())
    result.emplace_back(part->contact ? part->contact->places() : 0, char(1));
  return result;
}

}  // namespace plate
