#include "fracture/runs/faults/growth_faults.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fracture/growth/criteria.hpp"
#include "geometry/shape/crack_extension.hpp"
#include "plate/model/loading/temperature.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/wording.hpp"
#include "plate/solve/analysis.hpp"
#include "post/factors/srif.hpp"

namespace fracture {
namespace {

using plate::Analysis;
using Asked = std::function<bool(const std::string&)>;
using Complain = std::function<void(const std::string& key, const std::string& what)>;

/// What growth by single bonds has and that by tips has not, and the other way round.
void check_criterion(const Growth& growth, const Asked& given, const Complain& complain) {
  using enum Growth::Criterion;
  const bool limits = growth.criterion == curvature_shear && (growth.critical_curvature || growth.critical_shear);
  if (!given("growth.fracture_energy") && !limits)
    complain("growth.fracture_energy", "is missing, must be a number > 0");
  if (growth.criterion != curvature_shear)
    for (const char* key : {"growth.critical_curvature", "growth.critical_shear"})
      if (given(key)) complain(key, "is of criterion = \"curvature_shear\": remove it");
  if (!growth.by_bonds() && given("growth.apparent_toughness"))
    complain("growth.apparent_toughness", "is of criteria for bonds: remove it");
  if (limits && !given("growth.fracture_energy") && given("growth.apparent_toughness"))
    complain("growth.apparent_toughness",
             "divides what follows from growth.fracture_energy, which is not given: remove it");
  if (growth.by_bonds())
    for (const char* key : {"growth.direction", "growth.increment"})
      if (given(key)) complain(key, "is of criterion = \"energy_release\": bonds break where they fail; remove it");
}

/// From rest to motion.
void check_switch(const Growth& growth, const Asked& given, const Complain& complain) {
  const bool moves = growth.unstable == Growth::Unstable::move;
  if (!moves) {
    if (given("growth.duration")) complain("growth.duration", "is of unstable = \"move\": remove it");
    return;
  }
  if (!given("growth.duration")) complain("growth.duration", "is missing, must be a number > 0");
  if (!given("section.density"))
    complain("section.density", "is missing, must be a number > 0: the plate may begin to move");
  if (growth.by_bonds())
    complain("growth.unstable",
             "\"move\" given: cracks of broken bonds cannot be handed over to a motion; choose \"stop\" or \"jump\"");
  if (growth.control != Growth::Control::load)
    complain("growth.control", "must be \"load\" with unstable = \"move\": the loads stay while the plate moves");
}

/// How the states between which bonds break one by one, or tips run, may be found.
void check_analysis(const Analysis& analysis, const Growth& growth, const Complain& complain) {
  const bool moves = analysis.kind == Analysis::Kind::dynamic;
  if (!moves && !growth.by_bonds()) return;
  if (analysis.precision == Analysis::Precision::mixed)
    complain("analysis.precision", "growth is in double precision only; choose \"double\"");
  if (moves) return;
  if (analysis.method != Analysis::Method::cg)
    complain("analysis.method",
             "breaking bonds takes a solution for each, by conjugate gradients with one factor; choose \"cg\"");
  if (analysis.preconditioner != plate::Preconditioning::automatic)
    complain("analysis.preconditioner", "bonds that break in a static case have one of their own; choose \"auto\"");
}

void check_cracks(const plate::Problem& problem, const Growth& growth, const Complain& complain) {
  const auto paths = plate::crack_paths(problem);
  if (!growth.by_bonds() && geometry::tips(paths).empty())
    complain("growth",
             "there is no crack tip that could grow: give geometry.cracks, criterion = \"bond_energy\", or "
             "remove [growth]");
  double longest = 0, all = 0;
  for (const auto& crack : problem.cracks)
    longest = std::max(longest, geometry::length(crack)), all += geometry::length(crack);
  const double there = growth.by_bonds() ? all : longest;
  if (growth.max_length && there >= *growth.max_length)
    complain("growth.max_length", fmt::format("{} given, must be larger than the {:.6g} of geometry.cracks",
                                              plate::number_text(*growth.max_length), there));
}

void check_factors(const Growth& growth, const std::optional<post::SrifOptions>& srif, const Complain& complain) {
  const auto has = [&](const char* method) { return std::ranges::find(srif->methods, method) != srif->methods.end(); };
  if (srif && !growth.by_bonds() && !has("virtual_crack_extension") && !has("domain_integral"))
    complain("srif.methods",
             "growth needs an energy release rate: add \"virtual_crack_extension\" or \"domain_integral\"");
  if (srif && srif->second_formulation)
    complain("srif.second_formulation", "is not available with [growth]: run both cases and compare their growth.csv");
  if (srif && srif->richardson)
    complain("srif.richardson", "is not available with [growth]: run the case with twice the spacing");
}

/// Bonds over a horizon are judged by the energy of their curvature, in which heat has no part.
void check_heat(const plate::Problem& problem, const Analysis& analysis, const Growth& growth,
                const Complain& complain) {
  if (!plate::heated(problem)) return;
  if (growth.by_bonds())
    complain("growth.criterion", "bonds that break one by one know no temperature: choose \"energy_release\"");
  else if (analysis.kind == Analysis::Kind::dynamic || growth.unstable == Growth::Unstable::move)
    complain("growth",
             "cracks that grow in motion know no temperature: let them grow at rest, with unstable = \"stop\" "
             "or \"jump\"");
}

/// What moves supports is given, so that neither a load nor what it moves can follow the crack; a struck piece flies
/// off.
void check_beside(const plate::Problem& problem, const Analysis& analysis, const Growth& growth,
                  const Complain& complain) {
  const bool settles =
      std::ranges::any_of(problem.loads, [](const auto& load) { return load.kind == plate::Load::Kind::settlement; });
  if (settles && growth.by_bonds() && analysis.kind == Analysis::Kind::static_)
    complain("growth.criterion",
             "bonds that break one by one at rest know no supports that move: choose \"energy_release\"");
  if (settles && growth.control != Growth::Control::load)
    complain("growth.control", "must be \"load\" beside settlements, which say how far supports move");
  if (settles && growth.unstable == Growth::Unstable::move)
    complain("growth.unstable", "\"move\" is not available beside settlements: choose \"stop\" or \"jump\"");
  if (problem.impact && growth.fallen == Growth::Fallen::freeze)
    complain("growth.fallen",
             "\"freeze\" would hold a piece that the mass of [impact] has struck out: choose \"move\"");
}

}  // namespace

std::vector<KeyFault> faults_of_growth(const plate::Problem& problem, const plate::Analysis& analysis,
                                       const Growth& growth, const std::optional<post::SrifOptions>& srif,
                                       const std::function<bool(const std::string&)>& given) {
  std::vector<KeyFault> result;
  const auto complain = [&](const std::string& key, const std::string& what) { result.push_back({key, what}); };
  check_criterion(growth, given, complain);
  check_analysis(analysis, growth, complain);
  if (analysis.kind == Analysis::Kind::static_) check_switch(growth, given, complain);
  check_cracks(problem, growth, complain);
  check_factors(growth, srif, complain);
  check_heat(problem, analysis, growth, complain);
  check_beside(problem, analysis, growth, complain);
  return result;
}

}  // namespace fracture
