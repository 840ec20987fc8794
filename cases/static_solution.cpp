#include "cases/static_solution.hpp"

#include <sys/sysinfo.h>

#include <cmath>

#include "plate/local_plate.hpp"

namespace cases {
namespace {

/// Iterations that conjugate gradients with the diagonal take to 1e-8: measured on square plates with a crack, held on
/// two edges and (three times as many) on three points, sides of 125 to 500 spacings, side / thickness from 4 to 200.
double iterations_with_diagonal(const Case& c) {
  const auto [low, high] = geometry::bounding_box(c.outline);
  const double side = (high - low).maxCoeff();
  const bool held = std::any_of(c.supports.begin(), c.supports.end(), [](const auto& s) { return !s.edges.empty(); });
  return (held ? 1 : 3) * (2.2 + 0.084 * side / c.section.thickness) * side / c.discretization.spacing;
}

/// Bytes of the factor of the local plate: measured 220 N log2 N from 15,600 to 250,000 points.
double factor_bytes(std::size_t points) {
  return 220 * double(points) * std::log2(double(points) + 2);
}

double free_memory() {
  struct sysinfo info;
  return sysinfo(&info) == 0 ? double(info.freeram + info.bufferram) * info.mem_unit : 0;
}

/// The factor costs about as much as 1500 iterations with the diagonal.
bool local_is_faster(const Case& c, const Assembly& assembly) {
  constexpr double worth = 1500;
  return iterations_with_diagonal(c) > worth && factor_bytes(assembly.plate.points()) < free_memory() / 2;
}

}  // namespace

plate::Forces total_load(const Assembly& assembly) {
  plate::Forces load = assembly.loads.front().forces;
  for (std::size_t i = 1; i < assembly.loads.size(); ++i) load += assembly.loads[i].forces;
  return load;
}

StaticResult solve_at_rest(const Case& c, const Assembly& assembly, const plate::StaticOptions& options) {
  const auto load = total_load(assembly);
  const auto& constraints = assembly.boundary.constraints;
  using enum Analysis::Method;
  using enum Analysis::Preconditioner;
  if (c.analysis.method == adr)
    return {plate::adaptive_dynamic_relaxation(assembly.plate, constraints, load, options), "adr", {}, 0};
  if (c.analysis.method == direct) {
    const plate::AssembledPlate factor(assembly.plate, constraints);
    return {
        plate::conjugate_gradients(assembly.plate, constraints, load, options, &factor), "direct", {}, factor.bytes()};
  }
  const auto wanted = c.analysis.preconditioner;
  if (wanted == diagonal || (wanted == automatic && !local_is_faster(c, assembly)))
    return {plate::conjugate_gradients(assembly.plate, constraints, load, options), "cg", "diagonal", 0};
  const plate::LocalPlate twin(assembly.plate, assembly.boundary, c.section, c.discretization);
  return {plate::conjugate_gradients(assembly.plate, constraints, load, options, &twin), "cg", "local", twin.bytes()};
}

}  // namespace cases
