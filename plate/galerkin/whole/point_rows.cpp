#include "plate/galerkin/whole/point_rows.hpp"

namespace plate {

PointRows::PointRows(PointMatrix matrix) : matrix_(std::move(matrix)), first_(matrix_.points() + 1, 0) {
  const auto visit = [&](const auto& entry) {  // of every row in ascending columns
    for (std::uint32_t c = 0; c < matrix_.points(); ++c)
      for (auto at = matrix_.first[c]; at < matrix_.first[c + 1]; ++at) {
        const auto r = matrix_.row[at];
        entry(r, Entry{c, false, at});
        if (r != c) entry(c, Entry{r, true, at});
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
  for (std::size_t k = 0; k < matrix_.points(); ++k) {
    Eigen::Vector3d sum(0, 0, 0);
    for (auto i = first_[k]; i < first_[k + 1]; ++i) add(entries_[i], matrix_.block[entries_[i].block], sum);
    result.col(Eigen::Index(k)) = sum;
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

Forces PointRows::diagonal() const {
  Forces result(3, Eigen::Index(matrix_.points()));
  for (std::size_t k = 0; k < matrix_.points(); ++k)
    result.col(Eigen::Index(k)) = matrix_.block[matrix_.first[k]].diagonal();
  return result;
}

std::size_t PointRows::bytes() const {
  return matrix_.block.size() * (sizeof(Eigen::Matrix3d) + sizeof(std::uint32_t)) +
         (matrix_.first.size() + first_.size()) * sizeof(std::size_t) + entries_.size() * sizeof(Entry);
}

}  // namespace plate
