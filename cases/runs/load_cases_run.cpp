#include <fmt/format.h>
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "cases/input/compatibility.hpp"
#include "cases/runs/analyses.hpp"
#include "cases/runs/membrane.hpp"
#include "cases/runs/outputs.hpp"
#include "fracture/growth/distributed_growth.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/coupled_plate.hpp"
#include "plate/solve/crack_contact.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/large_deflections.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/errors.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/result_checks.hpp"
#include "post/report/conclusion.hpp"
#include "post/report/overlaps.hpp"
#include "post/report/printed.hpp"
#include "post/report/reactions.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

/// Loads of a load case or combination in the plane, and the state. `acts`: there are any, and they do not cancel.
struct InPlaneState {
  plate::Forces load;
  plate::State state;
  bool acts = false;
  double residual = 0;    // relative; of a combination at most this
  plate::Heat heat = {};  // among the load
};

/// Loads of a load case or combination, and the state.
struct LoadCaseState {
  plate::Forces load;
  plate::State lift, state;  // lift: of supports that have moved, without columns where none has
  plate::Heat heat;
  plate::State strained = plate::no_state();              // plate::StaticResult
  std::optional<InPlaneState> in_plane = {};              // where loads of any load case act there
  std::optional<plate::LargeDeflections> curved = {};     // where they were asked for
  std::optional<plate::CoupledEquilibrium> coupled = {};  // of a plate together with its plane
  std::optional<plate::TouchingFaces> touching = {};      // where faces of cracks may touch

  const plate::State& what_strains() const { return strained.cols() > 0 ? strained : state; }
};

/// Sums of forces below this share of the largest part are rounding.
constexpr double rounding = 1e-12;

double folded_norm(const plate::Formulation& plate, const plate::Forces& load, const plate::State& lift) {
  auto pull = plate::PrescribedDisplacements(plate, load, lift).pull();
  plate.constraints().fold(pull);
  const auto [squared] = plate::ordered_sum<1>(plate, std::size_t(pull.size()), [&](std::size_t i) {
    return std::array<double, 1>{pull.data()[i] * pull.data()[i]};
  });
  return std::sqrt(squared);
}

/// Nodal forces of all loads of a load case; zero where they cancel.
plate::Forces forces_of_case(const plate::Formulation& plate, std::size_t which) {
  plate::Forces result = plate::zero_forces(plate.points());
  std::vector<plate::Forces> acting;
  for (const auto k : plate::loads_of(plate.problem(), which)) result += acting.emplace_back(plate.loads()[k].forces);
  if (plate::cancel(plate, acting)) result.setZero();
  return result;
}

/// Factors of all loads in a load case.
std::vector<double> shares_of(const plate::Problem& problem, std::size_t which) {
  std::vector<double> result(problem.loads.size(), 0);
  for (const auto k : plate::loads_of(problem, which)) result[k] = 1;
  return result;
}

/// Factors of all loads in a combination.
std::vector<double> shares_of(const plate::Combination& combination, const plate::Problem& problem) {
  const auto factors = plate::factors_of(combination, problem.load_cases);
  std::vector<double> result(problem.loads.size(), 0);
  for (std::size_t i = 0; i < factors.size(); ++i)
    for (const auto k : plate::loads_of(problem, i)) result[k] += factors[i];
  return result;
}

double largest_deflection(const post::LoadCaseSummary& one) {
  const auto found = std::ranges::find(one.extremes, "w", &post::Peak::quantity);
  return found == one.extremes.end() ? 0 : std::abs(found->value);
}

/// A part of a combination: its factor, and the intensity factors of the load case.
using CombinedPart = std::pair<double, const std::vector<post::Srif>*>;

/// Raises the largest factor of every tip [tips] to those of a row.
void take(std::vector<double>& largest, const std::vector<post::Srif>& row, double thickness) {
  for (const auto& srif : row)
    largest[srif.tip] = std::max(largest[srif.tip], post::largest_with_plane(srif, thickness));
}

/// The factors without those of tips that a load case hardly loads. `largest`: factor of every tip in all load cases.
std::vector<post::Srif> of_loaded_tips(std::vector<post::Srif> row, const std::vector<double>& largest,
                                       double thickness) {
  constexpr double hardly = 1e-3;
  std::erase_if(row, [&](const post::Srif& srif) {
    return post::largest_with_plane(srif, thickness) < hardly * largest[srif.tip];
  });
  return row;
}

