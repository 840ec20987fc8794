#include "plate/model/faults/heat_faults.hpp"

#include <fmt/format.h>

#include "plate/model/formulation_kind.hpp"
#include "plate/model/loading/load_cases.hpp"
#include "plate/model/loading/temperature.hpp"
#include "plate/model/problem.hpp"

namespace plate {

std::vector<KeyFault> faults_of_heat(const Problem& problem) {
  std::vector<KeyFault> found;
  if (!heated(problem)) return found;
  const auto say = [&](const std::string& key, const std::string& what) { found.push_back({key, what}); };
  if (problem.section.thermal_expansion == 0)
    say("section.thermal_expansion", "is missing, must be a number > 0: temperatures bend the plate by it");
  if (!problem.section.uniform())
    say("section", "temperatures are of plates of one material and one thickness all over");
  for (std::size_t i = 0; i < problem.loads.size() && !problem.section.isotropic(); ++i)
    if (problem.loads[i].kind == Load::Kind::temperature && problem.loads[i].formula.given())
      say(key_of_load(problem, i) + ".expression",
          "temperatures that vary over the plate are of an isotropic material: give a value");
  const auto& d = problem.discretization;
  const bool of_bonds = d.formulation && d.formulation->offers(Feature::horizon);
  if (of_bonds && d.boundary != EdgeMethod::images)
    say("discretization.boundary", "temperatures need \"images\": what stands beyond the edges has no temperature");
  if (of_bonds && d.surface_correction != SurfaceCorrection::position_aware)
    say("discretization.surface_correction",
        "temperatures need \"position_aware\", with which bonds bend freely without energy");
  for (std::size_t i = 0; i < problem.supports.size(); ++i)
    if (is_layer(problem.supports[i].kind))
      say(fmt::format("support[{}].kind", i),
          "a layer outside the plate has no temperature: choose \"clamped\", \"simply_supported\" or "
          "\"simply_supported_hard\"");
  return found;
}

}  // namespace plate
