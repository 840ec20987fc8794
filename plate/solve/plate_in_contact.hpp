#pragma once
#include "plate/formulation/elastic_supports.hpp"
#include "plate/formulation/foundations.hpp"
#include "plate/formulation/operator.hpp"

namespace plate {

/// Plate on a unilateral foundation with given contact, which makes it linear. The plate and the elastic supports must
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
  /// Upper bound of |K| state with contact everywhere.
  void absolute_product(const State& state, Forces& forces) const override { plate_.absolute_product(state, forces); }
  Forces diagonal() const override { return plate_.diagonal(); }

  const ContactState& touching() const { return touching_; }

private:
  const Operator& plate_;
  const ElasticSupports& elastic_supports_;
  ContactState touching_;
};

/// Contact at every place.
inline ContactState everywhere(const ElasticSupports& elastic_supports) {
  ContactState result;
  for (const auto& part : elastic_supports.parts())
    result.emplace_back(part->contact ? part->contact->places() : 0, char(1));
  return result;
}

}  // namespace plate
