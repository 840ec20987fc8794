#include "fracture/breakage/detached_pieces.hpp"

#include <algorithm>

#include "fracture/breakage/breakage_checkpoint.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/archive.hpp"

namespace fracture {

constexpr std::size_t look_every = 50;  // steps: looking takes as long as ten of them

DetachedPieces::DetachedPieces(plate::Changes& growth, const DamagedPlate& plate, const plate::Boundary& boundary,
                               plate::Forces mass)
    : growth_(growth), plate_(plate), boundary_(boundary), mass_(std::move(mass)) {}

void DetachedPieces::look(const plate::Step& now) {
  broken_ = plate_.broken().count();
  for (const auto k : plate::detached_points(boundary_, plate_.families()))
    if (!std::ranges::binary_search(frozen_.points, k)) fresh_.points.push_back(k);
  const auto of = [&](const plate::State& all) {
    plate::State result(plate::unknowns_per_point, Eigen::Index(fresh_.points.size()));
    for (std::size_t i = 0; i < fresh_.points.size(); ++i) result.col(Eigen::Index(i)) = all.col(fresh_.points[i]);
    return result;
  };
  fresh_.state = of(now.state), fresh_.velocity = of(now.velocity);
  any_fresh_ = plate::largest_of(plate_.map(), !fresh_.points.empty()) > 0;
}

/// Freezes the detached pieces from the step before on; the energy that central differences count there is of the
/// velocities before and after it.
void DetachedPieces::freeze(const plate::Step& now) {
  std::vector<std::pair<std::uint32_t, plate::PointValues>> all;
  for (std::size_t i = 0; i < frozen_.points.size(); ++i)
    all.emplace_back(frozen_.points[i], frozen_.state.col(Eigen::Index(i)));
  for (std::size_t i = 0; i < fresh_.points.size(); ++i)
    all.emplace_back(fresh_.points[i], fresh_.state.col(Eigen::Index(i)));
  energy_ += plate::ordered_sum<1>(plate_.map(), fresh_.points.size(), [&](std::size_t i) {  // ghosts have no mass
    const auto k = fresh_.points[i];
    return std::array<double, 1>{
        mass_.col(k).cwiseProduct(fresh_.velocity.col(Eigen::Index(i))).dot(now.velocity.col(k)) / 2};
  })[0];
  std::ranges::sort(all, {}, [](const auto& one) { return one.first; });
  fresh_ = {}, frozen_ = {}, any_fresh_ = false, any_frozen_ = true;
  frozen_.state.resize(plate::unknowns_per_point, Eigen::Index(all.size()));
  for (const auto& [k, state] : all) {
    frozen_.state.col(Eigen::Index(frozen_.points.size())) = state;
    frozen_.points.push_back(k);
  }
}

std::vector<SavedPoint> DetachedPieces::of_all(const PointStates& states, const PointKeys& keys) const {
  std::vector<SavedPoint> own;
  const auto column = [](const plate::State& of, std::size_t i) {
    if (of.cols() == 0) return std::array<double, plate::unknowns_per_point>{};
    const auto k = Eigen::Index(i);
    return std::array{of(0, k), of(1, k), of(2, k)};
  };
  for (std::size_t i = 0; i < states.points.size(); ++i)
    if (const auto k = states.points[i]; boundary_.owns(k))
      own.push_back({keys.of(k), column(states.state, i), column(states.velocity, i)});
  return plate::gathered(plate_.map(), own);
}

DetachedPieces::PointStates DetachedPieces::seen(const std::vector<SavedPoint>& states, const PointKeys& keys) {
  std::vector<std::pair<std::uint32_t, const SavedPoint*>> found;
  for (const auto& one : states)
    if (const auto k = keys.point(one.point)) found.emplace_back(*k, &one);
  std::ranges::sort(found);
  PointStates result;
  result.state.resize(plate::unknowns_per_point, Eigen::Index(found.size())),
      result.velocity.resize(plate::unknowns_per_point, Eigen::Index(found.size()));
  for (const auto& [k, one] : found) {
    const auto i = Eigen::Index(result.points.size());
    for (std::size_t c = 0; c < plate::unknowns_per_point; ++c)
      result.state(Eigen::Index(c), i) = one->state[c], result.velocity(Eigen::Index(c), i) = one->velocity[c];
    result.points.push_back(k);
  }
  return result;
}

void DetachedPieces::save(plate::OutArchive& archive) const {
  const PointKeys keys(boundary_);
  const bool looks = plate::largest_of(plate_.map(), plate_.broken().count() > broken_) > 0;  // when it is time
  archive(of_all(fresh_, keys), of_all(frozen_, keys), looks, any_fresh_, any_frozen_, energy_);
}

void DetachedPieces::load(plate::InArchive& archive) {
  std::vector<SavedPoint> fresh, frozen;
  bool looks = false;
  archive(fresh, frozen, looks, any_fresh_, any_frozen_, energy_);
  const PointKeys keys(boundary_);
  fresh_ = seen(fresh, keys), frozen_ = seen(frozen, keys);
  broken_ = looks ? 0 : plate_.broken().count();
}

void DetachedPieces::before_force(const plate::Step& now) {
  if (any_fresh_) freeze(now);
  for (std::size_t i = 0; i < frozen_.points.size(); ++i) {
    now.state.col(frozen_.points[i]) = frozen_.state.col(Eigen::Index(i));
    now.velocity.col(frozen_.points[i]).setZero();
  }
  if (any_frozen_) plate_.constraints().fetch(now.state);  // as their owners have them
  if (now.step % look_every == 0 && plate::largest_of(plate_.map(), plate_.broken().count() > broken_) > 0) look(now);
  growth_.before_force(now);
}

}  // namespace fracture
