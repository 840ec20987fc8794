#include "cases/runs/membrane.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numbers>

#include "cases/input/case_file.hpp"
#include "cases/runs/cost_estimate.hpp"
#include "cases/runs/run_plan.hpp"
#include "fracture/breakage/damaged_plate.hpp"
#include "fracture/growth/distributed_growth.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/coupled_plate.hpp"
#include "plate/solve/crack_contact.hpp"
#include "plate/solve/large_deflections.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/stretched_motion.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/errors.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/result_checks.hpp"
#include "post/report/overlaps.hpp"
#include "post/report/reactions.hpp"

namespace cases {
namespace {

/// Forces in the plane: the couples on theta_x = -v and theta_y = u.
std::vector<post::MembraneSummary::Reaction> reactions_of(const plate::Formulation& membrane,
                                                          const plate::Operator& stiffness, const plate::State& state,
                                                          const plate::Forces& load) {
  post::ReactionRows rows;
  rows.add(0, membrane, stiffness, state, load);
  std::vector<post::MembraneSummary::Reaction> result;
  const auto found = rows.summary();
  for (std::size_t i = 0; found && i < found->supports.size(); ++i) {
    const auto& wrench = found->balance.supports[i];
    result.push_back({found->supports[i].name, {wrench.moment_y, -wrench.moment_x}});
  }
  return result;
}

/// A warning of the pin whose force in the plane changes the factors of a tip near it most, by those of an infinite
/// plate: N = P / (pi sqrt(2 d)), d the distance from the tip.
std::vector<std::string> warnings_about_pins(const plate::Formulation& membrane,
                                             const std::vector<post::MembraneSummary::Reaction>& reactions,
                                             const std::vector<post::Srif>& factors) {
  constexpr double much = 0.2;  // of the largest factor of the tip
  double worst = much;
  std::vector<std::string> result;
  for (const auto& holder : membrane.boundary().holders) {
    const auto found = std::ranges::find(reactions, holder.name, &post::MembraneSummary::Reaction::name);
    if (holder.place != plate::Holder::Place::point || !holder.position || found == reactions.end()) continue;
    for (const auto* one : post::recommended(factors)) {
      const double away = (*holder.position - one->position).norm(), force = found->force.norm();
      const double share =
          force / (std::numbers::pi * std::sqrt(2 * away) * std::max(std::abs(one->K1), std::abs(one->K2)));
      if (!(share > worst)) continue;
      worst = share;
      result = {fmt::format(
          "{} pulls with {:.3g} at {:.2g} from tip {} and changes its N1, N2; set support[{}].points elsewhere",
          holder.name, force, away, one->tip, holder.support)};
    }
  }
  return result;
}

/// A warning of two points next to each other whose forces in the plane oppose: they hold the strain between them,
/// which no engineer means where they are to hold the plate against rigid motions alone.
std::vector<std::string> warnings_about_opposed_pins(const plate::Formulation& membrane,
                                                     const std::vector<post::MembraneSummary::Reaction>& reactions,
                                                     const plate::Forces& load) {
  constexpr double near = 0.1, small = 0.05, alike = 0.5;  // of the plate's size, a point's load, the larger force
  const auto [low, high] = geometry::bounding_box(membrane.problem().outline);
  const double least = small * plate::largest_of(membrane, load.bottomRows(2).cwiseAbs().maxCoeff());
  const auto& holders = membrane.boundary().holders;
  const auto force = [&](const plate::Holder& holder) -> std::optional<geometry::Point> {
    const auto found = std::ranges::find(reactions, holder.name, &post::MembraneSummary::Reaction::name);
    if (holder.place != plate::Holder::Place::point || !holder.position || found == reactions.end()) return {};
    return found->force;
  };
  for (auto one = holders.begin(); one != holders.end(); ++one)
    for (auto other = holders.begin(); other != one; ++other) {
      const auto pulls = force(*one), against = force(*other);
      if (!pulls || !against) continue;
      const geometry::Point apart = *one->position - *other->position;
      if (apart.norm() > near * (high - low).norm()) continue;
      const double most = std::max(pulls->norm(), against->norm());
      if (most < least || (*pulls + *against).norm() > alike * most) continue;
      return {
          fmt::format("{} and {} pull at each other with {:.2g}: they hold the strain between them; set in_plane = "
                      "\"{}\" at one",
                      other->name, one->name, most, std::abs(apart.x()) > std::abs(apart.y()) ? "y" : "x")};
    }
  return {};
}

}  // namespace

MembraneResult membrane_results(const plate::Formulation& membrane, const plate::State& state,
                                const plate::Forces& load, const plate::Heat& heat, const MembraneFactorsWanted& wanted,
                                const std::string& where, const plate::Stretch* stretch,
                                const fracture::DamagedPlate* damaged) {
  const auto& [options, methods, all_rings, largest_before, known] = wanted;
  post::require_finite(state, "in equilibrium " + where, membrane);
  MembraneResult result;
  const auto points = Eigen::Index(membrane.cloud().plate_points);
  if (!damaged && heat.linear &&
      heat.linear->varies()) {  // strains at edges are means of half a cell, where those of the heat are not
    result.forces =
        membrane.resultants(state - plate::free_field(membrane.cloud().positions, membrane.problem(), *heat.linear));
  } else {
    result.forces = damaged ? damaged->resultants(state) : membrane.resultants(state);
    plate::relieve(result.forces, membrane.section(), heat);
  }
  result.fields.displacement.resize(2, points);
  result.fields.displacement << state.row(2).head(points), -state.row(1).head(points);
  result.fields.force = result.forces.moments;
  if (options) {
    result.factors =
        known ? *known
              : fracture::of_all(membrane, post::srifs(membrane, *options, methods, state, all_rings, &heat, stretch));
    if (largest_before) post::mark_lost(result.factors, membrane.section().thickness, *largest_before);
    for (const auto& line : post::left_out(membrane.tips(), methods, *options))
      result.warnings.push_back(of_plane(line));
    post::require_finite(result.factors, where);
  }
  auto& summary = result.summary;
  result.stored = plate::stored(membrane, heat, state);
  summary.strain_energy =
      (damaged ? plate::half_work(membrane, *damaged, state) : membrane.strain_energy(state)) + result.stored;
  summary.external_work = post::slow_work(membrane, load, state) + result.stored;
  summary.largest_displacement = plate::largest_of(membrane, result.fields.displacement.colwise().norm().maxCoeff());
  const auto& stiffness = damaged ? static_cast<const plate::Operator&>(*damaged) : membrane;
  summary.reactions = reactions_of(membrane, stiffness, state, load);
  for (const auto& line : warnings_about_pins(membrane, summary.reactions, result.factors))
    result.warnings.push_back(of_plane(line));
  for (const auto& line : warnings_about_opposed_pins(membrane, summary.reactions, load))
    result.warnings.push_back(of_plane(line));
  return result;
}

void couple(MembraneResult& result, const plate::Formulation& plate, const plate::Formulation& membrane,
            const StatesOfBoth& states, const Eigen::Matrix3Xd& strains, const plate::Heat& heat) {
  if (!plate.section().couples()) return;
  result.of_both = plate.resultants(states.bending), result.forces = membrane.resultants(states.membrane);
  const auto points = result.forces.moments.cols();
  result.forces.moments += plate::LocalSection(membrane.section()).bending * strains.leftCols(points);
  plate::couple(*result.of_both, result.forces, plate.section(), &heat);
  result.fields.force = result.forces.moments;
}

MembraneResult membrane_results(const plate::Formulation& plate, const plate::Formulation& membrane,
                                const plate::LargeDeflections& found, const plate::Forces& in_plane,
                                const plate::Heat& heat, const MembraneFactorsWanted& wanted,
                                const std::string& where) {
  auto result =
      membrane_results(membrane, found.membrane, in_plane + found.stretch.forces, heat, wanted, where, &found.stretch);
  result.forces.moments = found.membrane_forces;
  plate::relieve(result.forces, membrane.section(), heat);
  result.fields.force = result.forces.moments;
  couple(result, plate, membrane, {found.bending, found.membrane}, found.stretch.strains, heat);
  result.stored += found.stored_by_deflections;
  result.summary.strain_energy = found.membrane_energy + result.stored;
  result.summary.external_work = found.external_work + result.stored;
  result.summary.residual = found.steps.empty() ? 0 : found.steps.back().residual;
  return result;
}

MembraneResult membrane_results(const plate::Formulation& plate, const plate::Formulation& membrane,
                                const plate::CoupledEquilibrium& found, const plate::PlateLoads& loads,
                                const plate::Heat& heat, const MembraneFactorsWanted& wanted,
                                const std::string& where) {
  auto result = membrane_results(membrane, found.membrane, loads.in_plane + found.on_membrane, heat, wanted, where);
  result.summary.strain_energy = found.stretching_energy + result.stored;
  result.summary.external_work = post::slow_work(membrane, loads.in_plane, found.membrane) + result.stored;
  result.summary.residual = found.of_both.residual;
  couple(result, plate, membrane, {found.what_strains(), found.membrane},
         Eigen::Matrix3Xd::Zero(3, found.bending.cols()), heat);
  return result;
}

MembraneResult results_of_shape(const plate::Formulation& plate, const plate::Formulation& membrane,
                                const StatesOfBoth& shape, const plate::Heat& heat, const std::string& where) {
  const std::optional<post::SrifOptions> no_factors;
  const auto none = plate::zero_forces(plate.points());
  plate::CoupledEquilibrium found;
  found.bending = shape.bending, found.membrane = shape.membrane, found.on_bending = found.on_membrane = none;
  return membrane_results(plate, membrane, found, {none, none}, heat, {no_factors, {}}, where);
}

double work_of_supports(const plate::Formulation& plate, const plate::CoupledEquilibrium& found,
                        const plate::Forces& across, const plate::State& lift) {
  const plate::Forces load = across + found.on_bending;
  return plate::PrescribedDisplacements(plate, load, lift).work(found.what_strains());
}

post::Table load_steps(const std::vector<plate::LoadStep>& steps, plate::LoadControl control) {
  const bool path = control == plate::LoadControl::arc_length;
  post::Table table{{"factor", "iterations", "residual", "largest_deflection", "strain_energy", "stable", "snapped"},
                    {}};
  if (path)
    for (const char* more : {"arc_length", "deflection", "unstable_modes"}) table.columns.emplace_back(more);
  for (const auto& step : steps) {
    auto& row = table.rows.emplace_back();
    row = {step.factor,
           double(step.iterations),
           step.residual,
           step.largest_deflection,
           step.strain_energy,
           step.stable ? "yes" : "no",
           step.snapped ? "yes" : "no"};
    if (path)
      for (const double more : {step.arc_length, step.deflection, double(step.unstable_modes)}) row.emplace_back(more);
  }
  return table;
}

std::vector<std::string> warnings_about(const plate::LargeDeflections& found, double stored, const Case& c) {
  constexpr double coarse = 0.05, rounding = 1e-9;
  const bool follows = c.load_cases.empty() && !c.faces_touch();  // paths by arc length
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    const auto& step = found.steps[i];
    const double before = i == 0 ? 0 : found.steps[i - 1].factor;
    if (step.snapped && step.factor == 0)
      lines.emplace_back("the plate snaps under its constant loads and may rest on either side: see load_steps.csv");
    else if (step.snapped)
      lines.push_back(fmt::format("the plate snaps between load factors {:.4g} and {:.4g}: {}see load_steps.csv",
                                  before, step.factor,
                                  follows ? "analysis.control = \"arc_length\" finds the states between; " : ""));
  }
  if (!found.steps.empty() && !found.steps.back().stable)
    lines.emplace_back("the equilibrium is not stable: give the plate a small load across it");
  const double strain = found.strain_energy(), apart = std::abs(found.external_work - strain) / (strain + stored);
  if (strain > rounding * stored && !found.snapped() && apart > coarse)
    lines.push_back(
        fmt::format("strain energy and work of the loads differ by {:.2g} %: the state may not be the one "
                    "that grows with the loads; see load_steps.csv",
                    100 * apart));
  std::ranges::copy(warnings_about_rotations(found.largest_rotation), std::back_inserter(lines));
  return lines;
}

