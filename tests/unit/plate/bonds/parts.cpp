#include "tests/unit/plate/bonds/parts.hpp"

#include <stdexcept>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/bonds/part_of_lattice.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/initial_conditions.hpp"
#include "plate/solve/plate_in_contact.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"

namespace parts {

Problem problem_of(geometry::Outline outline, std::vector<Support> supports, std::vector<Load> loads) {
  Problem problem;
  problem.outline = std::move(outline);
  problem.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  problem.supports = std::move(supports);
  problem.loads = std::move(loads);
  problem.discretization.spacing = 0.01;
  problem.discretization.formulation = &ordinary;
  return problem;
}

Load pressure(double value) {
  return {Pressure{.value = value}};
}

Problem own(Problem problem) {
  const auto again = [](Formula& formula) {
    if (formula.given()) formula = Formula(formula.text());
  };
  const auto again_where_given = [&](auto& action) {
    if constexpr (requires { action.formula; }) again(action.formula);
  };
  for (auto& load : problem.loads) std::visit(again_where_given, load.action);
  if (auto& initial = problem.initial) again(initial->deflection), again(initial->velocity);
  return problem;
}

namespace {

/// Where and how a motion ends, whoever computed it.
struct End {
  double limit = 0;                           // of the time step
  std::vector<std::vector<double>> energies;  // strain, kinetic, discrete and outer energy of every row, and dissipated
  ContactForces contact_force;
  std::map<std::array<long, 2>, std::array<double, 3>> state;  // by cell
};

/// What this process, or the only one, has of the steps.
End moved(const Problem& given, const How& how, const Communicator& all) {
  const auto problem = own(given);
  const auto plate = discretise(problem, all).plate;
  const auto& cloud = plate->cloud();
  const auto cell = [&](std::uint32_t k) { return geometry::cell_of(plate->boundary().lattice[k]); };
  const auto mass = plate->mass();
  State start(3, mass.cols());
  for (std::uint32_t k = 0; k < cloud.size(); ++k)
    for (int c = 0; c < 3; ++c) start(c, k) = std::sin(double(7 * cell(k)[0] + 13 * cell(k)[1] + c));
  End end;
  const auto begin = begin_of_motion(*plate, 1);
  Analysis analysis;
  analysis.damping = how.damping;
  const auto& elastic_supports = plate->boundary().elastic_supports;
  const double free = stable_time_step(PlateInContact(*plate, elastic_supports, everywhere(elastic_supports)),
                                       plate->constraints(), mass, start);
  end.limit = stable_step(free, *plate, analysis, begin);
  const auto part = part_of_lattice(all, problem.outline, problem.discretization);
  DynamicOptions options{0.9 * end.limit, how.steps, 10};
  if (how.mixed) options.single = plate->single_precision();
  options.start = begin.deflected, options.bent = begin.deflected.size() > 0, options.velocity = begin.velocity;
  options.given = begin.given, options.impact = begin.impact, options.own = plate->boundary().map.owned;
  options.mass_damping = how.damping.mass, options.stiffness_damping = how.damping.stiffness;
  options.unconstrained_mass = driven_mass(*plate, 1);
  central_differences(*plate, plate->constraints(), mass, plate->loads(), options, [&](const Instant& now) {
    end.energies.push_back({now.strain_energy, now.kinetic_energy, now.discrete_kinetic_energy, now.external_work,
                            now.dissipated, now.potential});
    if (now.contact_force)
      end.contact_force.push_back({now.contact_force->place, now.contact_force->velocity, now.contact_force->force,
                                   now.contact_force->touching});
    if (now.step < how.steps) return;
    for (std::uint32_t k = 0; k < cloud.plate_points; ++k)
      if (!part || part->own.contains(cell(k)))
        end.state[cell(k)] = {now.state(0, k), now.state(1, k), now.state(2, k)};
  });
  return end;
}

End moved_by(int processes, const Problem& problem, const How& how) {
  End all;
  const auto put = [&](End& own, bool first) {
    all.state.merge(own.state);
    if (first) all.limit = own.limit, all.energies = own.energies, all.contact_force = own.contact_force;
    CHECK(own.state.empty());  // nobody else has any of these points
  };
  together(
      processes, [&](const Communicator& communicator) { return moved(problem, how, communicator); }, put);
  return all;
}

/// What this process, or the only one, has of an equilibrium, and the iterations to it.
struct Rest {
  std::size_t iterations = 0;
  double strain = 0;
  std::vector<std::array<double, 3>> pieces;  // points, free motions, abscissa
  std::map<std::array<long, 2>, std::array<double, 3>> state;
};

Rest at_rest(const Problem& given, StaticMethod method, Preconditioning wanted, const Communicator& all) {
  const auto problem = own(given);
  const auto plate = discretise(problem, all).plate;
  const auto part = part_of_lattice(all, problem.outline, problem.discretization);
  const auto found =
      solve_static(*plate, plate->total_load(), method, wanted, {1e-7, 20000, {}}, total_lift(*plate)).solution;
  if (!found.converged) throw std::runtime_error("the plate has no equilibrium");  // in any of several threads
  Rest rest{found.iterations, plate->strain_energy(found.state), {}, {}};
  for (const auto& piece : plate->pieces())
    rest.pieces.push_back({double(piece.points), double(piece.free_modes), piece.position.x()});
  for (std::uint32_t k = 0; k < plate->cloud().plate_points; ++k)
    if (const auto cell = geometry::cell_of(plate->boundary().lattice[k]); !part || part->own.contains(cell))
      rest.state[cell] = {found.state(0, k), found.state(1, k), found.state(2, k)};
  return rest;
}

}  // namespace

ContactForces check(const Problem& problem, const How& how) {
  const End whole = moved(problem, how, single_process()), one = moved_by(1, problem, how);
  REQUIRE(whole.state.size() == one.state.size());
  CHECK(one.limit == Approx(whole.limit).epsilon(1e-9));
  double largest = 0, apart = 0;
  for (const auto& [cell, value] : whole.state)
    for (std::size_t c = 0; c < 3; ++c) {
      largest = std::max(largest, std::abs(value[c]));
      apart = std::max(apart, std::abs(value[c] - one.state.at(cell)[c]));
    }
  CHECK(largest > 0);
  CHECK(apart < (how.mixed ? 1e-5 : 1e-10) * largest);
  double energy = 0, other = 0;
  REQUIRE((whole.energies.size() == one.energies.size() && whole.contact_force.size() == one.contact_force.size()));
  for (std::size_t row = 0; row < whole.energies.size(); ++row)
    for (std::size_t i = 0; i < whole.energies[row].size(); ++i) {
      energy = std::max(energy, std::abs(whole.energies[row][i]));
      other = std::max(other, std::abs(whole.energies[row][i] - one.energies[row][i]));
    }
  CHECK(other < (how.mixed ? 1e-5 : 1e-10) * energy);
  if (!whole.contact_force.empty()) CHECK(whole.contact_force.back()[3] > 0);  // it has touched the plate
  for (std::size_t row = 0; row < whole.contact_force.size(); ++row)
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(one.contact_force[row][i] == Approx(whole.contact_force[row][i]).epsilon(1e-9));
  for (const int processes : how.processes) {
    INFO(processes << " processes");
    const End many = moved_by(processes, problem, how);
    CHECK(many.limit == one.limit);
    CHECK((many.energies == one.energies && many.contact_force == one.contact_force));
    CHECK((many.state == one.state));
  }
  return whole.contact_force;
}

void check_rest(const Problem& problem, StaticMethod method, Preconditioning wanted, double bound,
                const std::vector<int>& processes) {
  const Rest whole = at_rest(problem, method, wanted, single_process());
  Rest one;
  std::vector<int> counts{1};
  counts.insert(counts.end(), processes.begin(), processes.end());
  for (const int count : counts) {
    INFO(count << " processes");
    Rest all;
    const auto put = [&](Rest& own, bool first) {
      all.state.merge(own.state);
      if (first) all.iterations = own.iterations, all.strain = own.strain, all.pieces = own.pieces;
    };
    together(
        count, [&](const Communicator& communicator) { return at_rest(problem, method, wanted, communicator); }, put);
    REQUIRE(all.state.size() == whole.state.size());
    CHECK((all.pieces == whole.pieces));
    CHECK(std::abs(double(all.iterations) - double(whole.iterations)) <= 0.01 * double(whole.iterations));
    if (count == 1) one = all;
    double largest = 0, apart = 0, apart_of_whole = 0;
    for (const auto& [cell, value] : whole.state)
      for (std::size_t c = 0; c < 3; ++c) {
        largest = std::max(largest, std::abs(value[c]));
        apart_of_whole = std::max(apart_of_whole, std::abs(value[c] - all.state.at(cell)[c]));
        apart = std::max(apart, std::abs(one.state.at(cell)[c] - all.state.at(cell)[c]));
      }
    CAPTURE(apart / largest, apart_of_whole / largest, all.strain / one.strain - 1);
    CHECK(largest > 0);
    CHECK(apart <= bound * largest);
    CHECK(apart_of_whole < 1e-7 * largest);
    CHECK(std::abs(all.strain - one.strain) <= bound * one.strain);
    if (bound == 0) CHECK(all.iterations == one.iterations);
  }
}

}  // namespace parts
