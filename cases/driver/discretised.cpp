#include "cases/driver/discretised.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fracture/growth/distrust.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/parts/held.hpp"
#include "plate/formulation/parts/pieces.hpp"
#include "plate/model/problem.hpp"
#include "post/factors/plate_factors.hpp"

namespace cases {
namespace {

/// The key that a refusal is about.
std::string key_of(const plate::Refusal& refusal) {
  using enum plate::Subject;
  switch (refusal.subject) {
    case geometry:
      return "geometry";
    case cracks:
      return "geometry.cracks";
    case spacing:
      return "discretization.spacing";
    case volume_correction:
      return "discretization.volume_correction";
    case support:
      return "support";
    case support_points:
      return fmt::format("support[{}].points", refusal.number);
    case support_edges:
      return fmt::format("support[{}].edges", refusal.number);
    case load_position:
      return fmt::format("load[{}].position", refusal.number);
    case load_edges:
      return fmt::format("load[{}].edges", refusal.number);
  }
  return "";
}

void refuse(const CaseFile& file, const std::vector<plate::Refusal>& reasons, std::vector<Problem>& problems) {
  for (const auto& one : reasons) problems.push_back({file.place(key_of(one)), key_of(one), one.what});
}

/// In motion a plate may move as it is; that pieces do is worth a word.
void check_held(const CaseFile& file, const plate::Formulation& plate, std::vector<std::string>& warnings,
                std::vector<Problem>& problems) {
  const auto found = plate::loose(plate);
  if (found.empty()) return;
  if (file.content.analysis.finds_equilibrium()) return refuse(file, found, problems);
  if (plate.pieces().size() > 1 && !plate.held())
    for (const auto& one : found) warnings.push_back(one.what);
}

void check_two_level(const CaseFile& file, const plate::Formulation& plate, std::vector<Problem>& problems) {
  if (plate.may_move() && file.content.analysis.preconditioner == plate::Preconditioning::two_level)
    problems.push_back({file.place("analysis.preconditioner"), "analysis.preconditioner",
                        "\"two_level\" needs a plate without motions that nothing resists, and parts of this one hang "
                        "by bonds along one line; choose \"diagonal\""});
}

void check_modes(const CaseFile& file, const plate::Formulation& plate, std::vector<Problem>& problems) {
  if (file.content.analysis.kind != Analysis::Kind::frequencies) return;
  const auto most = std::size_t((plate.mass().array() > 0).count()) / 4;
  if (file.content.analysis.modes > most)
    problems.push_back({file.place("analysis.modes"), "analysis.modes",
                        fmt::format("{} given, must be at most {}, a quarter of the plate's degrees of freedom",
                                    file.content.analysis.modes, most)});
}

/// Pins alone hold a plate by their triangle; each acts up to 0.7 of a spacing beside its place.
void check_pins(const CaseFile& file, const plate::Formulation& plate, std::vector<std::string>& warnings,
                std::vector<Problem>& problems) {
  constexpr double least = 1, few = 5;  // spacings
  const auto wide = plate.width_of_pins();
  if (!wide || file.content.analysis.kind != Analysis::Kind::static_) return;
  const auto said = fmt::format(
      "the pins are within {:.2g} spacings of one line, and each acts at the nearest point of the lattice, up "
      "to 0.7 spacings from its place",
      *wide);
  if (*wide < least)
    problems.push_back({file.place("support"), "support", said + ": refine, or choose formulation = \"galerkin\""});
  else if (*wide < few)
    warnings.push_back(said + ": deflections may be far off");
}

/// Probes that have no points about them.
void check_probes(const CaseFile& file, const plate::Formulation& plate, std::vector<Problem>& problems) {
  for (const auto& [name, x] : file.content.output.probes) try {
      plate.interpolation(x);
    } catch (const plate::Refused& error) {
      problems.push_back({file.place("output.probes." + name), "output.probes." + name, error.what()});
    }
}

}  // namespace

void require_memory(const CaseFile& file) {
  try {
    plate::require_memory(file.content);
  } catch (const plate::Refused& error) {
    std::vector<Problem> problems;
    refuse(file, error.reasons(), problems);
    throw CaseError(problems);
  }
}

plate::Discretised discretised(const CaseFile& file) {
  const Case& c = file.content;
  plate::Discretised result;
  std::vector<Problem> problems;
  try {
    result = plate::discretise(c);
  } catch (const plate::Refused& error) {
    refuse(file, error.reasons(), problems);
    throw CaseError(problems);
  }
  auto& warnings = result.warnings;
  warnings.insert(warnings.begin(), file.notes.begin(), file.notes.end());
  const auto& plate = *result.plate;
  check_modes(file, plate, problems);
  check_pins(file, plate, warnings, problems);
  check_held(file, plate, warnings, problems);
  check_two_level(file, plate, problems);
  check_probes(file, plate, problems);
  if (!problems.empty()) throw CaseError(problems);
  for (auto& some :
       {plate.distrust(c.srif.has_value()), plate::distrust_of_rotary_inertia(plate, c.analysis.rotary_inertia),
        c.growth ? fracture::distrust_of_bonds(*c.growth, plate) : std::vector<std::string>(),
        plate::distrust_of_mechanisms(plate, c.analysis.finds_equilibrium())})
    warnings.insert(warnings.end(), some.begin(), some.end());
  return result;
}

void check_growing_tips(const CaseFile& file, const plate::Formulation& plate, std::vector<std::string>& warnings) {
  const Case& c = file.content;
  if (!c.growth || c.growth->by_bonds()) return;
  const double spacing = c.discretization.spacing_at_tips();
  std::vector<Problem> problems;
  for (const auto& tip : plate.tips()) {
    const double clear = post::clear_distance(c, plate.paths(), tip);
    if (post::ringed(c, plate.paths(), tip)) continue;
    const auto why = fmt::format(
        "tip at ({:g}, {:g}): an edge, a load, a pin, another crack or an end of its own leaves {:.3g} "
        "about it, {:.3g} spacings, too little for the energy release rate that growth needs",
        tip.position.x(), tip.position.y(), clear, clear / spacing);
    if (c.analysis.kind == Analysis::Kind::dynamic)
      warnings.push_back(why + ": it stays where it is");
    else
      problems.push_back({file.place("growth"), "growth", why + "; refine"});
  }
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
