#include "post/factors/watched_motion.hpp"

#include "plate/formulation/formulation.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/motion/initial_conditions.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/tip_methods.hpp"

namespace post {

plate::LanczosMotion lanczos_motion(const plate::Analysis& analysis, const plate::Formulation& plate,
                                    const std::vector<TipMethods>& methods, const Eigen::MatrixXd& reactions,
                                    double truncation,
                                    const std::function<void(std::size_t vectors, double change)>& progress) {
  plate::LanczosOptions options{analysis.duration, analysis.tolerance};
  options.from_equilibrium = analysis.start == plate::Analysis::Start::equilibrium;
  for (const auto& tip : methods) options.watched.push_back(tip.functionals());
  options.watched_tolerance = truncation;
  options.told = {reactions};
  options.progress = progress;
  options.damping = analysis.damping.value_or(plate::Damping{});
  auto begin = plate::begin_of_motion(plate, analysis.rotary_inertia);
  options.deflected = std::move(begin.deflected), options.velocity = std::move(begin.velocity);
  const auto& constraints = plate.constraints();
  const auto inertia = plate.inertia(analysis.rotary_inertia);
  return {plate, constraints, inertia, plate.loads(), *plate::inverse_of(plate), options};
}

}  // namespace post
