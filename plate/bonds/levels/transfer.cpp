#include "plate/bonds/levels/transfer.hpp"

#include <cmath>

namespace plate {
namespace {

using geometry::Point;

struct Source {
  std::uint32_t coarse;
  double weight;
  Point away;  // from it to the point [length]
};

/// Weights with sum 1, and the lever that the rotations have: half the distance where the weights are balanced, which
/// is exact for quadratic deflections, all of it where they are not, which is exact for rigid motions.
void settle(std::vector<Source>& sources, double spacing) {
  double sum = 0;
  Point mean(0, 0);
  for (const auto& s : sources) sum += s.weight;
  for (auto& s : sources) s.weight /= sum, mean += s.weight * s.away;
  const double lever = mean.norm() < 1e-9 * spacing ? 0.5 : 1;
  for (auto& s : sources) s.away *= lever;
}

}  // namespace

Transfer::Transfer(const geometry::Families& families, const Boundary& boundary) {
  constexpr std::uint32_t none = std::uint32_t(-1);
  const std::size_t points = families.points();
  const auto cell = [&](std::size_t k) {
    return Cell{std::int32_t(std::floor(boundary.lattice[k].x())), std::int32_t(std::floor(boundary.lattice[k].y()))};
  };
  const auto even = [](std::int32_t i) { return i % 2 == 0; };
  std::vector<std::uint32_t> coarse_of(points, none);
  for (std::size_t k = 0; k < boundary.cloud.plate_points; ++k)
    if (const Cell c = cell(k); even(c.column) && even(c.row)) {
      coarse_of[k] = std::uint32_t(cell_.size());
      cell_.push_back({c.column / 2, c.row / 2});
      fine_point_.push_back(std::uint32_t(k));
    }
  fine_.first.assign(points + 1, 0);
  std::vector<Source> sources;
  for (std::size_t k = 0; k < points; ++k) {
    sources.clear();
    const Cell own = cell(k);
    const auto add = [&](std::uint32_t c) {
      const Cell other = cell(c);
      const int columns = std::abs(other.column - own.column), rows = std::abs(other.row - own.row);
      if (coarse_of[c] == none || columns > 1 || rows > 1) return;
      sources.push_back({coarse_of[c], (columns ? 0.5 : 1) * (rows ? 0.5 : 1),
                         boundary.cloud.positions[k] - boundary.cloud.positions[c]});
    };
    if (boundary.is_plate(std::uint32_t(k))) {
      add(std::uint32_t(k));
      if (coarse_of[k] == none)
        for (const auto& bond : families[k]) add(bond.neighbour);
    }
    if (!sources.empty()) settle(sources, boundary.cloud.units.spacing);
    for (const auto& s : sources)
      fine_.shares.push_back({s.coarse, float(s.weight), float(s.weight * s.away.x()), float(s.weight * s.away.y())});
    fine_.first[k + 1] = fine_.shares.size();
  }
  coarse_ = transposed(fine_, cell_.size());
}

Transfer::Shares Transfer::transposed(const Shares& shares, std::size_t others) {
  Shares result;
  result.first.assign(others + 1, 0);
  for (const auto& share : shares.shares) ++result.first[share.other + 1];
  for (std::size_t i = 0; i < others; ++i) result.first[i + 1] += result.first[i];
  result.shares.resize(shares.shares.size());
  auto next = result.first;
  for (std::uint32_t k = 0; k + 1 < shares.first.size(); ++k)
    for (auto i = shares.first[k]; i < shares.first[k + 1]; ++i) {
      Share share = shares.shares[i];
      const auto at = next[share.other]++;
      share.other = k;
      result.shares[at] = share;
    }
  return result;
}

// w = sum weight w_c - x theta_y + y theta_x: no shear strain between the points
void Transfer::prolong(const State& coarse, State& fine) const {
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < fine_.first.size() - 1; ++k) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (auto i = fine_.first[k]; i < fine_.first[k + 1]; ++i) {
      const Share& s = fine_.shares[i];
      const auto u = coarse.col(Eigen::Index(s.other));
      const double weight = s.weight;
      sum += Eigen::Vector3d(weight * u[0] + s.y * u[1] - s.x * u[2], weight * u[1], weight * u[2]);
    }
    fine.col(Eigen::Index(k)) += sum;
  }
}

void Transfer::restrict_to(State& coarse, const Forces& fine) const {
  coarse.resize(3, Eigen::Index(coarse_points()));
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < coarse_points(); ++c) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (auto i = coarse_.first[c]; i < coarse_.first[c + 1]; ++i) {
      const Share& s = coarse_.shares[i];
      const auto f = fine.col(Eigen::Index(s.other));
      const double weight = s.weight;
      sum += Eigen::Vector3d(weight * f[0], weight * f[1] + s.y * f[0], weight * f[2] - s.x * f[0]);
    }
    coarse.col(Eigen::Index(c)) = sum;
  }
}

}  // namespace plate
