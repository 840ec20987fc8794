#pragma once
#include <initializer_list>

#include "plate/formulation/formulation.hpp"
#include "post/factors/srif.hpp"

/// What must hold of every number before it is written: each throws plate::NumericalError, saying what failed and when.
namespace post {

/// Numbers by their name.
using Named = std::initializer_list<std::pair<const char*, double>>;
void require_finite(const Named& numbers, const std::string& when);
void require_finite(const std::vector<Srif>& factors, const std::string& when);
/// Displacements of all points.
void require_finite(const plate::State& state, const std::string& when);

/// Work of loads that grow slowly from zero.
double slow_work(const plate::Formulation& plate, const plate::State& state);
/// Of every load at factor 1.
std::vector<plate::Forces> forces_of(const plate::Formulation& plate);

/// Is the state not zero, and the work [energy] of the loads not so small that digits of it are lost?
bool moves(const plate::State& state, double work);

/// For a plate that does not: a plate with a load on any degree of freedom that nothing holds should. Else warns
/// that no load reaches what may move. `loads`: nodal forces, those that act together as one.
void require_motion(const plate::Formulation& plate, const std::vector<plate::Forces>& loads, const plate::State& state,
                    double work, std::vector<std::string>& warnings);

}  // namespace post