/// The utilisation of every tip by its recommended factors, where there is one.
std::map<std::size_t, double> utilisations(const post::LoadCaseSummary& one) {
  std::map<std::size_t, double> result;
  for (std::size_t i = 0; i < one.faces.size(); ++i)
    if (one.faces[i].utilisation) result.emplace(one.srif[i].tip, *one.faces[i].utilisation);
  return result;
}

/// Load cases and combinations as they are found.
class LoadCases : public PlateAnalysis {
public:
  LoadCases(const ValidatedPlate& ready, Outputs& outputs) : PlateAnalysis(ready, outputs) {}

  void solve() override;
  void finish() override;

private:
  void solve_stretched();
  void find_equilibrium(post::LoadCaseSummary& one, LoadCaseState& now);
  void find_both(post::LoadCaseSummary& one, LoadCaseState& now);
  void touch(post::LoadCaseSummary& one, LoadCaseState& now);
  void record_contact(post::LoadCaseSummary& one, const plate::TouchingFaces& found);
  void look(post::LoadCaseSummary one, const LoadCaseState& now, std::size_t step);
  plate::Instant instant_of(const LoadCaseState& now, std::size_t step) const;
  void react(post::LoadCaseSummary& one, double number, const LoadCaseState& now);
  MembraneResult look_in_plane(const post::LoadCaseSummary& one, const LoadCaseState& known);
  LoadCaseState loaded(std::size_t which) const;
  InPlaneState loaded_in_plane(std::size_t which) const;
  InPlaneState solved_in_plane(std::size_t which, std::optional<plate::StaticSolver>& solver) const;
  void combine(const plate::Combination& combination, const std::vector<LoadCaseState>& cases);
  InPlaneState sum_in_plane(const plate::Combination& combination, const std::vector<LoadCaseState>& cases);
  std::vector<CombinedPart> parts_of(const post::LoadCaseSummary& combined, bool in_plane) const;
  std::vector<std::string> warnings() const;
  bool governs(const post::LoadCaseSummary& one);

  /// The state with the largest deflection, and its load in the plane.
  struct Deepest {
    double deflection = 0;
    plate::State state;
    plate::Forces in_plane = plate::no_state();
    plate::Heat heat = {};
  };
  Deepest deepest_;
  std::unique_ptr<const plate::StretchedPlate> stretched_;  // with large deflections
  std::unique_ptr<const plate::CoupledPlate> coupled_;      // together with its plane
  std::unique_ptr<const plate::ContactOfFaces> contact_;    // where faces of cracks may touch, without them
  std::vector<post::LoadCaseSummary> found_;
  double demand_ = -1;                                     // largest equivalent K so far, or von Mises stress
  std::vector<std::vector<post::Srif>> factors_in_plane_;  // of every one that is found; none without loads there
  std::vector<std::vector<std::string>> of_planes_;        // warnings of the same
  post::Table srifs_{post::srif_columns(), {}}, reactions_, edges_, corners_, faces_;
  std::vector<std::string> warnings_;
};

/// True where a load case asks more of the plate than all before it: by the equivalent K at the faces, in plates
/// without tips by the von Mises stress.
bool LoadCases::governs(const post::LoadCaseSummary& one) {
  double demand = 0;
  for (const auto& tip : one.faces) demand = std::max(demand, tip.equivalent.value_or(0));
  for (const auto& peak : one.extremes)
    if (one.faces.empty() && peak.quantity == "von_mises") demand = peak.value;
  const bool more = demand > demand_;
  demand_ = std::max(demand_, demand);
  return more;
}

/// The state of the next load case, with its energies.
plate::Instant LoadCases::instant_of(const LoadCaseState& now, std::size_t step) const {
  const auto number = double(found_.size() + 1);
  if (const auto& curved = now.curved)
    return {step, number, now.state, {}, 0, curved->external_work, curved->strain_energy()};
  if (const auto& both = now.coupled) {
    const double work = post::slow_work(plate_, now.load, now.state) +
                        post::slow_work(*ready_.membrane, now.in_plane->load, both->membrane) +
                        work_of_supports(plate_, *both, now.load, now.lift);
    return {step, number, now.state, {}, 0, work, both->strain_energy(), 0, -2 * work};
  }
  const auto& strained = now.what_strains();
  const double work = post::slow_work(plate_, now.load, now.state) +
                      plate::PrescribedDisplacements(plate_, now.load, now.lift).work(strained);
  return {step, number, now.state, {}, 0, work, plate_.strain_energy(strained), 0, -2 * work};
}

