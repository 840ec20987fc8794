#include "plate/galerkin/levels.hpp"

#include <cmath>

#include "geometry/cells/locator.hpp"
#include "plate/galerkin/shared/sum_by_owners.hpp"
#include "plate/galerkin/stiffness.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/shared_factor.hpp"

namespace plate {
namespace {

constexpr int sweeps = 2;      // before and after
constexpr double share = 1.5;  // weight of a sweep times the largest eigenvalue

}  // namespace

LevelTransfer transfer_to(const std::vector<geometry::Point>& seen, const geometry::Tessellation& coarse,
                          const std::vector<char>& own) {
  const geometry::CellLocator locate(coarse);
  std::vector<geometry::CellLocator::Found> found(seen.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (own.empty() || own[k]) found[k] = locate(seen[k], seen[k]);
  LevelTransfer result;
  result.first.push_back(0);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    for (std::size_t i = 0; i < found[k].count; ++i) {
      const double weight = found[k].weights[i];
      if (std::abs(weight) < 1e-5) continue;  // what a face point is seen beside it
      const geometry::Point lever = weight / 2 * (seen[k] - coarse.positions[found[k].points[i]]);
      result.shares.push_back({found[k].points[i], weight, lever.x(), lever.y()});
    }
    result.first.push_back(result.shares.size());
  }
  return result;
}

GalerkinLevels::Transfer GalerkinLevels::transposed(const Transfer& transfer, std::size_t others) {
  Transfer result;
  result.first.assign(others + 1, 0);
  for (const auto& share : transfer.shares) ++result.first[share.other + 1];
  for (std::size_t i = 0; i < others; ++i) result.first[i + 1] += result.first[i];
  result.shares.resize(transfer.shares.size());
  auto next = result.first;
  for (std::size_t k = 0; k + 1 < transfer.first.size(); ++k)
    for (auto s = transfer.first[k]; s < transfer.first[k + 1]; ++s) {
      const auto& share = transfer.shares[s];
      result.shares[next[share.other]++] = {std::uint32_t(k), share.weight, share.x, share.y};
    }
  return result;
}

GalerkinLevels::GalerkinLevels(const GalerkinOperator& plate, const Constraints& constraints,
                               const std::vector<geometry::Point>& seen, std::vector<GalerkinLevel> coarser)
    : coarser_(std::move(coarser)) {
  for (std::size_t level = 0; level < coarser_.size(); ++level) {
    const auto& finer = level == 0 ? plate : coarser_[level - 1].plate;
    const auto& held = level == 0 ? constraints : coarser_[level - 1].boundary.constraints;
    Sweeps s{&finer, &held, folded_diagonal(finer, held), {}, {}, {}, {}, {}, {}};
    const double step = stable_time_step(finer, held, s.inverse_diagonal);
    s.inverse_diagonal =
        s.inverse_diagonal.unaryExpr([&](double d) { return d > 0 ? share * step * step / 4 / d : 0; });
    s.from_coarser = coarser_[level].sum
                         ? std::move(coarser_[level].to_finer)
                         : transfer_to(level == 0 ? seen : coarser_[level - 1].seen, coarser_[level].cells);
    s.to_coarser = transposed(s.from_coarser, coarser_[level].plate.points());
    sweeps_.push_back(std::move(s));
  }
  const auto& [cells, beside, boundary, last, to_finer, sum] = coarser_.back();
  if (const Ranks* all = ranks())
    last_ = std::make_unique<SharedFactor>(*all, last, boundary, stiffness_matrix(last));
  else
    last_ = std::make_unique<AssembledPlate>(last, boundary.constraints, stiffness_matrix(last));
}

void GalerkinLevels::cycle(std::size_t level, const Forces& residual, State& result) const {
  if (level == sweeps_.size()) {
    last_->apply(residual, result);
    return;
  }
  const Sweeps& s = sweeps_[level];
  const auto find_rest = [&] {  // residual - K result
    s.constraints->impose(result);
    s.plate->internal_force(result, s.product);
    s.constraints->fold(s.product);
    s.rest = residual + s.product;
  };
  result = s.inverse_diagonal.cwiseProduct(residual);
  for (int i = 1; i < sweeps; ++i) {
    find_rest();
    result += s.inverse_diagonal.cwiseProduct(s.rest);
  }
  find_rest();
  const auto& coarse_level = coarser_[level];
  const auto coarse_points = Eigen::Index(coarse_level.plate.points());
  s.coarse_force.resize(3, coarse_points);
#pragma omp parallel for schedule(static)
  for (Eigen::Index i = 0; i < coarse_points; ++i) {
    Eigen::Vector3d sum(0, 0, 0);
    for (auto n = s.to_coarser.first[std::size_t(i)]; n < s.to_coarser.first[std::size_t(i) + 1]; ++n) {
      const auto& share = s.to_coarser.shares[n];
      const double force = s.rest(0, share.other);  // psi = (-theta_y, theta_x)
      sum += Eigen::Vector3d(share.weight * force, share.weight * s.rest(1, share.other) + share.y * force,
                             share.weight * s.rest(2, share.other) - share.x * force);
    }
    s.coarse_force.col(i) = sum;
  }
  if (coarse_level.sum) coarse_level.sum->add(s.coarse_force);
  coarse_level.boundary.constraints.fold(s.coarse_force);
  cycle(level + 1, s.coarse_force, s.coarse);
  coarse_level.boundary.constraints.impose(s.coarse);
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < result.cols(); ++k)
    for (auto n = s.from_coarser.first[std::size_t(k)]; n < s.from_coarser.first[std::size_t(k) + 1]; ++n) {
      const auto& share = s.from_coarser.shares[n];
      const Eigen::Vector3d u = s.coarse.col(share.other);
      result(0, k) += share.weight * u[0] + share.y * u[1] - share.x * u[2];
      result(1, k) += share.weight * u[1];
      result(2, k) += share.weight * u[2];
    }
  for (int i = 0; i < sweeps; ++i) {
    find_rest();
    result += s.inverse_diagonal.cwiseProduct(s.rest);
  }
}

void GalerkinLevels::apply(const Forces& residual, State& result) const {
  cycle(0, residual, result);
}

std::size_t GalerkinLevels::bytes() const {
  std::size_t sum = last_->bytes();
  for (const auto& level : coarser_)
    sum +=
        level.plate.bytes() + level.plate.families().families.bytes() + level.seen.size() * 2 * sizeof(geometry::Point);
  for (const auto& s : sweeps_)
    sum += 2 * s.from_coarser.shares.size() * sizeof(LevelTransfer::Share) + 6 * s.rest.size() * sizeof(double);
  return sum;
}

}  // namespace plate
