#include "plate/galerkin/rows.hpp"

#include <algorithm>
#include <cmath>

#include "plate/galerkin/family_stiffness.hpp"
#include "plate/solve/lanes.hpp"

namespace plate {
namespace {

constexpr int reach = 2, width = 5;
constexpr auto shortest_row = std::size_t(Lane<double>::size());
constexpr std::size_t longest_row = 256;  // pieces of work for threads

/// Neighbours of a point in the 25 places about it; nothing where one is missing or has another kind of family within
/// its own.
std::optional<std::array<std::int32_t, 5>> steps_about(const GalerkinFamilies& f, std::uint32_t k, double spacing) {
  if (f.kind[k] != 0) return std::nullopt;
  std::array<std::int32_t, 5> steps{};
  for (const auto [j, vector] : f.families[k]) {
    if (f.kind[j] != 0) return std::nullopt;
    const auto& x = f.families.vectors()[vector];
    const auto column = std::lround(x.x() / spacing), row = std::lround(x.y() / spacing);
    const auto step = std::int32_t(j - k);
    if (column == 0) steps[std::size_t(row + reach)] = step;
    if (column != 0 && row == 0 && step != column) return std::nullopt;
  }
  // the rows two away, from the points above and below, and every place by the step that its row has
  for (const int sign : {-1, 1}) {
    const auto middle = std::uint32_t(std::int64_t(k) + steps[std::size_t(reach + sign)]);
    for (const auto [j, vector] : f.families[middle]) {
      const auto& x = f.families.vectors()[vector];
      if (std::lround(x.x() / spacing) == 0 && std::lround(x.y() / spacing) == sign)
        steps[std::size_t(reach + 2 * sign)] = std::int32_t(j - k);
    }
  }
  for (const auto& bond : f.families[k])
    for (const auto& [other, next] : f.families[bond.neighbour]) {
      const geometry::Point x = f.families.vectors()[bond.vector_id] + f.families.vectors()[next];
      const auto column = std::lround(x.x() / spacing), row = std::lround(x.y() / spacing);
      if (std::int32_t(other - k) != steps[std::size_t(row + reach)] + column) return std::nullopt;
    }
  return steps;
}

}  // namespace

GalerkinRows::GalerkinRows(const GalerkinFamilies& families, const PointSections& sections,
                           const std::vector<std::uint32_t>& stretch, const std::vector<char>& awaited) {
  const auto points = std::uint32_t(families.areas.size());
  const auto lattice = lattice_family(families);
  const double spacing = lattice ? std::sqrt(lattice->families->areas[lattice->point]) : 0;
  std::vector<std::optional<std::array<std::int32_t, 5>>> steps(points);
#pragma omp parallel for schedule(static)
  for (std::uint32_t k = 0; k < points; ++k) steps[k] = steps_about(families, k, spacing);
  const auto asked = [&](std::uint32_t k) { return stretch.empty() || stretch[k] > 0; };
  const auto goes_on = [&](std::uint32_t k, std::uint32_t end) {
    return steps[k] && steps[end] == steps[k] && (stretch.empty() || stretch[end] == stretch[k]);
  };
  for (std::uint32_t k = 0; k < points;) {
    std::uint32_t end = k + 1;
    if (!asked(k)) {
      k = end;
      continue;
    }
    while (end < points && end - k < longest_row && goes_on(k, end)) ++end;
    if (steps[k] && end - k >= shortest_row)
      rows_.push_back({k, end - k, *steps[k]});
    else
      for (auto i = k; i < end; ++i) others_.push_back(i);
    k = end;
  }
  const auto inside = [&](const Row& row) {
    return std::ranges::all_of(row.step, [&](std::int32_t step) {
      const auto from = awaited.begin() + row.first + step - reach;
      return std::none_of(from, from + row.length + 2 * reach, [](char one) { return one; });
    });
  };
  const auto waiting =
      awaited.empty() ? std::ranges::subrange(rows_.end(), rows_.end()) : std::ranges::stable_partition(rows_, inside);
  inside_ = std::size_t(waiting.begin() - rows_.begin());
  if (lattice) find_factors(*lattice, sections, spacing);
}

/// The force on a member of a family by all its members, at their places relative to it.
void GalerkinRows::find_factors(const LatticeFamily& lattice, const PointSections& sections, double spacing) {
  const auto& families = lattice.families->families;
  const Eigen::MatrixXd K = family_stiffness(*lattice.families, sections, lattice.point);
  std::vector<geometry::Point> place{{0, 0}};
  for (const auto& bond : families[lattice.point]) place.push_back(families.vectors()[bond.vector_id] / spacing);
  for (std::size_t a = 0; a < place.size(); ++a)
    for (std::size_t b = 0; b < place.size(); ++b) {
      const auto at =
          std::lround((place[b] - place[a]).y() + reach) * width + std::lround((place[b] - place[a]).x() + reach);
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t d = 0; d < 3; ++d)
          factors_[std::size_t(at) * 9 + 3 * c + d] -= K(Eigen::Index(3 * a + c), Eigen::Index(3 * b + d));
    }
}

template <typename Apply>
void GalerkinRows::apply(std::size_t begin, std::size_t end, const Apply& apply) const {
#pragma omp parallel for schedule(static)
  for (std::size_t i = begin; i < end; ++i)
    along<double>(std::ptrdiff_t(rows_[i].first), std::ptrdiff_t(rows_[i].length),
                  [&](const auto& points) { apply(rows_[i], points); });
}

void GalerkinRows::product(const Factors& factors, std::size_t begin, std::size_t end, const State& state,
                           Forces& forces) const {
  const double* const u[] = {state.row(0).data(), state.row(1).data(), state.row(2).data()};
  apply(begin, end, [&](const Row& row, const auto& points) {
    using Vector = typename std::remove_cvref_t<decltype(points)>::Vector;
    Vector sum[3] = {Vector::constant(0), Vector::constant(0), Vector::constant(0)};
    const double* factor = factors.data();
    for (const auto middle : row.step)
      for (int column = -reach; column <= reach; ++column, factor += 9)
        for (int d = 0; d < 3; ++d) {
          const auto value = points.load(u[d], middle + column);
          for (int c = 0; c < 3; ++c) sum[c] += factor[3 * c + d] * value;
        }
    for (int c = 0; c < 3; ++c) points.store(sum[c], forces.row(c).data());
  });
}

void GalerkinRows::internal_force(const State& state, Forces& forces) const {
  product(factors_, 0, rows_.size(), state, forces);
}

void GalerkinRows::internal_force_inside(const State& state, Forces& forces) const {
  product(factors_, 0, inside_, state, forces);
}

void GalerkinRows::internal_force_waiting(const State& state, Forces& forces) const {
  product(factors_, inside_, rows_.size(), state, forces);
}

void GalerkinRows::absolute_product(const State& state, Forces& forces) const {
  Factors absolute;
  for (std::size_t i = 0; i < factors_.size(); ++i) absolute[i] = std::abs(factors_[i]);
  product(absolute, 0, rows_.size(), state, forces);
}

void GalerkinRows::diagonal(Forces& diagonal) const {
  constexpr std::size_t middle = 12 * 9;
  for (const auto& row : rows_)
    for (auto k = row.first; k < row.first + row.length; ++k)
      for (std::size_t c = 0; c < 3; ++c) diagonal(Eigen::Index(c), k) = -factors_[middle + 4 * c];
}

}  // namespace plate
