#include "fracture/growth/growing_plate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fracture/growth/distributed_growth.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/crack_contact.hpp"
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
  if (auto& plane = srif.membrane) {
    for (auto& N : plane->N) N *= factor;
    for (auto& error : plane->errors)
      if (error) *error *= factor;
    if (plane->G) *plane->G *= factor * factor;
  }
  for (auto& ring : srif.rings) {
    for (double* value : {&ring.K1, &ring.K2, &ring.K3}) *value *= factor;
    ring.G *= factor * factor;
  }
  return srif;
}

/// Energy release rate of a row, of bending and in the plane together [force]; none where either is not found.
std::optional<double> release_of(const post::Srif& srif) {
  if (!srif.membrane || !srif.G) return srif.G;
  return srif.membrane->G ? std::optional(*srif.G + *srif.membrane->G) : std::nullopt;
}

Factors factors_of(const post::Srif& srif) {
  const auto N = srif.membrane ? srif.membrane->N : std::array{0.0, 0.0};
  return {.K1 = srif.K1, .K2 = srif.K2, .K3 = srif.K3, .N1 = N[0], .N2 = N[1]};
}

/// Estimated errors of the factors; none where one of them is not known.
std::optional<Factors> errors_of(const post::Srif& srif) {
  const auto& [K1, K2, K3] = srif.errors;
  if (!K1 || !K2 || !K3) return std::nullopt;
  Factors result{*K1, *K2, *K3};
  if (!srif.membrane) return result;
  const auto& [N1, N2] = srif.membrane->errors;
  if (!N1 || !N2) return std::nullopt;
  result.N1 = *N1, result.N2 = *N2;
  return result;
}

/// True where the estimated errors of the factors leave their modes known, of bending and in the plane.
bool modes_known(const post::Srif& srif, const Factors& errors, double thickness) {
  const double largest = post::largest_factor(srif, thickness);
  if (!srif.membrane) return errors.K2 < largest;
  const auto& N = srif.membrane->N;
  const double in_plane = std::max(std::abs(N[0]), std::abs(N[1]));
  return (errors.K2 < largest || largest == 0) && (errors.N2 < in_plane || in_plane == 0);
}

/// Sets the energy release rates of a tip whose faces slide on each other and do not open: by its factors, zero where
/// these are rounding beside the forces that press the faces.
void slide(post::Srif& srif, const post::ClosedTip& closed, const plate::Section& section) {
  constexpr double rounding = 1e-4;
  const auto K = factors_of(srif);
  const bool slides = size_of(K, section.thickness) > rounding * section.thickness / 6 * closed.scale;
  srif.G = slides ? energy_release({K.K1, K.K2, K.K3}, section) : 0;
  srif.membrane->G = slides ? energy_release(K, section) - *srif.G : 0;
}

/// A tip by its recommended row of these, which are in order, and has an energy release rate.
LoadedTip loaded(const geometry::Tip& tip, const post::Srif& srif, const std::vector<post::Srif>& all,
                 const plate::Section& section) {
  const double released = *release_of(srif);
  LoadedTip result{tip, factors_of(srif), released, {INFINITY, INFINITY, INFINITY}, INFINITY};
  if (released <= 0) return result;
  double apart = INFINITY;  // of the square roots of energy release rates
  const auto compare = [&](double G) {
    const double now = G > 0 ? std::abs(1 - std::sqrt(G / released)) : 1;
    apart = std::isfinite(apart) ? std::max(apart, now) : now;
  };
  for (const auto& other : all)
    if (const auto its = release_of(other); other.tip == srif.tip && its && other.method != srif.method) compare(*its);
  if (!std::isfinite(apart) && srif.rings.size() > 1)
    compare(srif.rings[1].G + (srif.membrane ? *srif.membrane->G : 0));
  const auto errors = errors_of(srif);
  if (!errors) {
    result.release_error = 2 * apart;
    return result;
  }
  result.errors = *errors;
  // where nothing vouches for the modes, the integrals alone tell how well their energy is known
  const double h = section.thickness;
  const Factors openings{.K1 = errors->K1, .K2 = 0, .K3 = 0, .N1 = errors->N1, .N2 = 0};
  result.release_error = modes_known(srif, *errors, h)
                             ? release_error(result.factors, result.errors, section)
                             : std::max(2 * apart, size_of(openings, h) / size_of(result.factors, h));
  return result;
}

