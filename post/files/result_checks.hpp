#pragma once
#include <initializer_list>
#include <optional>

#include <string>
#include <utility>
#include <vector>

#include "plate/model/state.hpp"

namespace plate {
class Formulation;
struct StaticResult;
}  // namespace plate

/// Checks applied to results before they are written: each throws plate::NumericalError, saying what failed and when.
namespace post {

struct Srif;

/// Numbers by their name.
using Named = std::initializer_list<std::pair<const char*, double>>;
void require_finite(const Named& numbers, const std::string& when);
void require_finite(const std::vector<Srif>& factors, const std::string& when);
/// Displacements of all points of a plate. Collective.
void require_finite(const plate::State& state, const std::string& when, const plate::Formulation& plate);

/// Work of loads that grow slowly from zero.
double slow_work(const plate::Formulation& plate, const plate::State& state);
double slow_work(const plate::Formulation& plate, const plate::StaticResult& result);
/// Work of one load [3 x points] that grows slowly from zero.
double slow_work(const plate::Formulation& plate, const plate::Forces& load, const plate::State& state);
/// Strain energy of a plate whose supports are displaced while all free degrees of freedom rest; that of equilibria is
/// small beside it. 0 where the supports rest.
double energy_about(const plate::Formulation& plate, const plate::State& lift);
double energy_about(const plate::Formulation& plate);  // of all settlements together
/// Nodal forces of every load at factor 1; of a prescribed support displacement, the force that it exerts at first.
std::vector<plate::Forces> forces_of(const plate::Formulation& plate);

/// True where the values are zero on all ranks that share the plate. Collective, as moves().
bool is_zero(const plate::State& values, const plate::Formulation& plate);
/// True where the state is not zero, and the work [energy] of the loads not so small that digits of it are lost.
bool moves(const plate::State& state, double work, const plate::Formulation& plate);

/// Throws NumericalError for a plate that does not move but has a load on a degree of freedom that nothing holds. Else
/// warns that no load reaches what may move, or that loads cancel. `loads`: nodal forces, those that act together as
/// one.
void require_motion(const plate::Formulation& plate, const std::vector<plate::Forces>& loads, const plate::State& state,
                    double work, std::vector<std::string>& warnings);

/// Checks the energy balance of a plate: its energy is the work of its loads. An imbalance comes of steps that are too
/// long, of a force that is not the derivative of an energy, or of a state that is no equilibrium.
class EnergyBalance {
public:
  enum class Plate { rests, moves, grows };
  explicit EnergyBalance(Plate plate) : plate_(plate) {}

  struct Terms {
    double energy;    // strain, kinetic, and spent on growth so far: none is negative
    double discrete;  // the energy that central differences conserve, be they stable or not
    double work;      // of the loads so far
  };
  /// Throws plate::NumericalError where the discrete energy and the work, in motion both since the first call, differ
  /// by more than a hundredth of the largest work that there has been; and where the energy of the last call was some
  /// times as much: loads that set in have done no work yet when the plate begins to move.
  void check(const Terms& now, const std::string& when);

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(largest_work_, last_energy_, before_);
  }

private:
  Plate plate_;
  double largest_work_ = 0, last_energy_ = 0;
  std::optional<double> before_;  // what was kept less the work at the first call
};

}  // namespace post