/// Evaluates and records a state in equilibrium under a load.
void LoadCases::look(post::LoadCaseSummary one, const LoadCaseState& known, std::size_t step) {
  const auto& [load, lift, state, heat, less, stretched, curved, coupled, touching] = known;
  const auto& strained = known.what_strains();
  const auto when = fmt::format("in {}", one.name);
  post::require_finite(state, when, plate_);
  if (const double w = state.row(0).cwiseAbs().maxCoeff();
      w > deepest_.deflection && !curved && !coupled && plate_.offers(plate::Feature::stretching))
    deepest_ = {w, state, stretched ? stretched->load : plate::no_state(), stretched ? stretched->heat : plate::Heat()};
  std::optional<MembraneResult> in_plane;
  if (stretched) in_plane = look_in_plane(one, known), one.membrane = in_plane->summary;
  auto now = instant_of(known, step);
  if (contact_) {  // it carries energy from the bending into the plane
    now.strain_energy += in_plane->summary.strain_energy, now.external_work += in_plane->summary.external_work;
    now.potential = -2 * now.external_work;
  }
  const double number = now.time, work = now.external_work, strain = now.strain_energy;
  const double across = plate::stored(plate_, heat, state),
               heated = across + (curved || coupled ? in_plane->stored : 0);
  one.strain_energy = strain + heated, one.external_work = work + heated;
  if (coupled)
    one.energy_parts = {{"bending", coupled->bending_energy + across}, {"stretching", one.membrane->strain_energy}};
  if (coupled && content().coupled()) one.energy_parts.emplace_back("coupling", coupled->coupling_energy);
  if (curved) one.membrane->external_work = one.external_work;
  post::Sample row{number, step, state, one.strain_energy, 0, one.external_work, 0};
  row.discrete_energy = strain + now.potential;
  if (in_plane) row.in_plane = &in_plane->fields.displacement;
  outputs_.row(row, plate_);
  react(one, number, known);
  if (content().srif)
    one.srif =
        fracture::of_all(plate_, post::srifs(plate_, *content().srif, ready_.tip_methods, strained, true, &heat));
  if (in_plane) post::add_membrane(one.srif, in_plane->factors, plate_.section());
  if (touching) post::close(one.srif, post::closed_tips(*touching, plate_), plate_.section());
  ready_.other_factors.widen_row(found_.size(), one.srif, plate_.section().thickness);
  if (one.superposed()) post::widen_errors(one.srif, parts_of(one, false), plate_.section().thickness);
  post::require_finite(one.srif, when);
  post::append(srifs_, number, one.srif);
  for (const auto& srif : one.srif)
    one.faces.push_back(post::at_faces(srif, plate_.section(), content().srif->toughness));
  post::Extremes extremes(plate_, content().output.stress_distance);
  extremes.row(now);
  post::Frame frame;
  if (outputs_.takes_frames() || in_plane) {
    frame = post::frame_of(plate_, number, step, strained, true, &heat);
    if (less.cols() > 0) frame.state = state.leftCols(frame.state.cols());
    if (in_plane) add_in_plane(frame, plate_, *ready_.membrane, *in_plane);
    extremes.frame(number, frame.resultants);
  }
  one.extremes = fracture::of_all(plate_, extremes.found(&heat));
  if (outputs_.takes_frames()) outputs_.frame(plate_, std::move(frame), {}, plate::no_state(), governs(one));
  found_.push_back(std::move(one));
  const bool rests = !found_.back().of.empty() && post::is_zero(state, plate_);  // a combination that cancels
  const bool stretches = stretched && stretched->acts;
  if (!rests && !stretches && !post::moves(state, work, plate_))
    post::require_motion(plate_, {plate::PrescribedDisplacements(plate_, load, lift).pull()}, state, work, warnings_);
  if (curved || only_stored(strain, heated)) return;  // the work of the first is that along the steps
  post::EnergyBalance(post::EnergyBalance::Plate::rests)
      .check({strain + post::energy_about(plate_, lift), strain, work}, when);
}