/// @throws plate::NumericalError  no equilibrium within the tolerance, or a number is not finite
void require_equilibrium(const plate::Formulation& plate, const plate::StaticResult& found, double tolerance) {
  const auto& solution = found.solution;
  if (!solution.converged)
    throw plate::NumericalError(fmt::format("{}: {}, residual {:.2e} above tolerance {:.1e}", found.method,
                                            solution.stop_reason, solution.residual, tolerance));
  post::require_finite(solution.state, "in equilibrium", plate);
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
      start_{problem.cracks, first_->plate->cut()} {
  if (first_->membrane) record_.acts_in_plane();
}

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

/// Describes what supports do not hold any more, across the plate or in its plane; empty where all is held.
std::string GrowingPlate::split(const plate::Discretised& found) const {
  std::vector<std::string> result;
  for (const auto& one : plate::loose(*found.plate)) result.push_back(one.what);
  if (!result.empty() || !found.membrane) return fmt::format("{}", fmt::join(result, "; "));
  // one piece that no load pulls may be free in its plane: contact alone does not move it
  if (plate::loaded_in_plane(problem_) || found.membrane->pieces().size() > 1)
    for (const auto& one : plate::loose(*found.membrane)) result.push_back(one.what);
  return fmt::format("{}", fmt::join(result, "; "));
}

LoadedPlate GrowingPlate::full_load(const std::vector<geometry::Polyline>& cracks) {
  auto found = discretised(cracks);
  const plate::Formulation& plate = *found.plate;
  const auto parted = split(found);
  if (plate.distributed() && plate.held() && !parted.empty()) throw plate::NumericalError(parted);
  if (!parted.empty()) return {parted, 0, {}};
  LoadedPlate result;
  for (const auto& tip : plate.tips())
    if (!post::ringed(problem_, plate.paths(), tip) && way_through(cracks, tip))
      result.tips.push_back({tip, {}, std::nullopt});
  if (!result.tips.empty()) return result;  // they break through
  const auto methods = post::tip_methods(plate, options_of_factors_);
  const auto tips = plate.tips();
  solve(std::move(found), methods);
  const auto& [solved, state, srifs, in_plane, contact] = *latest_;
  const auto lift = plate::total_lift(*solved.plate);
  const auto load = solved.plate->total_load();
  result.held = 2 * plate::PrescribedDisplacements(*solved.plate, load, lift).work(state);
  result.displacement = 2 * latest_->work();
  post::require_finite({{"work", result.displacement}}, "under the whole load");
  if (!latest_->moves(result.displacement))
    post::require_motion(*solved.plate, post::forces_of(*solved.plate), state, result.displacement, warnings_);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    if (!post::ringed(problem_, solved.plate->paths(), tips[i])) {
      result.tips.push_back({tips[i], {}, std::nullopt});
      continue;
    }
    const auto srif = std::ranges::find_if(srifs, [i](const auto& one) { return one.tip == i && release_of(one); });
    if (srif == srifs.end())
      throw plate::NumericalError(
          fmt::format("no energy release rate at {}: {}", name_of(tips[i]),
                      methods[i].left_out().empty() ? "not positive" : methods[i].left_out().front()));
    result.tips.push_back(loaded(tips[i], *srif, srifs, problem_.section.at(tips[i].position)));
  }
  return result;
}

