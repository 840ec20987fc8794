#include "cases/input/validation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "cases/input/case_file.hpp"
#include "fracture/growth/growth.hpp"
#include "geometry/shape/crack_path.hpp"
#include "plate/formulations.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/wording.hpp"
#include "plate/solve/analysis.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/factors/srif.hpp"

namespace cases {

using plate::Analysis;

namespace {

using Refuse = std::function<void(const std::string& key, const std::string& what)>;

void check_impact(const plate::Problem& problem, const Refuse& refuse) {
  const auto& impact = problem.impact;
  if (!impact) return;
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

}  // namespace

std::vector<KeyError> errors_in_prestress(const plate::Problem& problem, const Analysis& analysis) {
  std::vector<KeyError> result;
  const bool buckles = analysis.kind == Analysis::Kind::buckling;
  if (!buckles && analysis.kind != Analysis::Kind::frequencies) return result;
  const auto bends = [](const plate::Load& load) {
    const auto* heat = load.as<plate::Temperature>();
    return !load.in_plane() || (heat && (heat->value != 0 || heat->formula.given()));
  };
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    if (bends(problem.loads[i]))
      result.push_back({key_of_load(problem, i) + ".kind",
                        fmt::format("bends the plate: {} those of a flat plate under loads in its plane, "
                                    "as \"edge_traction\"; remove it",
                                    buckles ? "buckling loads are" : "frequencies are")});
  return result;
}

std::vector<KeyError> errors_in_response(const plate::Problem& problem, const Analysis& analysis) {
  std::vector<KeyError> result;
  if (analysis.kind != Analysis::Kind::harmonic) return result;
  const auto refuse = [&](const std::string& key, const std::string& what) { result.push_back({key, what}); };
  if (const auto& kind = plate::formulation_of(problem.discretization); !kind.offers(plate::Feature::lanczos))
    refuse("analysis.kind", "\"harmonic\" given, which takes Lanczos vectors: " +
                                kind.lacks.at(plate::Feature::lanczos) + "; choose formulation = \"galerkin\"");
  return result;
}

std::vector<KeyError> errors_in_motion(const plate::Problem& problem, const Analysis& analysis, bool grows,
                                       const std::function<bool(const std::string&)>& given) {
  std::vector<KeyError> result;
  const auto refuse = [&](const std::string& key, const std::string& what) { result.push_back({key, what}); };
  if (analysis.kind != Analysis::Kind::dynamic) return result;
  check_impact(problem, refuse);
  if (analysis.start == Analysis::Start::equilibrium && problem.loads.empty())
    refuse("analysis.start", "\"equilibrium\" given, but nothing loads the plate: remove it");
  if (analysis.method != Analysis::Method::lanczos) {
    if (given("analysis.tolerance"))
      refuse("analysis.tolerance", "is of method = \"lanczos\"; steps have analysis.time_step: remove it");
    return result;
  }
  const auto report_error = [&](const char* key) {
    refuse(key, "is of method = \"central_difference\"; Lanczos vectors take no steps: remove it");
  };
  if (analysis.time_step) report_error("analysis.time_step");
  if (given("analysis.safety")) report_error("analysis.safety");
  if (const auto& kind = *problem.discretization.formulation; !kind.offers(plate::Feature::lanczos) && !grows)
    refuse("analysis.method", kind.lacks.at(plate::Feature::lanczos) + "; choose \"central_difference\"");
  return result;
}

std::vector<KeyError> errors_in_beginning(const plate::Problem& problem, const Analysis& analysis) {
  std::vector<KeyError> result;
  const bool moves = analysis.kind == Analysis::Kind::dynamic, rests = analysis.start == Analysis::Start::equilibrium;
  for (std::size_t i = 0; i < problem.loads.size() && moves && !rests; ++i)
    if (const auto& load = problem.loads[i]; load.as<plate::Settlement>() && plate::factor(load.history, 0) != 0)
      result.push_back({key_of_load(problem, i) + ".history",
                        "moves a support at once, which takes an energy without limit: let the history begin at 0, or "
                        "start in equilibrium"});
  return result;
}

std::vector<KeyError> errors_in_constant_loads(const plate::Problem& problem, const Analysis& analysis) {
  std::vector<KeyError> result;
  std::size_t constant = 0;
  for (std::size_t i = 0; i < problem.loads.size(); ++i) {
    if (problem.loads[i].history.kind != plate::History::Kind::constant) continue;
    const auto key = key_of_load(problem, i) + ".constant";
    if (!analysis.nonlinear)
      result.push_back({key, "is of large deflections, and linear loads add up: remove it, or set analysis.nonlinear"});
    else if (++constant == problem.loads.size())
      result.push_back({key, "all loads are constant, and none grows: remove it here"});
  }
  return result;
}

namespace {

std::vector<std::string> names_of(const std::vector<plate::LoadCase>& cases) {
  std::vector<std::string> names;
  for (const auto& one : cases) names.push_back(one.name);
  return names;
}

void check_names(const plate::Problem& problem, std::vector<KeyError>& errors) {
  std::map<std::string, std::string> seen;  // name, key
  const auto look = [&](const std::string& name, const std::string& key) {
    if (name.empty()) return;  // complained about where it is read
    const auto [first, is_new] = seen.emplace(name, key);
    if (!is_new)
      errors.push_back({key + ".name", fmt::format("\"{}\" is the name of {} already", name, first->second)});
  };
  for (std::size_t i = 0; i < problem.load_cases.size(); ++i)
    look(problem.load_cases[i].name, fmt::format("case[{}]", i));
  for (std::size_t i = 0; i < problem.combinations.size(); ++i)
    look(problem.combinations[i].name, fmt::format("combination[{}]", i));
}

void check_combination(const plate::Problem& problem, std::size_t i, std::vector<KeyError>& errors) {
  const auto& one = problem.combinations[i];
  const auto names = names_of(problem.load_cases);
  const auto key = fmt::format("combination[{}].of", i);
  if (one.of.empty()) errors.push_back({key, "names no load case: give { name = factor, ... }"});
  for (const auto& [name, factor] : one.of) {
    if (!names.empty() && std::ranges::find(names, name) == names.end())
      errors.push_back(
          {key + "." + name, fmt::format("\"{}\" is no load case{}", name, plate::did_you_mean(name, names))});
    if (!std::isfinite(factor)) errors.push_back({key + "." + name, "must be finite"});
  }
}

}  // namespace

std::vector<KeyError> errors_in_load_cases(const plate::Problem& problem) {
  std::vector<KeyError> errors;
  check_names(problem, errors);
  for (std::size_t i = 0; i < problem.load_cases.size(); ++i)
    if (plate::shared_loads(problem) == 0 && problem.load_cases[i].loads.empty())
      errors.push_back({fmt::format("case[{}]", i), "nothing loads the plate in it: give it a [[case.load]]"});
  for (std::size_t i = 0; i < problem.combinations.size(); ++i) check_combination(problem, i, errors);
  if (!problem.combinations.empty() && problem.load_cases.empty())
    errors.push_back({"combination", "there is no [[case]] that could be combined"});
  if (!problem.combinations.empty() && !problem.load_cases.empty() && plate::shared_loads(problem) > 0)
    errors.push_back({"combination",
                      "every load case has the loads of [[load]], and a sum of them would count these as often as its "
                      "factors say: give them to a [[case]] of their own"});
  const auto& kind = plate::formulation_of(problem.discretization);
  if ((!problem.load_cases.empty() || !problem.combinations.empty()) && !kind.offers(plate::Feature::symmetry))
    errors.push_back({"discretization.boundary", "load cases need a symmetric stiffness (" +
                                                     kind.lacks.at(plate::Feature::symmetry) +
                                                     "): choose \"images\", or run each load case by itself"});
  return errors;
}

std::vector<KeyError> errors_in_accuracy(const plate::Problem& problem, const Analysis& analysis,
                                         const std::optional<post::SrifOptions>& srif,
                                         const std::string& formulation_reason) {
  std::vector<KeyError> result;
  if (!srif || !srif->accuracy) return result;
  const auto report_error = [&](const std::string& what) { result.push_back({"srif.accuracy", what}); };
  if (const auto& kind = *problem.discretization.formulation; !kind.offers(plate::Feature::graded_points))
    report_error(kind.lacks.at(plate::Feature::graded_points) + " (formulation " + formulation_reason +
                 "): remove it or that");
  else if (analysis.kind == Analysis::Kind::dynamic && analysis.method != Analysis::Method::lanczos)
    report_error(
        "moves the plate by Lanczos vectors: remove what asks for steps (analysis.method, time_step, safety, "
        "cracks.contact, loads in the plane)");
  using enum post::SrifMethod;
  for (const auto method : {virtual_crack_extension, domain_integral, series_fit})
    if (std::ranges::find(srif->methods, method) == srif->methods.end())
      report_error(fmt::format("compares methods: add \"{}\" to srif.methods, or remove these", post::name_of(method)));
  return result;
}

namespace {

using IsGiven = std::function<bool(const std::string&)>;
using ReportError = std::function<void(const std::string& key, const std::string& what)>;

/// Checks keys that only growth by single bonds has, and keys that only growth by tips has.
void check_criterion(const fracture::Growth& growth, const IsGiven& given, const ReportError& report_error) {
  using enum fracture::Growth::Criterion;
  const bool limits = growth.criterion == curvature_shear && (growth.critical_curvature || growth.critical_shear);
  if (!given("growth.fracture_energy") && !limits)
    report_error("growth.fracture_energy", "is missing, must be a number > 0");
  if (growth.criterion != curvature_shear)
    for (const char* key : {"growth.critical_curvature", "growth.critical_shear"})
      if (given(key)) report_error(key, "is of criterion = \"curvature_shear\": remove it");
  if (!growth.by_bonds() && given("growth.apparent_toughness"))
    report_error("growth.apparent_toughness", "is of criteria for bonds: remove it");
  if (limits && !given("growth.fracture_energy") && given("growth.apparent_toughness"))
    report_error("growth.apparent_toughness",
                 "divides what follows from growth.fracture_energy, which is not given: remove it");
  if (growth.by_bonds())
    for (const char* key : {"growth.direction", "growth.increment"})
      if (given(key)) report_error(key, "is of criterion = \"energy_release\": bonds break where they fail; remove it");
}

/// Checks the keys of a growth that changes from rest to motion.
void check_switch(const fracture::Growth& growth, const IsGiven& given, const ReportError& report_error) {
  const bool moves = growth.unstable == fracture::Growth::Unstable::move;
  if (!moves) {
    if (given("growth.duration")) report_error("growth.duration", "is of unstable = \"move\": remove it");
    return;
  }
  if (!given("growth.duration")) report_error("growth.duration", "is missing, must be a number > 0");
  if (!given("section.density"))
    report_error("section.density", "is missing, must be a number > 0: the plate may begin to move");
}

/// Checks that the chosen method can solve the states between which bonds break one by one.
void check_analysis_of_growth(const Analysis& analysis, const fracture::Growth& growth,
                              const ReportError& report_error) {
  if (analysis.kind == Analysis::Kind::dynamic || !growth.by_bonds()) return;
  if (analysis.method != Analysis::Method::cg)
    report_error("analysis.method",
                 "breaking bonds takes a solution for each, by conjugate gradients with one factor; choose \"cg\"");
  if (analysis.preconditioner != plate::Preconditioning::automatic)
    report_error("analysis.preconditioner", "bonds that break in a static case have one of their own; choose \"auto\"");
}

void check_cracks(const plate::Problem& problem, const fracture::Growth& growth, const ReportError& report_error) {
  const auto paths = plate::crack_paths(problem);
  if (!growth.by_bonds() && geometry::tips(paths).empty())
    report_error("growth",
                 "there is no crack tip that could grow: give geometry.cracks, criterion = \"bond_energy\", or "
                 "remove [growth]");
  double longest = 0, all = 0;
  for (const auto& crack : problem.cracks)
    longest = std::max(longest, geometry::length(crack)), all += geometry::length(crack);
  const double there = growth.by_bonds() ? all : longest;
  if (growth.max_length && there >= *growth.max_length)
    report_error("growth.max_length", fmt::format("{} given, must be larger than the {:.6g} of geometry.cracks",
                                                  plate::number_text(*growth.max_length), there));
}

void check_factors(const fracture::Growth& growth, const std::optional<post::SrifOptions>& srif,
                   const ReportError& report_error) {
  const auto has = [&](post::SrifMethod method) {
    return std::ranges::find(srif->methods, method) != srif->methods.end();
  };
  if (srif && !growth.by_bonds() && !has(post::SrifMethod::virtual_crack_extension) &&
      !has(post::SrifMethod::domain_integral))
    report_error("srif.methods",
                 "growth needs an energy release rate: add \"virtual_crack_extension\" or \"domain_integral\"");
}

}  // namespace

std::vector<KeyError> errors_in_growth(const plate::Problem& problem, const plate::Analysis& analysis,
                                       const fracture::Growth& growth, const std::optional<post::SrifOptions>& srif,
                                       const std::function<bool(const std::string&)>& given) {
  std::vector<KeyError> result;
  const auto report_error = [&](const std::string& key, const std::string& what) { result.push_back({key, what}); };
  check_criterion(growth, given, report_error);
  check_analysis_of_growth(analysis, growth, report_error);
  if (analysis.kind == Analysis::Kind::static_) check_switch(growth, given, report_error);
  check_cracks(problem, growth, report_error);
  check_factors(growth, srif, report_error);
  return result;
}

namespace {

void check_tips(const plate::Problem& problem, std::vector<KeyError>& found) {
  const auto& section = problem.section;
  const bool factors = section.thickness_factor.given() || section.young_factor.given();
  const auto paths = plate::crack_paths(problem);
  for (const auto& tip : geometry::tips(paths)) {
    const auto& x = tip.position;
    if (factors) {
      found.push_back(
          {section.thickness_factor.given() ? "section.thickness_factor" : "section.young_factor",
           fmt::format("varies about the tip at ({:g}, {:g}): intensity factors are found where the section "
                       "is the same all over a ring about the tip; choose section.regions, or remove "
                       "[srif] and [growth]",
                       x.x(), x.y())});
      return;
    }
    const double spacing = problem.discretization.spacing_at_tips(), there = section.uniform_within(x);
    constexpr double least = 6;  // spacings: a ring of 4, and the families beside the change
    if (there < least * spacing)
      found.push_back({"section.regions",
                       fmt::format("the section changes {:.3g} from the tip at ({:g}, {:g}), which is nearer than {:g} "
                                   "spacings: no ring about it has one section; refine, or remove [srif] and [growth]",
                                   there, x.x(), x.y(), least)});
  }
}

}  // namespace

std::vector<KeyError> errors_in_section(const plate::Problem& problem) {
  std::vector<KeyError> found;
  const auto& section = problem.section;
  if (section.couples())
    found.push_back(
        {"srif",
         "factors of bending and tension are coupled at tips in plies that are not symmetric or have alpha1, "
         "alpha2, and are not found: make section.plies symmetric, or remove [srif]"});
  if (!section.simple() && !section.uniform()) check_tips(problem, found);
  return found;
}

}  // namespace cases
