#include "fracture/severing/fallen_pieces.hpp"

#include <algorithm>

#include "plate/formulation/parts/pieces.hpp"
#include "plate/solve/reduction.hpp"

namespace fracture {

constexpr std::size_t look_every = 50;  // steps: looking takes as long as ten of them

FallenPieces::FallenPieces(plate::Changes& growth, const SeveredPlate& plate, const plate::Boundary& boundary,
                           plate::Forces mass)
    : growth_(growth), plate_(plate), boundary_(boundary), mass_(std::move(mass)) {}

void FallenPieces::look(const plate::Step& now) {
  broken_ = plate_.broken().count();
  for (const auto k : plate::fallen(boundary_, plate_.families()))
    if (!std::ranges::binary_search(frozen_.points, k)) fresh_.points.push_back(k);
  const auto of = [&](const plate::State& all) {
    plate::State result(3, Eigen::Index(fresh_.points.size()));
    for (std::size_t i = 0; i < fresh_.points.size(); ++i) result.col(Eigen::Index(i)) = all.col(fresh_.points[i]);
    return result;
  };
  fresh_.state = of(now.state), fresh_.velocity = of(now.velocity);
  falls_ = plate::largest_of_all(!fresh_.points.empty()) > 0;
}

/// From the step before on; the energy that central differences count there is of the velocities before and after it.
void FallenPieces::freeze(const plate::Step& now) {
  std::vector<std::pair<std::uint32_t, Eigen::Vector3d>> all;
  for (std::size_t i = 0; i < frozen_.points.size(); ++i)
    all.emplace_back(frozen_.points[i], frozen_.state.col(Eigen::Index(i)));
  for (std::size_t i = 0; i < fresh_.points.size(); ++i)
    all.emplace_back(fresh_.points[i], fresh_.state.col(Eigen::Index(i)));
  energy_ += plate::ordered_sum<1>(fresh_.points.size(), [&](std::size_t i) {  // copies have no mass
    const auto k = fresh_.points[i];
    return std::array<double, 1>{
        mass_.col(k).cwiseProduct(fresh_.velocity.col(Eigen::Index(i))).dot(now.velocity.col(k)) / 2};
  })[0];
  std::ranges::sort(all, {}, [](const auto& one) { return one.first; });
  fresh_ = {}, frozen_ = {}, falls_ = false, fallen_ = true;
  frozen_.state.resize(3, Eigen::Index(all.size()));
  for (const auto& [k, state] : all) {
    frozen_.state.col(Eigen::Index(frozen_.points.size())) = state;
    frozen_.points.push_back(k);
  }
}

void FallenPieces::before_force(const plate::Step& now) {
  if (falls_) freeze(now);
  for (std::size_t i = 0; i < frozen_.points.size(); ++i) {
    now.state.col(frozen_.points[i]) = frozen_.state.col(Eigen::Index(i));
    now.velocity.col(frozen_.points[i]).setZero();
  }
  if (fallen_) plate_.constraints().fetch(now.state);  // as their owners have them
  if (now.step % look_every == 0 && plate::largest_of_all(plate_.broken().count() > broken_) > 0) look(now);
  growth_.before_force(now);
}

void FallenPieces::after_force(const plate::Step& now, const plate::Forces& force) {
  growth_.after_force(now, force);
}

}  // namespace fracture