void GrowingPlate::solve(plate::Discretised found, const std::vector<post::TipMethods>& methods) {
  const plate::Formulation& plate = *found.plate;
  auto solved = plate::static_solution(plate, analysis_, {analysis_.tolerance, analysis_.max_iterations, {}});
  stopwatch_.lap("solve");
  auto& solution = solved.solution;
  require_equilibrium(plate, solved, analysis_.tolerance);
  auto in_plane = found.membrane ? at_rest_in_plane(*found.membrane) : plate::no_state();
  std::vector<post::ClosedTip> closed;
  std::optional<post::ContactSummary> contact;
  if (problem_.faces_touch()) {
    const auto touching = plate::touching_faces(plate, *found.membrane, {solution.state, in_plane});
    solution.state += touching.bending, in_plane += touching.membrane;
    if (solved.strained.cols() > 0) solved.strained += touching.bending;
    closed = post::closed_tips(touching, plate);
    contact = {touching.least_opening(), touching.largest_force(), touching.closed_share()};
  }
  const auto heat = plate::heat_of(plate, 1);
  auto factors = of_all(plate, post::srifs(plate, options_of_factors_, methods, solved.what_strains(), true, &heat));
  latest_ = Solved{.found = std::move(found),
                   .state = std::move(solution.state),
                   .srifs = std::move(factors),
                   .in_plane = std::move(in_plane),
                   .contact = contact};
  if (latest_->found.membrane) add_in_plane(*latest_, closed);
  post::require_finite(latest_->srifs, "under the whole load");
  stopwatch_.lap("srif");
  method_ = solved.method;
  solution.state = plate::no_state();
  solution_ = std::move(solution);
}

/// State of a plate in its plane under all its loads there.
plate::State GrowingPlate::at_rest_in_plane(const plate::Formulation& membrane) const {
  if (!plate::loaded_in_plane(problem_)) return plate::zero_state(membrane.points());
  auto found = plate::static_solution(membrane, analysis_, {analysis_.tolerance, analysis_.max_iterations, {}});
  require_equilibrium(membrane, found, analysis_.tolerance);
  return std::move(found.solution.state);
}

/// Adds the factors in the plane. `closed`: of every tip, where faces of cracks may touch.
void GrowingPlate::add_in_plane(Solved& solved, const std::vector<post::ClosedTip>& closed) const {
  const auto& membrane = *solved.found.membrane;
  auto& srifs = solved.srifs;
  const auto methods = post::tip_methods(membrane, options_of_factors_);
  const auto heat = plate::heat_of(membrane, 1);
  const auto own = post::srifs(membrane, options_of_factors_, methods, solved.in_plane, true, &heat);
  post::add_membrane(srifs, of_all(membrane, own), problem_.section);
  for (auto& srif : srifs)
    if (!srif.membrane) srif.G.reset();  // bending alone does not tell what the plate releases
  if (closed.empty()) return;
  post::close(srifs, closed, problem_.section);
  for (auto& srif : srifs)
    if (const auto& tip = closed[srif.tip]; tip.top && tip.bottom && srif.G)
      slide(srif, tip, problem_.section.at(srif.position));
}

double GrowingPlate::Solved::work() const {
  const double bending = post::slow_work(*found.plate, state);
  return found.membrane ? bending + post::slow_work(*found.membrane, in_plane) : bending;
}

bool GrowingPlate::Solved::moves(double work) const {
  return post::moves(state, work, *found.plate) || (found.membrane && post::moves(in_plane, work, *found.membrane));
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
  const auto stored = [factor](const plate::Formulation& plate, const plate::State& state) {
    return factor * factor * plate::stored(plate, plate::heat_of(plate, 1), state);
  };
  const auto& [plate, membrane, warnings, stopwatch] = last.found;
  return stored(*plate, last.state) + (membrane ? stored(*membrane, last.in_plane) : 0);
}

std::optional<std::vector<post::Srif>> GrowingPlate::factors(double factor) {
  auto result = seen_.srifs;
  const auto& tips = seen_.found.plate->tips();
  for (auto& srif : result) srif = scaled(std::move(srif), factor), srif.tip = number_of(tips[srif.tip]);
  return result;
}

std::optional<post::ContactSummary> GrowingPlate::contact(double factor) const {
  auto result = seen_.contact;
  if (result) result->least_opening *= factor, result->largest_pressure *= factor;
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
