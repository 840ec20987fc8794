#include "cases/driver/static_solution.hpp"

#include <cmath>
#include <fstream>
#include <string>

#include "cases/driver/assembly_galerkin.hpp"
#include "plate/bonds/levels/two_level_plate.hpp"

namespace cases {

double free_memory() {
  std::ifstream meminfo("/proc/meminfo");
  for (std::string name, unit; meminfo >> name;) {
    double kibibytes = 0;
    if (name == "MemAvailable:" && meminfo >> kibibytes) return 1024 * kibibytes;
    std::getline(meminfo, unit);
  }
  return 0;
}

namespace {

/// Iterations that conjugate gradients with the diagonal take to 1e-8: measured on square plates with a crack, held on
/// two edges and (three times as many) on three points, sides of 125 to 500 spacings, side / thickness from 4 to 200.
double iterations_with_diagonal(const Case& c) {
  const auto [low, high] = geometry::bounding_box(c.outline);
  const double side = (high - low).maxCoeff();
  const bool held = std::any_of(c.supports.begin(), c.supports.end(), [](const auto& s) { return !s.edges.empty(); });
  return (held ? 1 : 3) * (2.2 + 0.084 * side / c.section.thickness) * side / c.discretization.spacing;
}

/// Bytes of the factor of the local plate on every fourth point: measured 220 n log2 n for n = 15,600 to 250,000.
double factor_bytes(std::size_t points) {
  const double coarse = double(points) / 4;
  return 220 * coarse * std::log2(coarse + 2);
}

/// The factor and the iterations with it cost about as much as 600 iterations with the diagonal.
bool two_level_is_faster(const Case& c, const Assembly& assembly) {
  constexpr double worth = 600;
  if (assembly.may_move) return false;  // the factor would enlarge the rounding of a motion without resistance
  return iterations_with_diagonal(c) > worth && factor_bytes(assembly.plate().points()) < free_memory() / 2;
}

/// A Galerkin plate of few points is solved by its own factor. On a lattice coarser plates cost little; triangles have to
/// be found anew for each of them (theory.md, "Statics" of the Galerkin plate).
bool own_factor_is_faster(const Assembly& assembly) {
  const std::size_t few = assembly.galerkin()->cells.graded ? 100000 : 2000;
  return assembly.plate().points() <= few;
}

plate::AssembledPlate assembled_plate(const Assembly& assembly) {
  if (const auto* galerkin = assembly.galerkin()) return {galerkin->op, assembly.boundary.constraints};
  return {*assembly.ordinary(), assembly.boundary.constraints};
}

}  // namespace

void describe(post::Summary::Analysis& analysis, const std::string& method, const plate::StaticSolution& solution, double tolerance) {
  analysis.method = method;
  analysis.iterations = solution.iterations;
  analysis.residual = solution.residual;
  analysis.tolerance = tolerance;
  analysis.stop_reason = solution.stop_reason;
}

plate::Forces total_load(const Assembly& assembly) {
  plate::Forces load = assembly.loads.front().forces;
  for (std::size_t i = 1; i < assembly.loads.size(); ++i) load += assembly.loads[i].forces;
  return load;
}

std::unique_ptr<plate::Preconditioner> galerkin_levels(const Case& c, const Assembly& assembly) {
  const auto& constraints = assembly.boundary.constraints;
  auto coarser = coarser_plates(c, assembly);
  const auto* galerkin = assembly.galerkin();
  if (coarser.empty()) return std::make_unique<plate::AssembledPlate>(galerkin->op, constraints);
  return std::make_unique<plate::GalerkinLevels>(galerkin->op, constraints, galerkin->seen, std::move(coarser));
}

std::unique_ptr<plate::Preconditioner> inverse_of(const Case& c, const Assembly& assembly) {
  constexpr std::size_t many = 100000;  // points
  if (assembly.plate().points() <= many) return std::make_unique<plate::AssembledPlate>(assembled_plate(assembly));
  return galerkin_levels(c, assembly);
}

plate::Forces first_load(const Assembly& assembly) {
  plate::Forces load = plate::Forces::Zero(3, assembly.loads.front().forces.cols());
  for (const auto& one : assembly.loads) load += plate::factor(one.history, 0) * one.forces;
  return load;
}

StaticResult solve_at_rest(const Case& c, const Assembly& assembly, const plate::StaticOptions& options) {
  return solve_at_rest(c, assembly, total_load(assembly), options);
}

StaticResult solve_at_rest(const Case& c, const Assembly& assembly, const plate::Forces& load,
                           const plate::StaticOptions& options) {
  const auto& constraints = assembly.boundary.constraints;
  using enum Analysis::Method;
  using enum Analysis::Preconditioner;
  if (c.analysis.method == adr)
    return {plate::adaptive_dynamic_relaxation(assembly.plate(), constraints, load, options), "adr", {}, 0};
  if (c.analysis.method == direct) {
    const plate::AssembledPlate factor = assembled_plate(assembly);
    return {
        plate::conjugate_gradients(assembly.plate(), constraints, load, options, &factor), "direct", {}, factor.bytes()};
  }
  const auto wanted = c.analysis.preconditioner;
  if (assembly.galerkin() && wanted == automatic && own_factor_is_faster(assembly)) {
    const plate::AssembledPlate factor = assembled_plate(assembly);
    return {plate::conjugate_gradients(assembly.plate(), constraints, load, options, &factor), "cg", "factor", factor.bytes()};
  }
  if (assembly.galerkin() && wanted != diagonal) {
    const auto coarser = galerkin_levels(c, assembly);
    return {plate::conjugate_gradients(assembly.plate(), constraints, load, options, coarser.get()), "cg", "levels",
            coarser->bytes()};
  }
  if (wanted == diagonal || (wanted == automatic && !two_level_is_faster(c, assembly)))
    return {plate::conjugate_gradients(assembly.plate(), constraints, load, options), "cg", "diagonal", 0};
  if (wanted == local) {
    const plate::LocalPlate twin(*assembly.ordinary(), assembly.boundary, c.section, c.discretization);
    return {plate::conjugate_gradients(assembly.plate(), constraints, load, options, &twin), "cg", "local", twin.bytes()};
  }
  const plate::TwoLevelPlate coarse(*assembly.ordinary(), assembly.boundary, c.section, c.discretization);
  return {plate::conjugate_gradients(assembly.plate(), constraints, load, options, &coarse), "cg", "two_level",
          coarse.bytes()};
}

}  // namespace cases
