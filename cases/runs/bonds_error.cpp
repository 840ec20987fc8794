#include "cases/runs/bonds_error.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/bonds/validation.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "plate/solve/statics.hpp"
#include "post/report/conclusion.hpp"

namespace cases {
namespace {

constexpr double told_deflection = 0.01, told_stress = 0.05, told_frequency = 0.01;
constexpr std::size_t many_points = 40000;  // of thick plates: no second plate is solved for more
constexpr double thin = 3;  // spacings: thicker plates lock by less than 1 % where 20 spacings span them

bool of_bonds(const plate::Formulation& plate, const plate::Problem& problem) {
  return problem.discretization.formulation == &plate::ordinary && !plate.distributed();
}

bool is_thin(const plate::Problem& problem) {
  return problem.section.thickness < thin * problem.discretization.spacing;
}

std::string side_of(double share) {
  return fmt::format("{:.2g} % {}", 100 * std::abs(share), share < 0 ? "below" : "above");
}

double largest_stress(const plate::Formulation& plate, const plate::State& state) {
  post::Extremes extremes(plate);
  extremes.row({0, 0, state, {}, 0, 0, 0});
  for (const auto& peak : extremes.found())
    if (peak.quantity == "von_mises") return peak.value;
  return 0;
}

std::string because(const plate::Problem& problem, double share) {
  if (share > 0 || !is_thin(problem)) return "";
  return fmt::format(" (shear locking, thickness {:.2g} spacings)",
                     problem.section.thickness / problem.discretization.spacing);
}

constexpr auto galerkin_advice = "set formulation = \"galerkin\"";

/// The Galerkin plate of a problem of bonds, and its equilibrium under all loads.
struct GalerkinWitness {
  std::unique_ptr<plate::Formulation> plate;
  plate::State state;  // [3 x points]
};

/// The largest deflection of bonds against that of the Galerkin plate, each at its own points.
struct DeflectionError {
  double share;        // |w| of bonds / |w| of the Galerkin plate - 1
  geometry::Point at;  // where that of the Galerkin plate is largest
};

/// Returns the problem of `bonds` for the Galerkin plate, with the same spacing.
plate::Problem of_galerkin(const plate::Problem& bonds) {
  plate::Problem result = bonds;
  result.discretization = {};
  result.discretization.spacing = bonds.discretization.spacing;
  result.discretization.formulation = &plate::galerkin;
  const auto& holes = bonds.outline.holes;
  const auto round = [](const auto& hole) { return std::holds_alternative<geometry::Circle>(hole); };
  if (!holes.empty() && std::ranges::all_of(holes, round))
    result.discretization.hole_spacing = bonds.discretization.spacing / 2;
  return result;
}

/// Erases the estimated error of the deflection, where a comparison states it.
void erase_estimate_of_locking(const plate::Formulation& bonds, std::vector<std::string>& warnings) {
  for (const auto& estimated : plate::estimated_errors(bonds))
    if (estimated.starts_with("thickness")) std::erase(warnings, estimated);
}

struct Largest {
  double w = 0;
  geometry::Point at{0, 0};
};

/// Largest |w| of all points at least `away` from point forces [length].
Largest largest(const plate::Formulation& plate, const plate::State& state, double away) {
  const auto& cloud = plate.cloud();
  const auto near_force = [&](const geometry::Point& x) {
    return std::ranges::any_of(plate.problem().loads, [&](const plate::Load& load) {
      const auto place = load.point();
      return place && (*place - x).norm() < away;
    });
  };
  Largest result;
  for (std::size_t k = 0; k < cloud.plate_points; ++k)
    if (const double w = std::abs(state(0, Eigen::Index(k))); w > result.w && !near_force(cloud.positions[k]))
      result = {w, cloud.positions[k]};
  return result;
}

/// Solves the Galerkin plate with the spacing of the problem, and half of it at round holes. Absent where the Galerkin
/// plate cannot carry the problem or finds no equilibrium. One process only.
std::optional<GalerkinWitness> galerkin_witness(const plate::Problem& problem) {
  const plate::StaticOptions options{1e-5, 20000, {}, {}};
  constexpr std::size_t many =
      4000;  // points; graded ones would take their factor, which is 2.5 times slower for 30,000
  try {
    auto made = plate::discretise(of_galerkin(problem));
    if (!plate::loose(*made.plate).empty()) return std::nullopt;
    plate::Analysis analysis;
    if (made.plate->points() > many) analysis.preconditioner = plate::Preconditioning::levels;
    auto found = plate::static_solution(*made.plate, analysis, options);
    if (!found.solution.converged) return std::nullopt;
    return GalerkinWitness{std::move(made.plate), std::move(found.solution.state)};
  } catch (const plate::Refused&) {  // a round hole that cells cannot follow, a support that they do not know
    return std::nullopt;
  } catch (const plate::NumericalError&) {
    return std::nullopt;
  }
}

/// Returns the largest deflection error. In plates thicker than a spacing only points four spacings away from point
/// forces count, where there are such points. Absent for a plate at rest under no load.
std::optional<DeflectionError> deflection_error(const plate::Formulation& bonds, const plate::State& state,
                                                const GalerkinWitness& witness) {
  const double spacing = bonds.discretization().spacing;
  const bool thick = bonds.section().thickness > spacing;  // then deflections grow without limit towards forces
  for (const double away : {thick ? 4 * spacing : 0, 0.0}) {
    const auto own = largest(bonds, state, away), right = largest(*witness.plate, witness.state, away);
    if (right.w > 0) return DeflectionError{own.w / right.w - 1, right.at};
  }
  return std::nullopt;
}

}  // namespace

void compare_with_galerkin(const plate::Formulation& bonds, const plate::State& state, const plate::Problem& problem,
                           std::vector<std::string>& warnings) {
  if (!of_bonds(bonds, problem) || (bonds.points() > many_points && !is_thin(problem))) return;
  const auto witness = galerkin_witness(problem);
  if (!witness) return;
  for (const auto& estimated : plate::estimated_errors(bonds)) std::erase(warnings, estimated);
  const auto error = deflection_error(bonds, state, *witness);
  if (error && std::abs(error->share) > told_deflection)
    warnings.push_back(fmt::format(
        "largest deflection of bonds is {} that of the Galerkin plate, at ({:.4g}, {:.4g}){}; {}",
        side_of(error->share), error->at.x(), error->at.y(), because(problem, error->share), galerkin_advice));
  const double right = largest_stress(*witness->plate, witness->state);
  const double share = right > 0 ? largest_stress(bonds, state) / right - 1 : 0;
  if (std::abs(share) > told_stress)
    warnings.push_back(fmt::format("largest von Mises stress of bonds is {} that of the Galerkin plate; {}",
                                   side_of(share), galerkin_advice));
}

void compare_under_pressure(const plate::Formulation& bonds, const plate::Problem& problem,
                            std::vector<std::string>& warnings, const std::string& remedy) {
  if (!of_bonds(bonds, problem) || !is_thin(problem) || !bonds.held() || bonds.may_move()) return;
  plate::Problem pressed = problem;
  const plate::Load pressure{plate::Pressure{.value = 1}};
  pressed.loads = {pressure}, pressed.load_cases.clear(), pressed.combinations.clear();
  pressed.initial.reset(), pressed.impact.reset();
  const auto witness = galerkin_witness(pressed);
  if (!witness) return;
  plate::StaticSolution solution;
  try {
    const auto load = plate::nodal_forces(pressure, bonds.cloud(), problem.outline);
    solution =
        plate::solve_static(bonds, load, plate::StaticMethod::cg, plate::Preconditioning::automatic, {}).solution;
  } catch (const plate::NumericalError&) {
    return;
  }
  const auto error = deflection_error(bonds, solution.state, *witness);
  if (!solution.converged || !error) return;
  erase_estimate_of_locking(bonds, warnings);
  if (std::abs(error->share) > told_deflection)
    warnings.push_back(
        fmt::format("under static pressure largest deflection of bonds is {} that of the Galerkin plate{}; {}",
                    side_of(error->share), because(problem, error->share), remedy));
}

void compare_first_frequency(const plate::Formulation& bonds, double frequency, const plate::Problem& problem,
                             const plate::FrequencyOptions& options, double rotary_inertia,
                             std::vector<std::string>& warnings) {
  if (!of_bonds(bonds, problem) || bonds.points() > many_points || !bonds.held() || bonds.may_move()) return;
  double right = 0;
  try {
    const auto made = plate::discretise(of_galerkin(problem));
    const auto& witness = *made.plate;
    if (!plate::loose(witness).empty()) return;
    const auto inverse = witness.inverse_of_shifted(options.shift);
    plate::FrequencyOptions first;
    first.modes = 1, first.shift = options.shift, first.preconditioner = inverse.get();
    right =
        plate::frequencies(witness, witness.constraints(), witness.mass(rotary_inertia), first).modes.front().frequency;
  } catch (const plate::Refused&) {
    return;
  } catch (const plate::NumericalError&) {
    return;
  }
  erase_estimate_of_locking(bonds, warnings);
  if (const double share = frequency / right - 1; std::abs(share) > told_frequency)
    warnings.push_back(fmt::format("first frequency of bonds is {} that of the Galerkin plate{}; {}", side_of(share),
                                   because(problem, -share), galerkin_advice));
}

}  // namespace cases