void require_equilibrium(const plate::Formulation& membrane, const plate::StaticSolution& solution, double tolerance,
                         const std::string& where) {
  post::require_finite(solution.state, "in equilibrium " + where, membrane);
  if (!solution.converged)
    throw plate::NumericalError(fmt::format("{}: {}, residual {:.2e} above tolerance {:.1e}", where,
                                            solution.stop_reason, solution.residual, tolerance));
}

void look_for_coarseness(double strain, double work, const plate::Formulation& plate,
                         std::vector<std::string>& warnings) {
  constexpr double told = 0.01, most = 0.3;
  const double apart = std::abs(strain / work - 1);
  const auto text = fmt::format("the strain energy is {:.1f} % off the work of the loads: the points are coarse; {}",
                                100 * apart, plate.remedy());
  if (apart > most) throw plate::NumericalError(text);
  if (apart > told) warnings.push_back(text);
}

bool only_stored(double strain_energy, double stored) {
  constexpr double rounding = 1e-12;
  return strain_energy < rounding * stored;
}

void require_balance(const MembraneResult& result, const std::string& where) {
  const double strain = result.summary.strain_energy - result.stored;
  if (only_stored(strain, result.stored)) return;
  post::EnergyBalance(post::EnergyBalance::Plate::rests)
      .check({strain, strain, result.summary.external_work - result.stored}, "in equilibrium " + where);
}