/// Adds the reactions to a load.
void LoadCases::react(post::LoadCaseSummary& one, double number, const LoadCaseState& now) {
  post::ReactionRows reactions;
  plate::Forces load = now.load;
  if (now.curved) load += now.curved->on_bending;
  if (now.coupled) load += now.coupled->on_bending;
  reactions.along_edges(content().output.edge_reactions);
  reactions.add(number, plate_, plate_, now.what_strains(), load);
  if (reactions.empty()) return;
  post::append(reactions_, reactions.table());
  post::append(edges_, reactions.edges()), post::append(corners_, reactions.corners());
  one.reactions = reactions.summary();
}

/// Evaluates a state in the plane, which is zero in a load case without loads there.
MembraneResult LoadCases::look_in_plane(const post::LoadCaseSummary& one, const LoadCaseState& known) {
  const auto& membrane = *ready_.membrane;
  const auto& now = *known.in_plane;
  const auto where = fmt::format("in the plane, {}", one.name);
  const MembraneFactorsWanted wanted{content().srif, ready_.membrane_methods};
  of_planes_.emplace_back();
  if (known.curved) {
    auto result = membrane_results(plate_, membrane, *known.curved, now.load, now.heat, wanted, where);
    of_planes_.back() = result.warnings;
    factors_in_plane_.push_back(result.factors);
    return result;
  }
  if (known.coupled) {
    auto result = membrane_results(plate_, membrane, *known.coupled, {known.load, now.load}, now.heat, wanted, where);
    if (one.superposed()) post::widen_errors(result.factors, parts_of(one, true), membrane.section().thickness);
    factors_in_plane_.push_back(result.factors);
    return result;
  }
  auto result = membrane_results(membrane, now.state, now.load, now.heat, wanted, where);
  if (one.superposed()) post::widen_errors(result.factors, parts_of(one, true), membrane.section().thickness);
  factors_in_plane_.push_back(result.factors);
  result.summary.residual = now.residual;
  of_planes_.back() = result.warnings;
  std::vector<std::string> warnings;
  if (const double work = result.summary.external_work - result.stored;
      now.acts && now.heat.none() && !post::moves(now.state, work, membrane))
    post::require_motion(membrane, {now.load}, now.state, work, warnings);
  for (const auto& text : warnings) warnings_.push_back(fmt::format("load case {}: in the plane, {}", one.name, text));
  if (!known.touching) require_balance(result, where);
  return result;
}

/// The load cases of a combination, with their factors of bending or in the plane.
std::vector<CombinedPart> LoadCases::parts_of(const post::LoadCaseSummary& combined, bool in_plane) const {
  std::vector<CombinedPart> parts;
  for (const auto& [name, factor] : combined.of) {
    const auto which = std::size_t(std::ranges::find(found_, name, &post::LoadCaseSummary::name) - found_.begin());
    parts.emplace_back(factor, in_plane ? &factors_in_plane_[which] : &found_[which].srif);
  }
  return parts;
}

/// Warnings of all load cases: of those that say the same of the same place, that of the first load case; none of tips
/// that it hardly loads.
std::vector<std::string> LoadCases::warnings() const {
  constexpr double close = 0.01;
  const double h = plate_.section().thickness;
  std::vector<double> largest(plate_.tips().size(), 0);             // factors
  std::map<std::size_t, std::pair<double, std::string>> governing;  // the largest utilisation of every tip, and where
  for (const auto& one : found_) {
    take(largest, one.srif, h);
    for (const auto& [tip, share] : utilisations(one))
      if (auto& most = governing[tip]; most.second.empty() || share > most.first) most = {share, one.name};
  }
  std::vector<std::pair<std::size_t, std::pair<double, std::string>>> tips(governing.begin(), governing.end());
  std::ranges::stable_sort(tips, std::greater(), [](const auto& one) { return one.second.first; });
  std::vector<std::string> result;
  for (const auto& [tip, most] : tips)  // what governs comes first
    post::tell_growth(tip, most.first, fmt::format(" in {}", most.second), result);
  std::set<std::string> warned;  // what about
  const auto tell = [&](const std::string& name, const std::vector<std::string>& said) {
    for (const auto& text : said) {
      if (warned.insert(text.substr(0, text.find_first_of("0123456789", text.find(": ")))).second)
        result.push_back(fmt::format("load case {}: {}", name, text));
    }
  };
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const auto& one = found_[i];
    std::vector<std::string> said;
    const auto loaded = of_loaded_tips(one.srif, largest, h);
    for (auto& text : post::warnings_about_factors(loaded, {}, h, plate_.remedy())) said.push_back(std::move(text));
    for (auto& text : post::sinking_supports(one.reactions, plate_.problem(), largest_deflection(one)))
      said.push_back(std::move(text));
    const auto soft = post::unbalanced_hubs(one.reactions, plate_.problem());
    std::ranges::copy(soft, std::back_inserter(said));
    if (one.reactions && soft.empty() && one.reactions->largest_residual > close)
      said.push_back(
          fmt::format("the reactions balance the loads to {:.2g} % only", 100 * one.reactions->largest_residual));
    tell(one.name, said);
    if (!ready_.membrane) continue;
    if (!one.contact) tell(one.name, warnings_about_overlaps(one.srif, may_touch(content(), plate_)));
    tell(one.name, of_planes_[i]);
  }
  return result;
}

