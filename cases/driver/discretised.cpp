#include "cases/driver/discretised.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/input/refused.hpp"
#include "fracture/growth/distrust.hpp"
#include "fracture/runs/shared/among_ranks.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/parts/held.hpp"
#include "plate/solve/suitability.hpp"
#include "post/factors/plate_factors.hpp"

namespace cases {
namespace {

/// Probes and places of impacts that have no points about them.
void check_places(const CaseFile& file, const plate::Formulation& plate, std::vector<Problem>& problems) {
  const auto check = [&](const std::string& key, const geometry::Point& x) {
    try {
      if (plate.here(x)) plate.interpolation(x);
    } catch (const plate::Refused& error) {
      problems.push_back({file.place(key), key, error.what()});
    }
  };
  for (const auto& [name, x] : file.content.output.probes) check("output.probes." + name, x);
  if (file.content.impact) check("impact.position", file.content.impact->position);
}

}  // namespace

void require_memory(const CaseFile& file) {
  unless_refused(file, [&] { plate::require_memory(file.content); });
}

void require_shared(const CaseFile& file, const std::vector<fracture::Unshared>& unshared) {
  std::vector<Problem> problems;
  for (const auto& [key, why] : unshared) problems.push_back({file.place(key), key, why});
  if (!problems.empty()) throw CaseError(problems);
}

plate::Discretised discretised(const CaseFile& file) {
  const Case& c = file.content;
  auto result = unless_refused(file, [&] { return plate::discretise(c); });
  const auto& plate = *result.plate;
  const auto suits = plate::suitability(plate, c.analysis);
  auto problems = problems_of(file, suits.refusals);
  check_places(file, plate, problems);
  if (!problems.empty()) throw CaseError(problems);
  auto& warnings = result.warnings;
  warnings.insert(warnings.begin(), file.source.notes.begin(), file.source.notes.end());
  for (const auto& some : {suits.warnings, plate.distrust(c.srif.has_value()),
                           plate::distrust_of_rotary_inertia(plate, c.analysis.rotary_inertia),
                           c.growth ? fracture::distrust_of_bonds(*c.growth, plate) : std::vector<std::string>(),
                           plate::distrust_of_mechanisms(plate)})
    warnings.insert(warnings.end(), some.begin(), some.end());
  if (c.analysis.kind == Analysis::Kind::frequencies)  // which have no stress
    std::erase_if(warnings, [](const std::string& line) { return line.starts_with("stress of bonds"); });
  return result;
}

void check_growing_tips(const CaseFile& file, const plate::Formulation& plate, std::vector<std::string>& warnings) {
  const Case& c = file.content;
  if (!c.growth || c.growth->by_bonds()) return;
  std::vector<Problem> problems;
  for (const auto& why : fracture::tips_without_rings(plate))
    if (c.analysis.kind == Analysis::Kind::dynamic)
      warnings.push_back(why + ": it stays where it is");
    else
      problems.push_back({file.place("growth"), "growth", why + "; refine"});
  if (!problems.empty()) throw CaseError(problems);
}

std::vector<post::TipMethods> tip_methods(const CaseFile& file, const plate::Formulation& plate) {
  if (!file.content.srif) return {};
  auto result = post::tip_methods(plate, *file.content.srif);
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto& x = plate.tips()[i].position;
    if (!result[i].works())
      problems.push_back({file.place("srif"), "srif",
                          fmt::format("tip at ({:g}, {:g}): {}", x.x(), x.y(), fmt::join(result[i].left_out(), "; "))});
  }
  if (!problems.empty() && problems.size() == result.size()) throw CaseError(problems);
  return result;
}

}  // namespace cases
