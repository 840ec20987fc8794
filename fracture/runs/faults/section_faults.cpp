#include "fracture/runs/faults/section_faults.hpp"

#include <fmt/format.h>

#include "plate/model/problem.hpp"
#include "post/factors/plate_factors.hpp"

namespace fracture {
namespace {

void check_tips(const plate::Problem& problem, std::vector<KeyFault>& found) {
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
                       "[srif]",
                       x.x(), x.y())});
      return;
    }
    const double spacing = problem.discretization.spacing_at_tips(), there = section.uniform_within(x);
    constexpr double least = 6;  // spacings: a ring of 4, and the families beside the change
    if (there < least * spacing)
      found.push_back({"section.regions",
                       fmt::format("the section changes {:.3g} from the tip at ({:g}, {:g}), which is nearer than {:g} "
                                   "spacings: no ring about it has one section; refine, or remove [srif]",
                                   there, x.x(), x.y(), least)});
  }
}

}  // namespace

std::vector<KeyFault> faults_of_section(const plate::Problem& problem, bool grows,
                                        const std::optional<post::SrifOptions>& srif) {
  std::vector<KeyFault> found;
  const auto& section = problem.section;
  if (section.simple()) return found;
  if (grows)
    found.push_back({"growth",
                     "cracks grow in one isotropic section: fracture energies and directions of others are "
                     "not known here; remove it"});
  if (!srif) return found;
  if (srif->accuracy)
    found.push_back({"srif.accuracy", "is of one isotropic section: the estimates that it goes by are measured there"});
  if (srif->toughness && !section.isotropic())
    found.push_back({"srif.toughness", "is one number of isotropic materials: remove it"});
  if (!section.uniform()) check_tips(problem, found);
  return found;
}

}  // namespace fracture