/// Finds the equilibrium of a plate together with its plane.
void LoadCases::find_both(post::LoadCaseSummary& one, LoadCaseState& now) {
  const auto& analysis = content().analysis;
  auto& about = summary().analysis;
  auto found = coupled_->equilibrium({now.load, now.in_plane->load}, {analysis.tolerance, analysis.max_iterations, {}},
                                     now.lift);
  stopwatch().lap("solve");
  require_equilibrium(plate_, found.of_both, analysis.tolerance, one.name);
  one.iterations = found.of_both.iterations, one.residual = found.of_both.residual;
  about.iterations = about.iterations.value_or(0) + found.of_both.iterations;
  about.residual = std::max(about.residual.value_or(0), *one.residual);
  now.state = found.bending, now.strained = found.strained, now.in_plane->state = found.membrane;
  if (found.touching) record_contact(one, *found.touching), now.touching = found.touching;
  one.lifted = found.lifted;
  now.coupled = std::move(found);
}

/// Finds the equilibrium with large deflections, or of bending and stretching together, under the loads of a load case
/// or combination.
void LoadCases::find_equilibrium(post::LoadCaseSummary& one, LoadCaseState& now) {
  if (coupled_) return find_both(one, now);
  auto& summary = this->summary();
  auto& about = summary.analysis;
  const auto& plane = *now.in_plane;
  plate::PlateLoads loads{now.load, plane.load, plate::stiffness_of_heat(*ready_.membrane, plane.heat)};
  if (plate::heated(plate_.problem()))
    loads.stored = [&](double share, const plate::State& bending, const plate::State& in_plane) {
      return share * share *
             (plate::stored(plate_, now.heat, bending / share) +
              plate::stored(*ready_.membrane, plane.heat, in_plane / share));
    };
  auto found = stretched_->equilibrium(loads, {content().analysis.tolerance, {}});
  stopwatch().lap("solve");
  one.large_deflections = true;
  one.iterations = found.iterations, one.residual = found.steps.empty() ? 0 : found.steps.back().residual;
  about.iterations = about.iterations.value_or(0) + found.iterations;
  about.residual = std::max(about.residual.value_or(0), *one.residual), about.stop_reason = found.stop_reason;
  auto steps = load_steps(found.steps);
  steps.columns.emplace_back("case");
  summary.load_steps.columns = steps.columns;
  for (auto& row : steps.rows) row.emplace_back(one.name), summary.load_steps.rows.push_back(std::move(row));
  const double stored = plate::stored(*ready_.membrane, plane.heat, found.membrane);
  for (const auto& line : warnings_about(found, stored, content()))
    warnings_.push_back(fmt::format("{}: {}", one.name, line));
  if (!found.converged)
    throw plate::NumericalError(fmt::format("{}, large deflections: {}", one.name, found.stop_reason));
  now.state = found.bending, now.in_plane->state = found.membrane;
  if (content().faces_touch()) record_contact(one, found.touching), now.touching = found.touching;
  now.curved = std::move(found);
}

/// Takes what the summary and contact.csv say of contact.
void LoadCases::record_contact(post::LoadCaseSummary& one, const plate::TouchingFaces& found) {
  auto said = faces_found(found, plate_);
  one.contact = said.summary;
  faces_.columns = std::move(said.faces.columns), faces_.columns.emplace_back("case");
  for (auto& row : said.faces.rows) row.emplace_back(one.name), faces_.rows.push_back(std::move(row));
}

