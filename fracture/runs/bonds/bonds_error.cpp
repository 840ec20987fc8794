#include "fracture/runs/bonds/bonds_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/bonds/trust.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/galerkin_witness.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/ranks/ranks.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/solution.hpp"
#include "post/report/conclusion.hpp"

namespace fracture {
namespace {

constexpr double told_deflection = 0.01, told_stress = 0.05;
constexpr double thin = 3;  // spacings: thicker plates lock by less than 1 % where 20 spacings span them

bool of_bonds(const plate::Problem& problem) {
  return problem.discretization.formulation == &plate::ordinary && !plate::ranks();
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

void replace_foretold(const plate::Formulation& bonds, std::vector<std::string>& warnings) {
  for (const auto& foretold : plate::foretold_errors(bonds)) std::erase(warnings, foretold);
}

std::string because(const plate::Problem& problem, double share) {
  if (share > 0 || !is_thin(problem)) return "";
  return fmt::format(" (shear locking: thickness is {:.2g} spacings)",
                     problem.section.thickness / problem.discretization.spacing);
}

constexpr auto advice = "set formulation = \"galerkin\"";

}  // namespace

void compare_with_galerkin(const plate::Formulation& bonds, const plate::State& state, const plate::Problem& problem,
                           std::vector<std::string>& warnings) {
  constexpr std::size_t many = 40000;  // points
  if (!of_bonds(problem) || (bonds.points() > many && !is_thin(problem))) return;
  const auto witness = plate::galerkin_witness(problem);
  if (!witness) return;
  replace_foretold(bonds, warnings);
  const auto error = plate::deflection_error(bonds, state, *witness);
  if (error && std::abs(error->share) > told_deflection)
    warnings.push_back(
        fmt::format("largest deflection of bonds is {} that of the Galerkin plate, which is at ({:.4g}, {:.4g}){}: {}",
                    side_of(error->share), error->at.x(), error->at.y(), because(problem, error->share), advice));
  const double right = largest_stress(*witness->plate, witness->state);
  const double share = right > 0 ? largest_stress(bonds, state) / right - 1 : 0;
  if (std::abs(share) > told_stress)
    warnings.push_back(
        fmt::format("largest von Mises stress of bonds is {} that of the Galerkin plate: {}", side_of(share), advice));
}

void compare_under_pressure(const plate::Formulation& bonds, const plate::Problem& problem,
                            std::vector<std::string>& warnings) {
  if (!of_bonds(problem) || !is_thin(problem) || !bonds.held() || bonds.may_move()) return;
  plate::Problem pressed = problem;
  plate::Load pressure;
  pressure.kind = plate::Load::Kind::pressure, pressure.value = 1;
  pressed.loads = {pressure}, pressed.load_cases.clear(), pressed.combinations.clear();
  pressed.initial.reset(), pressed.impact.reset();
  const auto witness = plate::galerkin_witness(pressed);
  if (!witness) return;
  plate::StaticSolution solution;
  try {
    const auto load = plate::nodal_forces(pressure, bonds.cloud(), problem.outline);
    solution =
        plate::solve_static(bonds, load, plate::StaticMethod::cg, plate::Preconditioning::automatic, {}).solution;
  } catch (const plate::NumericalError&) {
    return;
  }
  const auto error = plate::deflection_error(bonds, solution.state, *witness);
  if (!solution.converged || !error) return;
  for (const auto& foretold : plate::foretold_errors(bonds))
    if (foretold.starts_with("thickness")) std::erase(warnings, foretold);
  if (std::abs(error->share) > told_deflection)
    warnings.push_back(
        fmt::format("under a pressure at rest the largest deflection of bonds is {} that of the Galerkin plate{}: {}",
                    side_of(error->share), because(problem, error->share), advice));
}

}  // namespace fracture