MembraneResult membrane_at_rest(const plate::Formulation& membrane, const plate::Analysis& analysis,
                                const MembraneFactorsWanted& wanted, const plate::StaticResult* solved) {
  const std::string where = "in the plane";
  const auto found =
      solved ? *solved : plate::static_solution(membrane, analysis, {analysis.tolerance, analysis.max_iterations, {}});
  const auto& solution = found.solution;
  require_equilibrium(membrane, solution, analysis.tolerance, where);
  const auto heat = plate::heat_of(membrane, 1);
  auto result = membrane_results(membrane, solution.state, membrane.total_load(), heat, wanted, where);
  auto& summary = result.summary;
  summary.residual = solution.residual;
  const double work = post::slow_work(membrane, found);
  summary.external_work = work + result.stored;
  if (only_stored(std::abs(summary.strain_energy), std::abs(result.stored)))
    result.warnings.clear();  // heat leaves the plate free of stress: N1 and N2 are rounding
  if (heat.none() && !post::moves(solution.state, work, membrane))  // a heated plate may be held all round
    post::require_motion(membrane, post::forces_of(membrane), solution.state, work, result.warnings);
  if (membrane.offers(plate::Feature::symmetry)) {
    require_balance(result, where);
    return result;
  }
  std::vector<std::string> coarse;
  look_for_coarseness(summary.strain_energy, summary.external_work, membrane, coarse);
  for (const auto& line : coarse) result.warnings.push_back(of_plane(line));
  return result;
}