/// Adds to a state without contact what contact changes: states without it add up, those with it do not.
void LoadCases::touch(post::LoadCaseSummary& one, LoadCaseState& now) {
  if (!contact_) return;
  auto& in_plane = now.in_plane->state;
  auto found = (*contact_)({now.state, in_plane});
  now.state += found.bending, in_plane += found.membrane;
  if (now.strained.cols() > 0) now.strained += found.bending;
  record_contact(one, found);
  now.touching = std::move(found);
}

/// Solves every load case and combination by itself, as states with large deflections do not add up, and the factor of
/// bending and stretching together is there.
void LoadCases::solve_stretched() {
  const auto& problem = plate_.problem();
  auto& summary = this->summary();
  summary.analysis.tolerance = content().analysis.tolerance;
  post::Progress progress(quiet(), "load cases");
  const auto all = double(problem.load_cases.size() + problem.combinations.size());
  const auto tell_factor = [&](std::size_t bytes) {
    summary.scene.push_back({"factor", "", double(bytes) / double(plate_.cloud().plate_points), 0});
  };
  if (content().analysis.nonlinear) {
    summary.analysis.method = "newton";
    stretched_ = std::make_unique<plate::StretchedPlate>(plate_, *ready_.membrane);
  } else {
    summary.analysis.method = "direct", summary.analysis.stop_reason = "residual below tolerance";
    coupled_ = std::make_unique<plate::CoupledPlate>(plate_, *ready_.membrane);
    tell_factor(coupled_->factor_bytes());
  }
  std::vector<LoadCaseState> loads;
  for (std::size_t i = 0; i < problem.load_cases.size(); ++i) {
    post::LoadCaseSummary one{problem.load_cases[i].name};
    LoadCaseState now = loaded(i);
    now.state = plate::zero_state(plate_.points()), now.in_plane = loaded_in_plane(i);
    loads.push_back(now);
    find_equilibrium(one, now);
    if (i == 0 && stretched_) tell_factor(now.curved->factor_bytes);
    const auto iterations = one.iterations.value_or(0);
    look(std::move(one), now, iterations);
    stopwatch().lap("srif");
    progress.update(double(found_.size()) / all, problem.load_cases[i].name);
  }
  for (const auto& one : problem.combinations) {
    combine(one, loads);
    stopwatch().lap("srif");
    progress.update(double(found_.size()) / all, one.name);
  }
  progress.done();
  if (stretched_)
    summary.analysis.stop_reason =
        fmt::format("residual below tolerance in {} load steps", summary.load_steps.rows.size());
}

void LoadCases::solve() {
  if (content().analysis.nonlinear || plate::rests_with_plane(content())) return solve_stretched();
  auto& summary = this->summary();
  const auto& problem = plate_.problem();
  const auto& analysis = content().analysis;
  post::Progress progress(quiet(), "load cases");
  plate::StaticSolver solver(plate_, analysis.static_method(), analysis.preconditioner);
  std::optional<plate::StaticSolver> in_plane;
  if (ready_.membrane && plate::loaded_in_plane(problem))
    in_plane.emplace(*ready_.membrane, analysis.static_method(), analysis.preconditioner);
  if (content().faces_touch()) {
    contact_ = std::make_unique<plate::ContactOfFaces>(plate_, *ready_.membrane);
    const double bytes = double(contact_->bytes()) / double(plate_.cloud().plate_points);
    summary.scene.push_back({"factors of contact", "", bytes, 0});
  }
  std::vector<LoadCaseState> cases;
  plate::StaticSolution all;  // of the summary: the sum of iterations, the largest residual
  all.converged = true;
  for (std::size_t i = 0; i < problem.load_cases.size(); ++i) {
    const auto& name = problem.load_cases[i].name;
    LoadCaseState now = loaded(i);
    auto result = solver(now.load, {analysis.tolerance, analysis.max_iterations, {}}, i + 1 < problem.load_cases.size(),
                         now.lift);
    auto& solution = result.solution;
    stopwatch().lap("solve");
    all.iterations += solution.iterations, all.residual = std::max(all.residual, solution.residual);
    all.stop_reason = solution.stop_reason;
    summary.analysis.preconditioner = result.preconditioner;
    post::describe(summary.analysis, result.method, all, analysis.tolerance);
    if (i == 0 && result.factor_bytes > 0)
      summary.scene.push_back({"factor", "", double(result.factor_bytes) / double(plate_.cloud().plate_points), 0});
    if (!solution.converged)
      throw plate::NumericalError(fmt::format("{}, {}: {}, residual {:.2e} above tolerance {:.1e}", name, result.method,
                                              solution.stop_reason, solution.residual, analysis.tolerance));
    now.state = std::move(solution.state), now.strained = std::move(result.strained);
    if (ready_.membrane) now.in_plane = solved_in_plane(i, in_plane), stopwatch().lap("solve");
    if (!problem.combinations.empty()) cases.push_back(now);
    post::LoadCaseSummary one{name, {}, solution.iterations, solution.residual};
    one.lifted = result.lifted;
    touch(one, now);
    look(std::move(one), now, solution.iterations);
    stopwatch().lap("srif");
    progress.update(double(i + 1) / double(problem.load_cases.size()), name);
  }
  for (const auto& one : problem.combinations) {
    plate::stop_if_asked("combinations", plate_.constraints());
    combine(one, cases);
    stopwatch().lap("srif");
  }
  if (deepest_.deflection > 0)
    summary.linear_theory_off =
        linear_theory_off(plate_, deepest_.state, ready_.membrane.get(), deepest_.in_plane, deepest_.heat);
  stopwatch().lap("solve");
  progress.done();
}

