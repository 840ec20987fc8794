#include "plate/galerkin/whole/point_rows.hpp"

namespace plate {

PointRows::PointRows(PointMatrix matrix, std::vector<std::uint32_t> points)
    : matrix_(std::move(matrix)), points_(std::move(points)), first_(points_.size() + 1, 0) {
  constexpr auto none = std::uint32_t(-1);
  std::vector<std::uint32_t> place(matrix_.points(), none);
  for (std::uint32_t i = 0; i < points_.size(); ++i) place[points_[i]] = i;
  const auto visit = [&](const auto& entry) {  // of every row in ascending columns
    for (std::uint32_t c = 0; c < matrix_.points(); ++c)
      for (auto at = matrix_.first[c]; at < matrix_.first[c + 1]; ++at) {
        const auto r = matrix_.row[at];
        if (place[r] != none) entry(place[r], Entry{c, false, at});
        if (r != c && place[c] != none) entry(place[c], Entry{r, true, at});
      }
  };
  visit([&](std::uint32_t row, const Entry&) { ++first_[row + 1]; });
  for (std::size_t k = 0; k + 1 < first_.size(); ++k) first_[k + 1] += first_[k];
  entries_.resize(first_.back());
  auto next = first_;
  visit([&](std::uint32_t row, const Entry& entry) { entries_[next[row]++] = entry; });
}

template <typename Add>
void PointRows::gather(Forces& result, const Add& add) const {
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < points_.size(); ++n) {
    Eigen::Vector3d sum(0, 0, 0);
    for (auto i = first_[n]; i < first_[n + 1]; ++i) add(entries_[i], matrix_.block[entries_[i].block], sum);
    result.col(Eigen::Index(points_[n])) = sum;
  }
}

void PointRows::internal_force(const State& state, Forces& forces) const {
  gather(forces, [&](const Entry& entry, const Eigen::Matrix3d& K, Eigen::Vector3d& sum) {
    const Eigen::Vector3d u = state.col(entry.point);
    if (entry.transposed)
      sum -= K.transpose() * u;
    else
      sum -= K * u;
  });
}

void PointRows::absolute_product(const State& state, Forces& forces) const {
  gather(forces, [&](const Entry& entry, const Eigen::Matrix3d& K, Eigen::Vector3d& sum) {
    const Eigen::Matrix3d size = K.cwiseAbs();
    const Eigen::Vector3d u = state.col(entry.point);
    if (entry.transposed)
      sum += size.transpose() * u;
    else
      sum += size * u;
  });
}

void PointRows::diagonal(Forces& result) const {
  for (const auto k : points_) result.col(Eigen::Index(k)) = matrix_.block[matrix_.first[k]].diagonal();
}

std::size_t PointRows::bytes() const {
  return matrix_.block.size() * (sizeof(Eigen::Matrix3d) + sizeof(std::uint32_t)) +
         (matrix_.first.size() + first_.size()) * sizeof(std::size_t) + entries_.size() * sizeof(Entry) +
         points_.size() * sizeof(std::uint32_t);
}

}  // namespace plate