FacesFound faces_found(const plate::TouchingFaces& found, const plate::Formulation& plate) {
  FacesFound result{
      .summary = {found.least_opening(), found.largest_force(), found.closed_share()},
      .faces = {{"x", "y", "length", "opening_top", "opening_bottom", "pressure_top", "pressure_bottom"}, {}},
      .closed = post::closed_tips(found, plate)};
  for (const auto& at : found.faces)
    result.faces.rows.push_back({at.position.x(), at.position.y(), at.length, at.opening_top, at.opening_bottom,
                                 at.force_top, at.force_bottom});
  return result;
}

namespace {

/// Equilibria of a plate and its plane with contact, and its findings.
struct Touched {
  plate::State in_plane;
  plate::TouchingFaces touching;
  double residual = 0;  // in the plane, of loads there alone
  std::size_t factor_bytes = 0;
};

/// Adds to `bending`, a state without contact, what contact changes.
Touched touched(const plate::Formulation& plate, const plate::Formulation& membrane, const plate::Analysis& analysis,
                plate::StaticResult& bending) {
  Touched result{.in_plane = plate::zero_state(membrane.points()), .touching = {}};
  if (plate::loaded_in_plane(plate.problem())) {
    const auto found = plate::static_solution(membrane, analysis, {analysis.tolerance, analysis.max_iterations, {}});
    require_equilibrium(membrane, found.solution, analysis.tolerance, "in the plane");
    result.in_plane = found.solution.state, result.residual = found.solution.residual;
  }
  result.touching = plate::touching_faces(plate, membrane, {bending.solution.state, result.in_plane});
  bending.solution.state += result.touching.bending, result.in_plane += result.touching.membrane;
  if (bending.strained.cols() > 0) bending.strained += result.touching.bending;
  result.factor_bytes = result.touching.factor_bytes;
  return result;
}

/// Finds `bending` where contact of faces changes what else touches: soil, supports that only push.
Touched touched_beside(const plate::Formulation& plate, const plate::Formulation& membrane,
                       const plate::Analysis& analysis, plate::StaticResult& bending) {
  const plate::CoupledPlate both(plate, membrane);
  auto found = both.equilibrium({plate.total_load(), membrane.total_load()},
                                {analysis.tolerance, analysis.max_iterations, {}}, plate::total_lift(plate));
  require_equilibrium(plate, found.of_both, analysis.tolerance, "in equilibrium with contact");
  const double residual = found.of_both.residual;
  bending = {.solution = std::move(found.of_both),
             .method = "direct",
             .preconditioner = {},
             .strained = std::move(found.strained),
             .lifted = found.lifted};
  bending.solution.state = std::move(found.bending);
  return {std::move(found.membrane), std::move(*found.touching), residual, both.factor_bytes()};
}

}  // namespace

