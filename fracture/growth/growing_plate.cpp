#include "fracture/growth/growing_plate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fracture/growth/distributed_growth.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/result_checks.hpp"

namespace fracture {
namespace {

/// The factors of a tip under a share of the load.
post::Srif scaled(post::Srif srif, double factor) {
  for (double* value : {&srif.K1, &srif.K2, &srif.K3}) *value *= factor;
  for (auto* value : {&srif.F1, &srif.F2, &srif.F3, &srif.errors[0], &srif.errors[1], &srif.errors[2]})
    if (*value) **value *= factor;
  for (auto& fit : srif.fits) fit.K1 *= factor, fit.K2 *= factor, fit.K3 *= factor;
  if (auto& second = srif.second) second->K1 *= factor, second->K2 *= factor, second->K3 *= factor;
  if (srif.G) *srif.G *= factor * factor;
  for (auto& ring : srif.rings) {
    for (double* value : {&ring.K1, &ring.K2, &ring.K3}) *value *= factor;
    ring.G *= factor * factor;
  }
  return srif;
}

/// A tip by its recommended row of these, which are in order, and has an energy release rate.
LoadedTip loaded(const geometry::Tip& tip, const post::Srif& srif, const std::vector<post::Srif>& all,
                 const plate::Section& section) {
  LoadedTip result{tip, {srif.K1, srif.K2, srif.K3}, srif.G, {INFINITY, INFINITY, INFINITY}, INFINITY};
  if (*srif.G <= 0) return result;
  double apart = INFINITY;  // of the square roots of energy release rates
  const auto compare = [&](double G) {
    const double now = G > 0 ? std::abs(1 - std::sqrt(G / *srif.G)) : 1;
    apart = std::isfinite(apart) ? std::max(apart, now) : now;
  };
  for (const auto& other : all)
    if (other.tip == srif.tip && other.G && other.method != srif.method) compare(*other.G);
  if (!std::isfinite(apart) && srif.rings.size() > 1) compare(srif.rings[1].G);
  const auto& [K1, K2, K3] = srif.errors;
  if (!K1 || !K2 || !K3) {
    result.release_error = 2 * apart;
    return result;
  }
  result.errors = {*K1, *K2, *K3};
  // where nothing vouches for the modes, the integrals alone tell how well their energy is known
  const bool modes = *K2 < post::largest_factor(srif, section.thickness);
  result.release_error = modes ? release_error(result.factors, result.errors, section)
                               : std::max(2 * apart, *K1 / std::hypot(srif.K1, srif.K2, srif.K3 * section.thickness));
  return result;
}

}  // namespace

GrowingPlate::GrowingPlate(const Growth& growth, const plate::Problem& problem, plate::Discretised first,
                           post::SrifOptions factors, const plate::Analysis& analysis, plate::Stopwatch& stopwatch)
    : QuasiStaticTips(growth, problem.section, problem.outline, problem.discretization.spacing_at_tips(),
                      problem.cracks),
      problem_(problem),
      communicator_(first.plate->communicator()),
      first_(std::move(first)),
      options_of_factors_(std::move(factors)),
      analysis_(analysis),
      stopwatch_(stopwatch),
      start_{problem.cracks, first_->plate->cut()} {}

/// Cracks that have grown may come so near to each other or to edges that the points cannot carry them.
plate::Discretised GrowingPlate::discretised(const std::vector<geometry::Polyline>& cracks) {
  if (first_) return *std::exchange(first_, {});
  problem_.cracks = cracks;
  try {
    auto result = plate::discretise(problem_, communicator_);
    stopwatch_.follow(result.stopwatch);
    return result;
  } catch (const plate::Refused& refused) {
    throw plate::NumericalError(
        fmt::format("the plate cannot be discretised with its cracks as they have grown: {}", refused.what()));
  }
}

LoadedPlate GrowingPlate::full_load(const std::vector<geometry::Polyline>& cracks) {
  auto found = discretised(cracks);
  const plate::Formulation& plate = *found.plate;
  std::vector<std::string> split;
  for (const auto& one : plate::loose(plate)) split.push_back(one.what);
  if (plate.distributed() && plate.held() && !split.empty()) throw plate::NumericalError(split.front());
  if (!split.empty()) return {fmt::format("{}", fmt::join(split, "; ")), 0, {}};
  LoadedPlate result;
  for (const auto& tip : plate.tips())
    if (!post::ringed(problem_, plate.paths(), tip) && way_through(cracks, tip))
      result.tips.push_back({tip, {}, std::nullopt});
  if (!result.tips.empty()) return result;  // they break through
  const auto methods = post::tip_methods(plate, options_of_factors_);
  const auto tips = plate.tips();
  solve(std::move(found), methods);
  const auto& [solved, state, srifs] = *latest_;
  const auto lift = plate::total_lift(*solved.plate);
  const auto load = solved.plate->total_load();
  result.held = 2 * plate::PrescribedDisplacements(*solved.plate, load, lift).work(state);
  result.displacement = 2 * post::slow_work(*solved.plate, state);
  post::require_finite({{"work", result.displacement}}, "under the whole load");
  if (!post::moves(state, result.displacement, *solved.plate))
    post::require_motion(*solved.plate, post::forces_of(*solved.plate), state, result.displacement, warnings_);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    if (!post::ringed(problem_, solved.plate->paths(), tips[i])) {
      result.tips.push_back({tips[i], {}, std::nullopt});
      continue;
    }
    const auto srif = std::ranges::find_if(srifs, [i](const auto& one) { return one.tip == i && one.G; });
    if (srif == srifs.end())
      throw plate::NumericalError(
          fmt::format("no energy release rate at {}: {}", name_of(tips[i]),
                      methods[i].left_out().empty() ? "not positive" : methods[i].left_out().front()));
    result.tips.push_back(loaded(tips[i], *srif, srifs, problem_.section));
  }
  return result;
}

