#include "plate/solve/pushing_supports.hpp"

#include <algorithm>
#include <map>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/support_constraints.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/complementarity.hpp"
#include "plate/solve/factorised_plate.hpp"

namespace plate {
namespace {

/// Directions in which points are pushed, of those whose deflection no support holds both ways.
std::map<std::uint32_t, Push> pushed_points(const Boundary& boundary) {
  std::map<std::uint32_t, Push> result;
  for (const auto& [point, holder, rotations] : boundary.holds) {
    const auto push = boundary.holders[holder].push;
    if (rotations) continue;
    const auto [known, fresh] = result.try_emplace(point, push);
    if (!fresh && known->second != push) known->second = Push::both_ways;
  }
  std::erase_if(result, [](const auto& one) { return one.second == Push::both_ways; });
  return result;
}

}  // namespace

const char* const flies_off_supports =
    "nothing holds the plate any more where its supports only push: it tips or flies off; push the other way, or add "
    "loads that press it down";

PushedPoints::PushedPoints(const Formulation& plate) : plate_(plate) {
  for (const auto& [point, push] : pushed_points(plate.boundary())) rows_.push_back({point, double(int(push))});
}

State PushedPoints::lift(std::size_t row) const {
  return rows_[row].direction * plate_.constraints().lift(SupportOffsets::gap(rows_[row].point), plate_.points());
}

State PushedPoints::lift(const Eigen::VectorXd& gaps) const {
  State result = zero_state(plate_.points());
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (const double gap = gaps[Eigen::Index(i)]; gap > 0) result += gap * lift(i);
  return result;
}

Eigen::VectorXd PushedPoints::reactions(const Forces& forces) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(rows_.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (const auto& [dof, value] : plate_.constraints().lifted(SupportOffsets::gap(rows_[i].point)))
      result[Eigen::Index(i)] -= rows_[i].direction * value * at_dof(forces, dof);
  return result;
}

LiftedSupports PushedPoints::lifted(const Eigen::VectorXd& gaps) const {
  if (gaps.size() == 0) return {};
  return {double((gaps.array() > 0).count()) / double(gaps.size()), std::max(0.0, gaps.maxCoeff())};
}

PushingSupports::PushingSupports(const Formulation& plate)
    : plate_(plate),
      factor_(std::make_unique<AssembledPlate>(plate, plate.constraints(), plate.stiffness())),
      rows_(plate),
      columns_(rows_.size()) {}

PushingSupports::~PushingSupports() = default;

/// The equilibrium with all points in contact; the second solution takes out what rounding left.
State PushingSupports::held(const Forces& load, const State& settled) const {
  State result = settled.cols() > 0 ? settled : zero_like(load);
  for (int twice = 0; twice < 2; ++twice) {
    Forces left;
    plate_.internal_force(result, left);
    left += load;
    result += factor_->solve({left}).front();
  }
  return result;
}

void PushingSupports::add_columns(const std::vector<Eigen::Index>& rows) {
  constexpr std::size_t at_once = 32;  // as many states are held
  std::vector<Eigen::Index> missing;
  for (const auto row : rows)
    if (columns_[std::size_t(row)].size() == 0) missing.push_back(row);
  for (std::size_t first = 0; first < missing.size(); first += at_once) {
    const auto count = std::min(missing.size() - first, at_once);
    std::vector<Forces> pulls(count);
    for (std::size_t i = 0; i < count; ++i)
      plate_.internal_force(rows_.lift(std::size_t(missing[first + i])), pulls[i]);
    auto states = factor_->solve(pulls);
    for (std::size_t i = 0; i < count; ++i) {
      states[i] += rows_.lift(std::size_t(missing[first + i]));
      plate_.internal_force(states[i], pulls[i]);
      columns_[std::size_t(missing[first + i])] = rows_.reactions(pulls[i]);
    }
  }
}

/// Gaps of rows that may open beside others that do not [open]. A plate that moves without resistance has a gap as
/// large as the share that lifts its stiffness makes it.
Eigen::VectorXd PushingSupports::gaps(const std::vector<Eigen::Index>& open, const Eigen::VectorXd& reactions) const {
  constexpr double share = 1e-11, same = 0.01;
  const auto count = Eigen::Index(open.size());
  Eigen::MatrixXd stiffness(count, count);
  for (Eigen::Index i = 0; i < count; ++i) stiffness.col(i) = columns_[std::size_t(open[std::size_t(i)])](open);
  stiffness = (stiffness + stiffness.transpose()).eval() / 2;
  Eigen::MatrixXd lifted = stiffness;
  lifted.diagonal().array() += share * stiffness.diagonal().maxCoeff();
  const Eigen::VectorXd first = reactions(open);
  const Eigen::VectorXd near = Complementarity(lifted, first).x;
  std::vector<Eigen::Index> gone;
  for (Eigen::Index i = 0; i < count; ++i)
    if (near[i] > 0) gone.push_back(i);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(count);
  if (gone.empty()) return result;
  result(gone) = Complementarity(stiffness(gone, gone), first(gone), std::vector<char>(gone.size(), 1)).x;
  if (!((result - near).norm() < same * near.norm())) throw NumericalError(flies_off_supports);
  return result;
}

PushingSupports::Gaps PushingSupports::operator()(const Forces& load, const State& settled) {
  constexpr double rounding = 1e-10;
  if (rows_.size() == 0) return {zero_like(load), {}};
  Forces forces;
  plate_.internal_force(held(load, settled), forces);
  forces += load;
  const Eigen::VectorXd first = rows_.reactions(forces);
  const double least = -rounding * first.cwiseAbs().maxCoeff();
  Eigen::VectorXd now = first, gap;
  std::vector<Eigen::Index> open;
  std::vector<char> may_open(rows_.size(), 0);
  for (;;) {
    const auto before = open.size();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (!may_open[i] && now[Eigen::Index(i)] < least) may_open[i] = 1, open.push_back(Eigen::Index(i));
    if (open.size() == before) break;
    add_columns(open);
    try {
      gap = gaps(open, first);
    } catch (const NumericalError&) {
      throw NumericalError(flies_off_supports);
    }
    now = first;
    for (std::size_t i = 0; i < open.size(); ++i) now += gap[Eigen::Index(i)] * columns_[std::size_t(open[i])];
  }
  Eigen::VectorXd all = Eigen::VectorXd::Zero(first.size());
  for (std::size_t i = 0; i < open.size(); ++i) all[open[i]] = gap[Eigen::Index(i)];
  return {rows_.lift(all), rows_.lifted(all)};
}

}  // namespace plate