ContactResult with_contact(const plate::Formulation& plate, const plate::Formulation& membrane,
                           const plate::Analysis& analysis, const MembraneFactorsWanted& wanted,
                           plate::StaticResult& bending) {
  const auto found = plate::rests_with_plane(plate.problem()) ? touched_beside(plate, membrane, analysis, bending)
                                                              : touched(plate, membrane, analysis, bending);
  ContactResult result{.in_plane = membrane_results(membrane, found.in_plane, membrane.total_load(),
                                                    plate::heat_of(membrane, 1), wanted),
                       .faces = faces_found(found.touching, plate),
                       .factor_bytes = found.factor_bytes};
  result.in_plane.summary.residual = found.residual;
  return result;
}

namespace {

/// Estimates on a plate of fewer points, which is solved for it.
double linear_theory_off_by(const plate::Problem& problem, double wider) {
  plate::Problem coarse = problem;
  coarse.joined_with_plane = true;
  coarse.discretization = widened(problem.discretization, wider);
  const auto [plate, membrane, warnings, stopwatch] = plate::discretise(coarse);
  const auto made = membrane ? nullptr : plate->middle_plane();
  const auto& plane = membrane ? *membrane : *made;
  const auto found = plate::static_solution(*plate, {}, {});
  return plate::linear_theory_off(*plate, plane, found.solution.state,
                                  {{}, plane.total_load(), plate::stiffness_of_heat(plane, plate::heat_of(plane, 1))});
}

/// Estimates with points beyond edges that the plate and its plane share, as those of a linear run do not. `load`: in
/// the plane.
double linear_theory_off_joined(const plate::Formulation& plate, const plate::Formulation& plane,
                                const plate::State& state, plate::Forces load, const plate::Heat& heat) {
  plate::Problem joined = plate.problem();
  joined.joined_with_plane = true;
  const auto [bent, membrane, warnings, stopwatch] = plate::discretise(joined);
  const auto made = membrane ? nullptr : bent->middle_plane();
  const auto& pulled = membrane ? *membrane : *made;
  const auto shared = Eigen::Index(plate.cloud().plate_points);
  plate::State bending = plate::zero_state(bent->points());
  bending.leftCols(shared) = state.leftCols(shared);
  bent->constraints().impose(bending);
  plane.constraints().fold(load);
  plate::Forces in_plane = plate::zero_like(bending);
  in_plane.leftCols(shared) = load.leftCols(shared);
  return plate::linear_theory_off(*bent, pulled, bending, {{}, in_plane, plate::stiffness_of_heat(pulled, heat)});
}

}  // namespace

