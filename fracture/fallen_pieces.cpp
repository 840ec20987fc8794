#include "fracture/fallen_pieces.hpp"

#include <algorithm>

#include "plate/pieces.hpp"

namespace fracture {

constexpr std::size_t look_every = 50;  // steps: looking takes as long as ten of them

FallenPieces::FallenPieces(plate::Changes& growth, const SeveredPlate& plate, const plate::Boundary& boundary, plate::Forces mass)
    : growth_(growth), plate_(plate), boundary_(boundary), mass_(std::move(mass)) {}

void FallenPieces::look(const plate::Moment& now) {
  broken_ = plate_.broken().count();
  std::vector<std::uint32_t> fresh;
  for (const auto k : plate::fallen(boundary_, plate_.families()))
    if (!std::ranges::binary_search(points_, k)) fresh.push_back(k);
  if (fresh.empty()) return;
  for (const auto k : fresh) energy_ += mass_.col(k).cwiseProduct(now.velocity.col(k).cwiseAbs2()).sum() / 2;
  points_.insert(points_.end(), fresh.begin(), fresh.end());
  std::ranges::sort(points_);
  state_.resize(3, Eigen::Index(points_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) state_.col(Eigen::Index(i)) = now.state.col(points_[i]);
}

void FallenPieces::before_force(const plate::Moment& now) {
  if (now.step % look_every == 0 && plate_.broken().count() > broken_) look(now);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    now.state.col(points_[i]) = state_.col(Eigen::Index(i));
    now.velocity.col(points_[i]).setZero();
  }
  growth_.before_force(now);
}

void FallenPieces::after_force(const plate::Moment& now, const plate::Forces& force) { growth_.after_force(now, force); }

}  // namespace fracture
