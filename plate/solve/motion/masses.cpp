#include "plate/solve/motion/masses.hpp"

#include <algorithm>
#include <map>

namespace plate {
namespace {

/// `key`: mass, then every load.
PointClass class_of(const std::vector<double>& key) {
  PointClass result{};
  for (std::size_t c = 0; c < 3; ++c) {
    result.mass[c] = key[c];
    result.inverse_mass[c] = key[c] > 0 ? 1 / key[c] : 0;
  }
  for (std::size_t i = 3; i < key.size(); i += 3) result.loads.push_back({key[i], key[i + 1], key[i + 2]});
  return result;
}

}  // namespace

Masses::Masses(const Forces& mass, std::vector<TimedLoad> loads, const Constraints& constraints) {
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
      for (std::size_t c = 0; c < 3; ++c) one.load[c] += factor(histories_[i], time) * one.loads[i][c];
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

}  // namespace plate