LoadCaseState LoadCases::loaded(std::size_t which) const {
  LoadCaseState result{forces_of_case(plate_, which), plate::no_state(), {}, {}};
  for (const auto k : plate::loads_of(plate_.problem(), which)) {
    const auto& one = plate_.loads()[k];
    if (one.lifts()) result.lift = result.lift.cols() > 0 ? plate::State(result.lift + one.lift) : one.lift;
  }
  result.heat = plate::heat_of(plate_, shares_of(plate_.problem(), which));
  return result;
}

/// The plate at rest in its plane, with the loads of a load case.
InPlaneState LoadCases::loaded_in_plane(std::size_t which) const {
  const auto& problem = plate_.problem();
  InPlaneState result{forces_of_case(*ready_.membrane, which), plate::zero_state(ready_.membrane->points())};
  result.acts =
      std::ranges::any_of(plate::loads_of(problem, which), [&](std::size_t k) { return problem.loads[k].in_plane(); });
  result.heat = plate::heat_of(*ready_.membrane, shares_of(problem, which));
  return result;
}

/// Solves the plate in its plane under the loads of a load case; without any it rests.
InPlaneState LoadCases::solved_in_plane(std::size_t which, std::optional<plate::StaticSolver>& solver) const {
  const auto& membrane = *ready_.membrane;
  const auto& problem = plate_.problem();
  const auto& analysis = content().analysis;
  auto result = loaded_in_plane(which);
  if (!result.acts) return result;
  auto solution =
      (*solver)(result.load, {analysis.tolerance, analysis.max_iterations, {}}, which + 1 < problem.load_cases.size())
          .solution;
  require_equilibrium(membrane, solution, analysis.tolerance,
                      fmt::format("in the plane, {}", problem.load_cases[which].name));
  result.state = std::move(solution.state), result.residual = solution.residual;
  return result;
}

/// Sum of the states in the plane; at rest where its loads there cancel to rounding.
InPlaneState LoadCases::sum_in_plane(const plate::Combination& combination, const std::vector<LoadCaseState>& cases) {
  const auto& membrane = *ready_.membrane;
  const auto factors = plate::factors_of(combination, plate_.problem().load_cases);
  InPlaneState rest{plate::zero_forces(membrane.points()), plate::zero_state(membrane.points())};
  auto sum = rest;
  double largest = 0;  // of the parts
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const auto& part = *cases[i].in_plane;
    sum.state += factors[i] * part.state, sum.load += factors[i] * part.load;
    sum.acts = sum.acts || (factors[i] != 0 && part.acts);
    const double size = std::abs(factors[i]) * folded_norm(membrane, part.load, plate::no_state());
    largest = std::max(largest, size), sum.residual += size * part.residual;
  }
  sum.heat = plate::heat_of(membrane, shares_of(combination, membrane.problem()));
  const double size = folded_norm(membrane, sum.load, plate::no_state());
  if (size > 0) sum.residual /= size;
  if (largest == 0 || size > rounding * largest) return sum;
  warnings_.push_back(fmt::format("combination {}: its loads in the plane cancel", combination.name));
  rest.heat = sum.heat;  // which the loads may hold
  return rest;
}