void GrowingPlate::solve(plate::Discretised found, const std::vector<post::TipMethods>& methods) {
  const plate::Formulation& plate = *found.plate;
  auto solved = plate::static_solution(plate, analysis_, {analysis_.tolerance, analysis_.max_iterations, {}});
  stopwatch_.lap("solve");
  auto& solution = solved.solution;
  if (!solution.converged)
    throw plate::NumericalError(fmt::format("{}: {}, residual {:.2e} above tolerance {:.1e}", solved.method,
                                            solution.stop_reason, solution.residual, analysis_.tolerance));
  post::require_finite(solution.state, "in equilibrium", plate);
  const auto heat = plate::heat_of(plate, 1);
  auto factors = of_all(plate, post::srifs(plate, options_of_factors_, methods, solved.what_strains(), true, &heat));
  post::require_finite(factors, "under the whole load");
  stopwatch_.lap("srif");
  latest_ = Solved{std::move(found), std::move(solution.state), std::move(factors)};
  method_ = solved.method;
  solution.state = plate::no_state();
  solution_ = std::move(solution);
}

void GrowingPlate::choose(const Equilibrium& state) {
  seen_ = *std::exchange(latest_, {}), seen_factor_ = state.factor;
  QuasiStaticTips::choose(state);
}

void GrowingPlate::restore(plate::InArchive& archive) {
  first_.reset();  // its cracks are those at the start
  QuasiStaticTips::restore(archive);
  seen_ = *std::exchange(latest_, {});
}

double GrowingPlate::heated(double factor) const {
  const Solved& last = latest_ ? *latest_ : seen_;
  const plate::Formulation& plate = *last.found.plate;
  return factor * factor * plate::stored(plate, plate::heat_of(plate, 1), last.state);
}

std::optional<std::vector<post::Srif>> GrowingPlate::factors(double factor) {
  auto result = seen_.srifs;
  const auto& tips = seen_.found.plate->tips();
  for (auto& srif : result) srif = scaled(std::move(srif), factor), srif.tip = number_of(tips[srif.tip]);
  return result;
}

std::string GrowingPlate::remedy() const {
  return latest_ ? latest_->found.plate->remedy() : seen_.found.plate->remedy();
}

plate::Mesh GrowingPlate::draw(post::Frame& frame, const plate::State& state) const {
  const plate::Formulation& plate = *seen_.found.plate;
  auto mesh = plate.mesh();
  const auto first = plate.cut_at(start_);
  frame.resultants = plate.resultants(state);
  plate::relieve(frame.resultants, plate.section(), plate::heat_of(plate, seen_factor_));
  frame.damage.assign(first.size(), 0);
  for (std::size_t k = 0; k < first.size(); ++k)
    frame.damage[k] = first[k] < 1 ? 1 - (1 - plate.cut()[k]) / (1 - first[k]) : 0;
  mesh.cut = first;
  frame.cracks = record_.cracks;
  return mesh;
}

}  // namespace fracture
