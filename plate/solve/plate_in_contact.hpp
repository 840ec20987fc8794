#pragma once
#include <functional>

#include "plate/formulation/elastic_supports.hpp"
#include "plate/formulation/foundations.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

class Formulation;
struct StaticSolution;

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

/// Subtracts from the stiffness of a plate, with contact everywhere, that of the places without contact.
PointMatrix with_contact_at(const ContactState& touching, const ElasticSupports& elastic_supports,
                            PointMatrix everywhere);

/// A plate at rest on unilateral foundations, as contact_with_soil() asks for it.
struct RestOnSoil {
  /// Equilibrium with given contact. `start`: a state near it; null: none.
  std::function<StaticSolution(const ContactState& touching, const State* start)> solve;
  std::function<ContactState(const State&)> touching;
  std::function<double(const State&)> energy;  // with the potential of the loads
};

/// Finds what soil touches: plates with given contact are solved until the contact is what is pressed. Collective.
/// @throws NumericalError  where nothing holds the plate any more
StaticSolution contact_with_soil(const Formulation& plate, const RestOnSoil& rest);

/// Checks an equilibrium on soil: a plate that flies off goes so far that rounding hides what is left of its load.
/// `lift`: as total_lift().
/// @throws NumericalError  where it does
void require_contact(const Formulation& plate, const Forces& load, const State& lift, const State& state);

/// Potential of a load that is not folded.
double potential(const Formulation& plate, const Forces& load, const State& state);

}  // namespace plate