/// `cases`: the load cases; with large deflections their loads alone, whose sum is solved. A combination whose loads
/// cancel to rounding is the plate at rest, with what heat stresses it.
void LoadCases::combine(const plate::Combination& combination, const std::vector<LoadCaseState>& cases) {
  const auto factors = plate::factors_of(combination, plate_.problem().load_cases);
  const auto zero = plate::zero_state(plate_.points());
  const plate::State of_supports = plate::has_prescribed_displacements(plate_) ? zero : plate::no_state();
  LoadCaseState sum{zero, of_supports, zero, {}, of_supports};
  double largest = 0, residual = 0;  // of the parts: load, and at most what is left of it
  for (std::size_t i = 0; i < factors.size(); ++i) {
    sum.state += factors[i] * cases[i].state, sum.load += factors[i] * cases[i].load;
    if (plate::has_prescribed_displacements(plate_)) sum.strained += factors[i] * cases[i].what_strains();
    if (cases[i].lift.cols() > 0) sum.lift += factors[i] * cases[i].lift;
    const double part = std::abs(factors[i]) * folded_norm(plate_, cases[i].load, cases[i].lift);
    largest = std::max(largest, part), residual += part * found_[i].residual.value_or(0);
  }
  const double size = folded_norm(plate_, sum.load, sum.lift);
  const bool cancels = size <= rounding * largest;
  std::optional<InPlaneState> in_plane;
  if (ready_.membrane) in_plane = sum_in_plane(combination, cases);
  if (cancels) {
    sum = {zero, plate::no_state(), zero, {}};
    if (!in_plane || !in_plane->acts)
      warnings_.push_back(fmt::format("combination {}: its loads cancel, the plate stays at rest", combination.name));
    else if (largest > 0 && !content().coupled())
      warnings_.push_back(fmt::format("combination {}: its loads along w cancel, it does not bend", combination.name));
  }
  sum.in_plane = std::move(in_plane);
  sum.heat = plate::heat_of(plate_, shares_of(combination, plate_.problem()));
  post::LoadCaseSummary one{combination.name, combination.of, {}, cancels ? 0 : residual / size};
  if (stretched_ || coupled_) find_equilibrium(one, sum);
  touch(one, sum);
  const auto iterations = one.iterations.value_or(0);
  look(std::move(one), sum, iterations);
}

void LoadCases::finish() {
  const auto& section = plate_.section();
  auto& recorder = outputs_.recorder();
  auto& summary = this->summary();
  summary.envelope =
      post::envelope(found_, section, content().srif ? content().srif->toughness : std::optional<double>());
  if (content().srif) {
    const auto crack = [&](std::size_t tip) { return plate_.tips()[tip].crack; };
    const auto named = [&](double number) { return found_.at(std::size_t(number) - 1).name; };
    const auto overlaps = ready_.membrane ? std::vector<post::FaceOverlaps>() : post::face_overlaps(srifs_);
    for (auto& line : post::warnings_about_faces(overlaps, section, crack, named, may_touch(content(), plate_)))
      warnings_.push_back(std::move(line));
    post::name_cases(srifs_, found_);
    recorder.table("srif", std::move(srifs_));
    recorder.table("envelope", post::envelope_table(summary.envelope));
  }
  outputs_.given_cracks(plate_);
  const auto record = [&](const char* name, post::Table& table) {
    if (table.rows.empty()) return;
    post::name_cases(table, found_);
    recorder.table(name, std::move(table));
  };
  record("reactions", reactions_), record("edge_reactions", edges_), record("corner_forces", corners_);
  if (!summary.load_steps.rows.empty()) recorder.table("load_steps", summary.load_steps);
  if (!faces_.rows.empty()) recorder.table("contact", std::move(faces_));
  const auto said = warnings();
  summary.load_cases = std::move(found_);
  post::conclude(summary, {.section = section,
                           .options = content().srif,
                           .si = content().si(),
                           .history = recorder.history(),
                           .reactions = {},
                           .factors = {},
                           .stretches = content().stretches,
                           .may_stretch = may_stretch(content())});
  if (content().srif) outputs_.warn(post::left_out(plate_.tips(), ready_.tip_methods, *content().srif));
  outputs_.warn(said);
  outputs_.warn(warnings_);
}

}  // namespace

std::unique_ptr<PlateAnalysis> load_cases(const ValidatedPlate& ready, Outputs& outputs) {
  return std::make_unique<LoadCases>(ready, outputs);
}

}  // namespace cases
