#include "plate/solve/motion/travelling_loads.hpp"

#include <cmath>

#include "plate/model/nodal_forces.hpp"
#include "plate/model/ranks/exact_sum.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace plate {

TravellingLoads::TravellingLoads(const std::vector<TimedLoad>& loads) {
  for (const auto& load : loads)
    if (load.moving) loads_.push_back({load.moving, load.history});
}

template <std::size_t N>
std::array<double, N> TravellingLoads::products(const std::array<double, N>& times, const State& state) const {
  const auto each = [&](std::size_t i, const auto& add) {
    const auto& forces = loads_[i].forces;
    const auto& history = loads_[i].history;
    for (std::size_t n = 0; n < N; ++n) {
      const double share = factor(history, times[n]);
      forces->at(times[n], [&](std::uint32_t dof, double force) {
        if (forces->own.empty() || forces->own[dof / 3]) add(n, share * force * at_dof(state, dof));
      });
    }
  };
  if (const Ranks* all = ranks()) return exact_sum<N>(*all, loads_.size(), each);
  std::array<double, N> sum{};
  for (std::size_t i = 0; i < loads_.size(); ++i) each(i, [&](std::size_t n, double term) { sum[n] += term; });
  return sum;
}

template <typename Real>
void TravellingLoads::add(double time, double time_step, const State& state, Values<Real>& force) {
  if (!any()) return;
  const double step = std::round(time / time_step);  // times to the last digit: at the end of its path a force leaves
  const auto [before, now, next] = products<3>({(step - 1) * time_step, time, (step + 1) * time_step}, state);
  if (begun_) work_ += (before + now - now_ - next_) / 2;
  now_ = now, next_ = next, begun_ = true;
  for (const auto& one : loads_) {
    const double share = factor(one.history, time);
    one.forces->at(time, [&](std::uint32_t dof, double value) { at_dof(force, dof) += Real(share * value); });
  }
}

template void TravellingLoads::add(double, double, const State&, Values<double>&);
template void TravellingLoads::add(double, double, const State&, Values<float>&);

void TravellingLoads::complete(Instant& seen) const {
  if (!any()) return;
  seen.external_work += work_;
  seen.strain_energy += now_ / 2;
  seen.potential -= now_;
}

std::vector<double> TravellingLoads::memory() const {
  return any() ? std::vector<double>{work_, now_, next_} : std::vector<double>{};
}

void TravellingLoads::recall(const std::vector<double>& memory) {
  if (memory.empty()) return;
  work_ = memory[0], now_ = memory[1], next_ = memory[2], begun_ = true;
}

}  // namespace plate
