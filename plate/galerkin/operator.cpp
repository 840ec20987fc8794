#include "plate/galerkin/operator.hpp"

#include <algorithm>
#include <numeric>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/galerkin/stiffness.hpp"
#include "plate/model/reduction.hpp"

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
    PointValues sum(0, 0, 0);
    for (auto i = first_[n]; i < first_[n + 1]; ++i) add(entries_[i], matrix_.block[entries_[i].block], sum);
    result.col(Eigen::Index(points_[n])) = sum;
  }
}

void PointRows::internal_force(const State& state, Forces& forces) const {
  gather(forces, [&](const Entry& entry, const Eigen::Matrix3d& K, PointValues& sum) {
    const PointValues u = state.col(entry.point);
    if (entry.transposed)
      sum -= K.transpose() * u;
    else
      sum -= K * u;
  });
}

void PointRows::absolute_product(const State& state, Forces& forces) const {
  gather(forces, [&](const Entry& entry, const Eigen::Matrix3d& K, PointValues& sum) {
    const Eigen::Matrix3d size = K.cwiseAbs();
    const PointValues u = state.col(entry.point);
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

GalerkinOperator::GalerkinOperator(GalerkinFamilies families, PointSections sections, ElasticSupports elastic_supports,
                                   const std::vector<std::uint32_t>& column_block, const std::vector<char>& pending)
    : families_(std::move(families)),
      sections_(std::move(sections)),
      elastic_supports_(std::move(elastic_supports)),
      knows_pending_(!pending.empty()) {
  if (sections_.uniform()) rows_.emplace(families_, sections_, column_block, pending);
  if (sections_.simple()) {
    lists_.emplace(families_, sections_, rows_->others(), pending);
  } else {
    std::vector<std::uint32_t> others(families_.areas.size());
    std::iota(others.begin(), others.end(), 0);
    whole_.emplace(stiffness_matrix(families_, sections_), rows_ ? rows_->others() : others);
  }
  for (std::uint32_t k = 0; k < column_block.size(); ++k)
    if (column_block[k] == 0) copies_.push_back(k);
}

void GalerkinOperator::internal_force(const State& state, Forces& forces) const {
  forces.resize(unknowns_per_point, state.cols());
  if (rows_) rows_->internal_force(state, forces);
  if (whole_)
    whole_->internal_force(state, forces);
  else
    lists_->internal_force(state, forces);
  complete(state, forces);
}

/// Overlaps the internal force with the exchange. One process waits for nothing, and assembled rows do not know which
/// ghosts they need.
void GalerkinOperator::internal_force_overlapped(const State& state, PendingExchange& rest, Forces& forces) const {
  if (whole_ || !knows_pending_) {
    rest.complete();
    return internal_force(state, forces);
  }
  forces.resize(unknowns_per_point, state.cols());
  rows_->internal_force_inside(state, forces);
  rest.progress();
  lists_->begin_force(state);
  rest.complete();
  rows_->internal_force_waiting(state, forces);
  lists_->end_force(state, forces);
  complete(state, forces);
}

/// Forces of rows and lists, with the elastic supports.
void GalerkinOperator::complete(const State& state, Forces& forces) const {
  for (const auto k : copies_) forces.col(k).setZero();
  elastic_supports_.add_force(state, forces);
}

/// Adds to every point in no row what the families that it belongs to have for it: own(family, k, found) leaves three
/// numbers for every member of the family of k in found.
template <typename Own>
void GalerkinOperator::gather(const Own& own, Forces& result) const {
  const auto& f = families_.families;
  const auto& kept = lists_->kept();
  std::vector<std::size_t> first{0};
  std::vector<std::uint32_t> place(points());
  for (std::uint32_t n = 0; n < kept.size(); ++n) {
    place[kept[n]] = n;
    first.push_back(first.back() + f[kept[n]].size() + 1);
  }
  std::vector<PointValues> found(first.back());
  const auto lattice = lattice_family(families_);
#pragma omp parallel
  {
    FamilyStiffness single(families_, sections_), shared(lattice ? *lattice->families : families_, sections_);
    if (lattice) shared.find(lattice->point);
#pragma omp for schedule(dynamic, 64)
    for (std::size_t n = 0; n < kept.size(); ++n) {
      const bool regular = families_.kind[kept[n]] == 0;
      if (!regular) single.find(kept[n]);
      own(regular ? shared : single, kept[n], found.data() + first[n]);
    }
#pragma omp for schedule(static)
    for (std::size_t i = 0; i < rows_->others().size(); ++i) {
      const auto k = rows_->others()[i];
      PointValues sum = found[first[place[k]]];
      for (const auto& bond : f[k]) sum += found[first[place[bond.neighbour]] + f[bond.neighbour].find(k) + 1];
      result.col(k) += sum;
    }
  }
}

void GalerkinOperator::absolute_product(const State& state, Forces& forces) const {
  forces.setZero(unknowns_per_point, state.cols());
  if (rows_) rows_->absolute_product(state, forces);
  if (whole_) {
    whole_->absolute_product(state, forces);
    return elastic_supports_.add_absolute_product(state, forces);
  }
  const auto own = [&](const FamilyStiffness& K, std::uint32_t k, PointValues* found) {
    const auto family = families_.families[k];
    for (std::size_t i = 0; i < K.members(); ++i) {
      found[i].setZero();
      for (std::size_t j = 0; j < K.members(); ++j)
        found[i] += K.block(i, j).cwiseAbs() * state.col(j == 0 ? k : family[j - 1].neighbour);
    }
  };
  gather(own, forces);
  elastic_supports_.add_absolute_product(state, forces);
}

Forces GalerkinOperator::diagonal() const {
  Forces result = zero_forces(points());
  if (rows_) rows_->diagonal(result);
  if (whole_) {
    whole_->diagonal(result);
  } else {
    const auto own = [](const FamilyStiffness& K, std::uint32_t, PointValues* found) {
      for (std::size_t i = 0; i < K.members(); ++i) found[i] = K.block(i, i).diagonal();
    };
    gather(own, result);
  }
  elastic_supports_.add_diagonal(result);
  return result;
}

Eigen::VectorXd GalerkinOperator::energies(const State& state) const {
  Eigen::VectorXd result(state.cols());
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < result.size(); ++k)
    result[k] = family_energy(families_, sections_[std::size_t(k)], std::size_t(k), state);
  elastic_supports_.add_energies(state, result);
  return result;
}

std::size_t GalerkinOperator::bytes() const {
  const auto kernels = (rows_ ? rows_->bytes() : 0) + (whole_ ? whole_->bytes() + sections_.bytes() : lists_->bytes());
  return kernels + families_.bonds.size() * sizeof(GalerkinBond) + families_.first.size() * sizeof(std::size_t) +
         families_.kind.size() * sizeof(std::uint32_t);
}

PointMatrix GalerkinOperator::own_matrix() const {
  return whole_ ? whole_->matrix() : stiffness_matrix(families_, sections_);
}

/// Sets to zero the rounding that would be left at points about which the families' normals cancel (theory (63)).
Forces force_of_curvature(const GalerkinFamilies& families, const Section& section, const Eigen::VectorXd& curvature,
                          const PointMap& map) {
  constexpr double rounding = 1e-12;
  const Eigen::Vector3d flat = moments_held_flat(section);
  Eigen::Matrix2d each;
  each << flat[0], flat[2], flat[2], flat[1];
  Forces result = zero_forces(curvature.size());
  double largest = 0;
  for (std::uint32_t k = 0; k < curvature.size(); ++k) {
    const auto family = families.families[k];
    const Eigen::Matrix2d moment = families.areas[k] * curvature[k] * each;
    for (std::size_t i = 0; i < family.size(); ++i) {
      const geometry::Point psi = moment * families.of(k)[i].gradient;
      const Eigen::Vector2d theta(-psi.y(), psi.x());  // psi = (-theta_y, theta_x)
      result.col(Eigen::Index(family[i].neighbour)).tail<2>() += theta;
      result.col(k).tail<2>() -= theta;
      if (map.owns(k)) largest = std::max(largest, psi.norm());
    }
  }
  largest = largest_of(map, largest);
  return (result.array().abs() > rounding * largest).select(result, 0);
}

}  // namespace plate
