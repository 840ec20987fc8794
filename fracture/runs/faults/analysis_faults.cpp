#include "fracture/runs/faults/analysis_faults.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plate/formulations.hpp"
#include "plate/model/formulation_kind.hpp"
#include "plate/model/history.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/wording.hpp"
#include "plate/solve/analysis.hpp"
#include "post/factors/srif.hpp"

namespace fracture {

using plate::Analysis;

namespace {

using Refuse = std::function<void(const std::string& key, const std::string& what)>;

void check_impact(const plate::Problem& problem, const Analysis& analysis, const Refuse& refuse) {
  const auto& impact = problem.impact;
  if (!impact) return;
  if (analysis.method == Analysis::Method::lanczos)
    refuse("analysis.method",
           "\"lanczos\" moves linear plates, and a mass that lifts off is none; choose \"central_difference\"");
  if (impact->velocity == 0) refuse("impact.velocity", "0 given: the mass would stay where it is");
  const auto given = plate::text_of(impact->position) + " given, ";
  if (!geometry::contains(problem.outline, impact->position))
    refuse("impact.position", given + "must lie inside the plate");
  const double near = problem.discretization.spacing_at_tips() / 2;
  for (std::size_t i = 0; i < problem.cracks.size(); ++i)
    if (geometry::distance(problem.cracks[i], impact->position) < near)
      refuse("impact.position", fmt::format("{}lies on crack {}, or within half a spacing of it: move it to the face "
                                            "that it hits",
                                            given, i));
}

/// What begins or damps a motion beside its loads.
void check_beside(const plate::Problem& problem, const Analysis& analysis, bool grows, const Refuse& refuse) {
  const bool mixed = analysis.precision == Analysis::Precision::mixed;
  const bool settles =
      std::ranges::any_of(problem.loads, [](const auto& load) { return load.kind == plate::Load::Kind::settlement; });
  const auto alone = [&](bool given, const std::string& key) {
    if (given && mixed) refuse("analysis.precision", "\"mixed\" given: " + key + " needs \"double\"");
    if (given && settles) refuse(key, "is not available beside supports that settle: remove it or the settlement");
  };
  alone(analysis.damping.has_value(), "analysis.damping");
  alone(problem.initial.has_value(), "initial");
  alone(problem.impact.has_value(), "impact");
  if (problem.lifts_off() && analysis.damping && analysis.damping->stiffness > 0)
    refuse("analysis.damping",
           "the stiffness of a plate on soil that lifts off changes, and cannot damp: give mass alone");
  if (grows && analysis.damping && analysis.damping->stiffness > 0)
    refuse("analysis.damping", "the stiffness of a plate whose cracks grow changes, and cannot damp: give mass alone");
  if (analysis.start != Analysis::Start::equilibrium) return;
  if (problem.initial && problem.initial->deflection.given())
    refuse("initial.deflection", "is given beside start = \"equilibrium\", which is another deflection: remove one");
  if (problem.loads.empty()) refuse("analysis.start", "\"equilibrium\" given, but nothing loads the plate: remove it");
}

}  // namespace

std::vector<KeyFault> faults_of_response(const plate::Problem& problem, const Analysis& analysis) {
  std::vector<KeyFault> result;
  if (analysis.kind != Analysis::Kind::harmonic) return result;
  const auto refuse = [&](const std::string& key, const std::string& what) { result.push_back({key, what}); };
  if (const auto& kind = plate::formulation_of(problem.discretization); !kind.offers(plate::Feature::lanczos))
    refuse("analysis.kind", "\"harmonic\" given, which takes Lanczos vectors: " +
                                kind.lacks.at(plate::Feature::lanczos) + "; choose formulation = \"galerkin\"");
  if (problem.lifts_off())
    refuse("foundation", "soil that lifts off has no harmonic response, as it is not linear: remove lifts_off");
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    if (problem.loads[i].kind == plate::Load::Kind::settlement)
      refuse(plate::key_of_load(problem, i) + ".kind",
             "\"settlement\" given: supports that swing are of analysis.kind = \"dynamic\"");
  return result;
}

std::vector<KeyFault> faults_of_motion(const plate::Problem& problem, const Analysis& analysis, bool grows,
                                       const std::function<bool(const std::string&)>& given) {
  std::vector<KeyFault> result;
  const auto refuse = [&](const std::string& key, const std::string& what) { result.push_back({key, what}); };
  if (analysis.kind != Analysis::Kind::dynamic) return result;
  check_beside(problem, analysis, grows, refuse);
  check_impact(problem, analysis, refuse);
  if (analysis.method != Analysis::Method::lanczos) {
    if (given("analysis.tolerance"))
      refuse("analysis.tolerance", "is of method = \"lanczos\"; steps have analysis.time_step: remove it");
    return result;
  }
  const auto complain = [&](const char* key) {
    refuse(key, "is of method = \"central_difference\"; Lanczos vectors take no steps: remove it");
  };
  if (analysis.time_step) complain("analysis.time_step");
  if (given("analysis.safety")) complain("analysis.safety");
  if (analysis.precision == Analysis::Precision::mixed)
    refuse("analysis.precision", "\"mixed\" is of method = \"central_difference\"; choose \"double\"");
  if (const auto& kind = *problem.discretization.formulation; !kind.offers(plate::Feature::lanczos) && !grows)
    refuse("analysis.method", kind.lacks.at(plate::Feature::lanczos) + "; choose \"central_difference\"");
  if (grows)
    refuse("analysis.method", "\"lanczos\" given: growth in motion takes steps; choose \"central_difference\"");
  return result;
}

std::vector<KeyFault> faults_beside_settlements(const plate::Problem& problem, const Analysis& analysis) {
  std::vector<KeyFault> result;
  const bool moves = analysis.kind == Analysis::Kind::dynamic;
  for (std::size_t i = 0; i < problem.loads.size(); ++i) {
    const auto& load = problem.loads[i];
    if (load.kind != plate::Load::Kind::settlement) continue;
    const auto key = plate::key_of_load(problem, i);
    if (moves && analysis.method == Analysis::Method::lanczos)
      result.push_back({key + ".kind",
                        "\"settlement\" given: supports move by steps alone; choose analysis.method = "
                        "\"central_difference\""});
    if (moves && analysis.start != Analysis::Start::equilibrium && plate::factor(load.history, 0) != 0)
      result.push_back({key + ".history",
                        "moves a support at once, which takes an energy without limit: let the history begin at 0, or "
                        "start in equilibrium"});
  }
  return result;
}

std::vector<KeyFault> faults_beside_contact(const plate::Problem& problem, const Analysis& analysis, bool grows) {
  std::vector<KeyFault> result;
  const auto refuse = [&](bool asked, const std::string& key, const std::string& why) {
    if (asked) result.push_back({key, why});
  };
  const bool lanczos = analysis.kind == Analysis::Kind::dynamic && analysis.method == Analysis::Method::lanczos;
  const bool lifts = problem.lifts_off();
  bool settles = false, moves = false;
  for (const auto& load : problem.loads) {
    settles = settles || load.kind == plate::Load::Kind::settlement;
    moves = moves || load.moves();
  }
  refuse(lanczos && (moves || lifts), "analysis.method",
         std::string("\"lanczos\" given: ") + (moves ? "loads that move" : "soil that lifts off") +
             " need steps; choose \"central_difference\"");
  const bool pushes = std::ranges::any_of(
      problem.loads, [](const auto& load) { return load.moves() && plate::factor(load.history, 0) != 0; });
  refuse(
      pushes && analysis.start == Analysis::Start::equilibrium, "analysis.start",
      "\"equilibrium\" given, which a load that moves is no part of: let its history begin at 0, or begin undeformed");
  refuse(moves && settles, "load",
         "loads that move cannot be run yet beside settlements: give them to cases of their own");
  const std::string whole = ": remove lifts_off";
  refuse(lifts && analysis.kind == Analysis::Kind::frequencies, "foundation",
         "a plate that may lift off has no frequencies" + whole);
  refuse(lifts && grows, "foundation", "cracks do not grow yet on soil that lifts off" + whole);
  refuse(lifts && settles, "foundation", "settlements cannot be run yet beside soil that lifts off" + whole);
  refuse(lifts && !problem.combinations.empty(), "combination",
         "what soil touches differs from load case to load case, so that they do not add up: give their sum a [[case]] "
         "of its own");
  return result;
}

std::vector<KeyFault> faults_beside_load_cases(const plate::Problem& problem, const plate::Analysis& analysis,
                                               bool grows, const std::optional<post::SrifOptions>& srif) {
  std::vector<KeyFault> result;
  if (problem.load_cases.empty() && problem.combinations.empty()) return result;
  const auto refuse = [&](bool asked, const std::string& key, const std::string& why) {
    if (asked) result.push_back({key, why});
  };
  const std::string several = "is of one load on the plate, and [[case]] gives several: ";
  refuse(analysis.kind != plate::Analysis::Kind::static_, "case",
         "load cases are equilibria, which add up: they need analysis.kind = \"static\"; loads in time are [[load]] "
         "with a history");
  refuse(grows, "growth",
         "cracks that grow make another plate of it under every load, so that load cases neither share it nor add up: "
         "remove it, or run each load case by itself");
  refuse(srif && srif->accuracy, "srif.accuracy", several + "run each load case by itself, or state the spacing");
  refuse(srif && srif->richardson, "srif.richardson", several + "run each load case by itself");
  refuse(srif && srif->second_formulation, "srif.second_formulation", several + "run each load case by itself");
  const auto& kind = plate::formulation_of(problem.discretization);
  refuse(!kind.offers(plate::Feature::symmetry), "discretization.boundary",
         "load cases need a symmetric stiffness (" +
             (kind.offers(plate::Feature::symmetry) ? std::string() : kind.lacks.at(plate::Feature::symmetry)) +
             "): choose \"images\", or run each load case by itself");
  return result;
}

std::vector<KeyFault> faults_of_accuracy(const plate::Problem& problem, const Analysis& analysis, bool grows,
                                         const std::optional<post::SrifOptions>& srif,
                                         const std::string& formulation_reason) {
  std::vector<KeyFault> result;
  if (!srif || !srif->accuracy) return result;
  const auto complain = [&](const std::string& what) { result.push_back({"srif.accuracy", what}); };
  if (const auto& kind = *problem.discretization.formulation; !kind.offers(plate::Feature::graded_points))
    complain(kind.lacks.at(plate::Feature::graded_points) + " (formulation " + formulation_reason +
             "): remove it or that");
  else if (analysis.kind == Analysis::Kind::dynamic && analysis.method != Analysis::Method::lanczos)
    complain("moves the plate by Lanczos vectors: remove what asks for steps (analysis.method, time_step, safety)");
  if (grows) complain("is not available with [growth]");
  if (srif->richardson || srif->second_formulation)
    complain("has estimates of its own: remove srif.richardson and srif.second_formulation");
  for (const char* method : {"virtual_crack_extension", "domain_integral", "series_fit"})
    if (std::ranges::find(srif->methods, method) == srif->methods.end())
      complain(fmt::format("compares methods: add \"{}\" to srif.methods, or remove these", method));
  return result;
}

}  // namespace fracture
