#include "plate/solve/validation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "plate/formulation/formulation.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/process.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/wording.hpp"
#include "plate/solve/analysis.hpp"

namespace plate {
namespace {

void check_modes(const Formulation& plate, const Analysis& analysis, Validation& result) {
  if (analysis.kind != Analysis::Kind::frequencies) return;
  const auto most = std::size_t(sum_of_all(plate, double((plate.mass().array() > 0).count()))) / 4;
  if (analysis.modes > most)
    result.refusals.push_back({Subject::modes, 0,
                               fmt::format("{} given, must be at most {}, a quarter of the plate's degrees of freedom",
                                           analysis.modes, most)});
}

/// Pins alone hold a plate by their triangle; each acts up to 0.7 of a spacing beside its place.
void check_pins(const Formulation& plate, const Analysis& analysis, Validation& result) {
  constexpr double least = 1, few = 5;  // spacings
  const auto wide = plate.width_of_pins();
  if (!wide || analysis.kind != Analysis::Kind::static_) return;
  const auto said =
      fmt::format("the pins are within {:.2g} spacings of one line, each acting at the nearest lattice point", *wide);
  if (*wide < least)
    result.refusals.push_back({Subject::support, 0, said + ": refine, or choose formulation = \"galerkin\""});
  else if (*wide < few)
    result.warnings.push_back(said + ": deflections may be far off; set formulation = \"galerkin\"");
}

/// Checks that the plate is held. In motion a plate may move freely; loose pieces give a warning.
void check_held(const Formulation& plate, const Analysis& analysis, Validation& result) {
  if (analysis.kind == Analysis::Kind::frequencies) {
    const auto zero = unresisted_motions(plate);
    result.refusals.insert(result.refusals.end(), zero.begin(), zero.end());
  }
  const auto& initial = plate.problem().initial;
  if (analysis.kind == Analysis::Kind::dynamic && analysis.precision == Analysis::Precision::mixed && initial &&
      initial->velocity.given() && !plate.held())
    result.refusals.push_back({Subject::precision, 0,
                               "\"mixed\" given: a loose plate with a velocity moves far beside what bends it, which "
                               "single precision rounds away; choose \"double\""});
  const auto found = loose(plate);
  if (analysis.finds_equilibrium())
    result.refusals.insert(result.refusals.end(), found.begin(), found.end());
  else if (!found.empty() && plate.pieces().size() > 1 && !plate.held())
    for (const auto& one : found) result.warnings.push_back(one.what);
}

void check_two_level(const Formulation& plate, const Analysis& analysis, Validation& result) {
  if (plate.may_move() && analysis.preconditioner == Preconditioning::two_level)
    result.refusals.push_back(
        {Subject::preconditioner, 0,
         "\"two_level\" needs a plate without motions that nothing resists, and parts of this one hang by bonds along "
         "one line; choose \"diagonal\""});
}

/// The stiffness of a plate and its plane and its factor take 330 n log2 p bytes at their peak, n bonds and p points:
/// measured 326 with cells (3,750 and 10,250 points), 380 to 420 with bonds over 3 spacings (1,600 to 6,400).
void check_memory(const Formulation& plate, const Analysis& analysis, Validation& result) {
  constexpr double per_bond = 330;
  const auto& problem = plate.problem();
  if (!(problem.stretches || rests_with_plane(problem)) || analysis.kind == Analysis::Kind::dynamic) return;
  const double bytes =
      per_bond * double(plate.bonds() + plate.fictitious_bonds()) * std::log2(double(plate.points()) + 2);
  const double there = free_memory(), spacing = plate.discretization().spacing;
  if (there > 0 && bytes > there)
    result.refusals.push_back(
        {Subject::spacing, 0,
         fmt::format(
             "{:g} given: a plate of {} points with its plane takes {:.3g} GB, {:.3g} GB are free; set `spacing` = "
             "{:.2g}",
             spacing, plate.points(), bytes / 1e9, there / 1e9, spacing * std::sqrt(bytes / there))});
}

/// Largest temperature of a face, less that without stress, where each load acts so many times.
double temperature_of(const Problem& problem, const std::vector<double>& times) {
  double mean = 0, difference = 0;
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    if (const auto* heat = problem.loads[i].as<Temperature>())
      mean += times[i] * heat->mean, difference += times[i] * heat->value;
  return std::abs(mean) + std::abs(difference) / 2;
}

/// The load case or combination that is hottest, in words, and its temperature; of one load without words.
std::pair<std::string, double> hottest(const Problem& problem) {
  std::vector<std::vector<double>> of_cases;  // how often each load acts
  for (std::size_t i = 0; i < problem.load_cases.size(); ++i) {
    auto& times = of_cases.emplace_back(problem.loads.size(), 0);
    for (const auto load : loads_of(problem, i)) times[load] = 1;
  }
  if (of_cases.empty()) return {"", temperature_of(problem, std::vector<double>(problem.loads.size(), 1))};
  std::pair<std::string, double> result{"", 0};
  const auto look = [&](const std::string& name, const std::vector<double>& times) {
    if (const double there = temperature_of(problem, times); there > result.second) result = {" in " + name, there};
  };
  for (std::size_t i = 0; i < of_cases.size(); ++i) look("case " + problem.load_cases[i].name, of_cases[i]);
  for (const auto& combination : problem.combinations) {
    const auto factors = factors_of(combination, problem.load_cases);
    std::vector<double> times(problem.loads.size(), 0);
    for (std::size_t i = 0; i < of_cases.size(); ++i)
      for (std::size_t k = 0; k < times.size(); ++k) times[k] += factors[i] * of_cases[i][k];
    look("combination " + combination.name, times);
  }
  return result;
}

/// Warns of temperatures that strain a section beyond small strains: most often an expansion without its power of ten.
void check_thermal_strain(const Formulation& plate, Validation& result) {
  constexpr double small = 0.05;
  const auto& problem = plate.problem();
  const auto& section = problem.section;
  double expansion = section.expands_by_plies() ? 0 : std::abs(section.thermal_expansion);
  for (const auto& ply : section.plies)
    for (const auto& alpha : {ply.alpha1, ply.alpha2})
      expansion = std::max(expansion, std::abs(alpha.value_or(section.thermal_expansion)));
  const auto [where, temperature] = hottest(problem);
  if (const double strain = expansion * temperature; strain > small)
    result.warnings.push_back(fmt::format(
        "temperatures strain the plate by {:.2g}{}, beyond small strains; set {}", strain, where,
        section.expands_by_plies() ? "a smaller alpha1 or alpha2 of its plies" : "a smaller `thermal_expansion`"));
}

}  // namespace

Validation validate(const Formulation& plate, const Analysis& analysis) {
  Validation result;
  check_modes(plate, analysis, result);
  check_pins(plate, analysis, result);
  check_held(plate, analysis, result);
  check_two_level(plate, analysis, result);
  check_memory(plate, analysis, result);
  check_thermal_strain(plate, result);
  return result;
}

std::vector<Refusal> errors_in_lengths(const Problem& problem, const Analysis& analysis) {
  std::vector<Refusal> found;
  const double spacing = problem.discretization.spacing;
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const double widest = (high - low).minCoeff() / 4;  // four cells: fewer have no interior
  if (spacing > widest * (1 + 1e-9))
    found.push_back({Subject::spacing, 0,
                     fmt::format("{} given, must be at most {}, a quarter of the plate's smaller side",
                                 number_text(spacing), number_text(widest))});
  if (analysis.precision != Analysis::Precision::mixed) return found;
  // Rounding of the deflection against the shear strains of bending, 2^-24 (L / spacing) (L / h)^2: up to 0.3 K1(t) was
  // within a thousandth of that in double (measured: 8e-6 at 0.003, 5e-5 at 0.07, 8e-4 at 0.3).
  constexpr double largest = 0.3;
  const double side = (high - low).maxCoeff(), slender = side / problem.section.thickness;
  const double rounding = std::numeric_limits<float>::epsilon() / 2 * side / spacing * slender * slender;
  if (rounding > largest)
    found.push_back(
        {Subject::precision, 0,
         fmt::format("\"mixed\" given: so thin a plate loses its shear strains in the rounding of its deflection, "
                     "2^-24 (side/spacing) (side/thickness)^2 = {:.2g}, above {:g}; choose \"double\"",
                     rounding, largest)});
  return found;
}

void require_finite(const State& state, const std::string& when) {
  constexpr std::array names{"w", "theta_x", "theta_y"};
  const Eigen::Index points = state.cols();
  Eigen::Index first = points;
#pragma omp parallel for schedule(static) reduction(min : first)
  for (Eigen::Index k = 0; k < points; ++k)
    if (!state.col(k).allFinite()) first = std::min(first, k);
  if (first == points) return;
  std::size_t component = 0;
  while (std::isfinite(state(Eigen::Index(component), first))) ++component;
  throw NumericalError(std::string(names[component]) + " of point " + std::to_string(first) + " is not finite " + when,
                       std::size_t(first));
}

void require_finite(const State& state, const std::string& when, const Constraints& constraints) {
  if (!constraints.distributed()) return require_finite(state, when);
  std::string wrong;
  try {
    require_finite(state, when);
  } catch (const NumericalError& error) {
    wrong = "process " + std::to_string(constraints.rank()) + ": " + error.what();
  }
  for (const auto& one : texts_of_all(constraints, wrong))
    if (!one.empty()) throw NumericalError(one);
}

}  // namespace plate