std::optional<double> linear_theory_off(const plate::Formulation& plate, const plate::State& state,
                                        const plate::Formulation* membrane, const plate::Forces& in_plane,
                                        const plate::Heat& heat) {
  constexpr double least = 1e-6, small = 0.1, large = 10;  // thicknesses
  constexpr double some = 2500, many = 20000;  // points: a plate of more takes no factor, but fewer points for this
  const auto& problem = plate.problem();
  if (!plate.offers(plate::Feature::stretching) || plate::has_prescribed_displacements(plate)) return std::nullopt;
  if (problem.unilateral() || problem.pushed() || problem.faces_touch()) return std::nullopt;
  if (problem.coupled() || std::ranges::any_of(problem.stiffeners, &plate::Stiffener::stretches)) return std::nullopt;
  const auto& map = plate.boundary().map;
  const double share = plate::largest_of(map, state.row(0).cwiseAbs().maxCoeff()) / plate.section().thickness;
  const bool loaded = plate::loaded_in_plane(problem);  // small deflections may be those beside a buckling load
  if (!(share > (loaded ? least : small) && share < large)) return std::nullopt;
  const bool one_load = problem.load_cases.empty(), parted = plate.distributed();
  const auto points =
      parted ? double(plate::count_of_all(map, std::ranges::count(map.owned, 1))) : double(plate.points());
  if (!one_load && (parted || points > many)) return std::nullopt;
  try {
    if (one_load && (parted || points > 2 * some))  // every process solves the same
      return linear_theory_off_by(problem, std::sqrt(std::max(1.0, points / some)));
    const auto made = membrane ? nullptr : plate.middle_plane();
    const auto& plane = membrane ? *membrane : *made;
    const plate::Forces load = in_plane.cols() > 0 ? in_plane : plate::zero_state(plane.points());
    if (plane.points() != plate.points()) return linear_theory_off_joined(plate, plane, state, load, heat);
    return plate::linear_theory_off(plate, plane, state, {{}, load, plate::stiffness_of_heat(plane, heat)});
  } catch (const plate::Refused&) {
    return std::nullopt;
  } catch (const plate::NumericalError&) {  // parts that move freely in the plane
    return std::nullopt;
  }
}

std::optional<double> linear_theory_off(const plate::Formulation& plate, const plate::State& state,
                                        const plate::Formulation* membrane) {
  return linear_theory_off(plate, state, membrane, membrane ? membrane->total_load() : plate::no_state(),
                           membrane ? plate::heat_of(*membrane, 1) : plate::Heat());
}

void add_in_plane(post::Frame& frame, const plate::Formulation& plate, const plate::Formulation& membrane,
                  const MembraneResult& result) {
  frame.in_plane = result.fields;
  if (result.of_both) {
    frame.resultants = *result.of_both;
    return;
  }
  plate::add_membrane_forces(frame.resultants, plate.sections(), result.forces, membrane.sections());
}

std::string of_plane(std::string warning) {
  for (const char factor : {'1', '2'})
    for (auto at = warning.find(std::string("K") + factor); at != std::string::npos;
         at = warning.find(std::string("K") + factor, at))
      warning[at] = 'N';
  return "in the plane: " + warning;
}

std::vector<std::string> warnings_about_pressed_faces(const plate::Formulation& membrane, plate::Analysis analysis,
                                                      const plate::State* known) {
  constexpr double tolerance = 1e-8;
  std::vector<std::string> result;
  if (membrane.tips().empty()) return result;
  analysis.tolerance = tolerance;
  const std::optional<post::SrifOptions> options{std::in_place};
  const auto methods = post::tip_methods(membrane, *options);
  const auto factors = known ? post::srifs(membrane, *options, methods, *known)
                             : membrane_at_rest(membrane, analysis, {options, methods}).factors;
  for (const auto* one : post::recommended(factors))
    if (one->resolved[0] && one->K1 < -one->errors[0].value_or(0))
      result.push_back(
          fmt::format("tip {} ({:.4g}, {:.4g}): loads press the faces of the crack together, which do not "
                      "touch here: results are of faces that overlap",
                      one->tip, one->position.x(), one->position.y()));
  return result;
}

std::vector<std::string> warnings_about_rotations(double largest) {
  constexpr double moderate = 0.3;
  if (largest <= moderate) return {};
  return {fmt::format("rotations reach {:.2g}: von Karman's strains hold up to about {:g}; set smaller loads", largest,
                      moderate)};
}

bool may_touch(const Case& c, const plate::Formulation& plate) {
  return !c.ties_faces() && c.analysis.control == plate::LoadControl::load && (!c.growth || c.grows_at_rest()) &&
         plate.offers(plate::Feature::touching_faces);
}

std::vector<std::string> warnings_about_overlaps(const std::vector<post::Srif>& srifs, bool may_touch) {
  std::vector<std::string> result;
  for (const auto* one : post::recommended(srifs)) {
    const auto where = post::overlap(*one);
    if (where != post::Overlap::above && where != post::Overlap::both) continue;
    result.push_back(fmt::format("tip {} ({:.4g}, {:.4g}): the faces of the crack overlap {}; {}", one->tip,
                                 one->position.x(), one->position.y(),
                                 where == post::Overlap::both ? "all over the thickness" : "at z > 0",
                                 post::remedy_of_overlaps(may_touch)));
  }
  return result;
}

}  // namespace cases
