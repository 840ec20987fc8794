#include "cases/driver/lanczos.hpp"

#include "cases/driver/static_solution.hpp"

namespace cases {

plate::LanczosMotion lanczos_motion(const Case& c, const Assembly& assembly, const std::vector<post::TipMethods>& methods,
                                    double truncation, const std::function<void(std::size_t vectors, double change)>& progress) {
  plate::LanczosOptions options{c.analysis.duration, c.analysis.tolerance};
  options.from_equilibrium = c.analysis.start == Analysis::Start::equilibrium;
  for (const auto& tip : methods) options.watched.push_back(tip.functionals());
  options.watched_tolerance = truncation;
  options.progress = progress;
  const auto& constraints = assembly.boundary.constraints;
  const plate::Inertia inertia(c.section, assembly.galerkin()->cells, constraints, c.analysis.rotary_inertia);
  return {assembly.plate(), constraints, inertia, assembly.loads, *inverse_of(c, assembly), options};
}

}  // namespace cases
