#include "cases/driver/lanczos.hpp"

#include "plate/formulation/formulation.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/formulation/preconditioner.hpp"
#include "plate/solve/solution.hpp"

namespace cases {

plate::LanczosMotion lanczos_motion(const Case& c, const plate::Formulation& plate,
                                    const std::vector<post::TipMethods>& methods, double truncation,
                                    const std::function<void(std::size_t vectors, double change)>& progress) {
  plate::LanczosOptions options{c.analysis.duration, c.analysis.tolerance};
  options.from_equilibrium = c.analysis.start == Analysis::Start::equilibrium;
  for (const auto& tip : methods) options.watched.push_back(tip.functionals());
  options.watched_tolerance = truncation;
  options.progress = progress;
  const auto& constraints = plate.constraints();
  const auto inertia = plate.inertia(c.analysis.rotary_inertia);
  return {plate, constraints, inertia, plate.loads(), *plate::inverse_of(plate), options};
}

}  // namespace cases
