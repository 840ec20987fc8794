#include "plate/solve/motion/masses_and_loads.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "plate/model/nodal_forces.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace plate {
namespace {

/// `key`: mass, then every load.
PointClass class_of(const std::vector<double>& key) {
  PointClass result{};
  for (std::size_t c = 0; c < unknowns_per_point; ++c) {
    result.mass[c] = key[c];
    result.inverse_mass[c] = key[c] > 0 ? 1 / key[c] : 0;
  }
  for (std::size_t i = unknowns_per_point; i < key.size(); i += unknowns_per_point)
    result.loads.push_back({key[i], key[i + 1], key[i + 2]});
  return result;
}

}  // namespace

Masses::Masses(const Forces& mass, std::vector<TimedLoad> loads, const Constraints& constraints)
    : constraints_(&constraints) {
  constexpr std::uint32_t longest = 1024;  // runs are shared out among threads
  for (auto& load : loads) {
    constraints.fold(load.forces);
    histories_.push_back(load.history);
    varies_ = varies_ || !load.history.constant();
  }
  last_.assign(loads.size(), {0, 0});
  work_.assign(loads.size(), 0), before_.assign(loads.size(), 0);
  std::map<std::vector<double>, std::uint32_t> known;
  std::vector<double> key, before;
  for (Eigen::Index k = 0; k < mass.cols(); ++k) {
    key.assign(mass.col(k).begin(), mass.col(k).end());
    for (const auto& load : loads) key.insert(key.end(), load.forces.col(k).begin(), load.forces.col(k).end());
    if (std::ranges::all_of(key, [](double value) { return value == 0; })) {
      before.clear();
      continue;
    }
    if (key == before && runs_.back().length < longest) {
      ++runs_.back().length;
      continue;
    }
    const auto [entry, fresh] = known.try_emplace(key, std::uint32_t(known.size()));
    if (fresh) classes_.push_back(class_of(key));
    runs_.push_back({std::uint32_t(k), 1, entry->second});
    before = key;
  }
  at(0);
}

void Masses::at(double time) {
  for (auto& one : classes_) {
    one.load = {0, 0, 0};
    for (std::size_t i = 0; i < histories_.size(); ++i)
      for (std::size_t c = 0; c < unknowns_per_point; ++c) one.load[c] += factor(histories_[i], time) * one.loads[i][c];
  }
}

void Masses::start(const State& state) {
  work(0, state);
  for (std::size_t l = 0; l < histories_.size(); ++l)
    if (histories_[l].constant()) before_[l] = -last_[l].first * last_[l].second / 2;
}

void Masses::bent(const State& state) {
  work(0, state);
  for (std::size_t l = 0; l < histories_.size(); ++l) {
    work_[l] = 0;
    if (histories_[l].constant()) before_[l] = -last_[l].first;
  }
}

double Masses::work(double time, const State& state) {
  double all = given_;
  for (std::size_t l = 0; l < histories_.size(); ++l) {
    const auto [share] = sum<1>(state.cols(), [&](const PointClass& one, std::size_t c, Eigen::Index i) {
      return std::array<double, 1>{one.loads[l][c] * state.data()[i]};
    });
    const double now = factor(histories_[l], time);
    auto& [share_before, factor_before] = last_[l];
    work_[l] =
        histories_[l].constant() ? share + before_[l] : work_[l] + (now + factor_before) / 2 * (share - share_before);
    last_[l] = {share, now};
    all += work_[l];
  }
  return all;
}

TravellingLoads::TravellingLoads(const std::vector<TimedLoad>& loads, const Constraints& constraints)
    : constraints_(&constraints) {
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
      forces->at(times[n], [&](const Dof& dof, double force) {
        if (forces->own.empty() || forces->own[dof.point]) add(n, share * force * at_dof(state, dof));
      });
    }
  };
  return sum_of_items<N>(*constraints_, loads_.size(), each);
}

void TravellingLoads::start(const State& state) {
  if (any()) work_ = products<1>({0.0}, state)[0] / 2;
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
    one.forces->at(time, [&](const Dof& dof, double value) { at_dof(force, dof) += Real(share * value); });
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

void TravellingLoads::restore(const std::vector<double>& memory) {
  if (memory.empty()) return;
  work_ = memory[0], now_ = memory[1], next_ = memory[2], begun_ = true;
}

}  // namespace plate
