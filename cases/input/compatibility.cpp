#include "cases/input/compatibility.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "cases/input/case_file.hpp"
#include "plate/formulations.hpp"
#include "plate/model/membrane.hpp"

namespace cases {
namespace {

using enum Part;

constexpr auto words = std::to_array<std::pair<Part, std::string_view>>({
    {motion, "`analysis.kind = \"dynamic\"`"},
    {frequencies, "`analysis.kind = \"frequencies\"`"},
    {harmonic, "`analysis.kind = \"harmonic\"`"},
    {lanczos, "motion by `analysis.method = \"lanczos\"`"},
    {single_precision, "`analysis.precision = \"mixed\"`"},
    {equilibrium_start, "`analysis.start = \"equilibrium\"`"},
    {initial_deflection, "`initial.deflection`"},
    {impact, "`[impact]`"},
    {stiffness_damping, "`analysis.damping.stiffness` of a motion"},
    {settlement, "a load of kind `\"settlement\"`"},
    {moving_load, "a load that moves (`path`, `speed`)"},
    {load_in_plane, "a load in the plane (`edge_traction`, `body_force`, `vector`, `mean`)"},
    {growth_in_plane, "`[growth]` under loads in the plane"},
    {large_deflections, "`analysis.nonlinear`"},
    {large_deflections_in_motion, "`analysis.nonlinear` of a motion"},
    {arc_length, "`analysis.control = \"arc_length\"`"},
    {constant_load, "`load.constant`"},
    {touching_faces, "`cracks.contact`"},
    {touching_bonds, "`cracks.contact` with bonds"},
    {touching_in_motion, "`cracks.contact` of a motion"},
    {buckling, "`analysis.kind = \"buckling\"`"},
    {unilateral_foundation, "soil that lifts off (`lifts_off`)"},
    {pushing_supports, "supports that only push (`pushes`)"},
    {temperature, "a load of kind `\"temperature\"`"},
    {mean_temperature, "`mean` of a load of kind `\"temperature\"`, or one of plies that are not symmetric"},
    {load_cases, "`[[case]]`"},
    {combinations, "`[[combination]]`"},
    {springs_on_cracks, "`spring.cracks`"},
    {springs_in_plane, "`opening`, `sliding` or `depth` of `[[spring]]`"},
    {part_through, "`spring.depth`"},
    {varied_section, "plies, directions, regions or factors of the section"},
    {directed_section, "a section with directions"},
    {coupled_section,
     "plies that are not symmetric or have `alpha1` or `alpha2`, a stiffener with `eccentricity`, or `spring.depth`"},
    {heavier_on_one_side, "plies that are heavier on one side"},
    {axial_stiffener, "`stiffener.axial`"},
    {factors_to_accuracy, "`srif.accuracy`"},
    {results_to_accuracy, "`[accuracy]`"},
    {richardson, "`srif.richardson`"},
    {second_formulation, "`srif.second_formulation`"},
    {toughness, "`srif.toughness`"},
    {growth, "`[growth]`"},
    {growth_of_bonds, "`[growth]` by single bonds"},
    {growth_of_bonds_at_rest, "`[growth]` by single bonds, at rest"},
    {tips_in_motion, "`[growth]` of tips in motion"},
    {growth_by_displacement, "`growth.control` other than `\"load\"`"},
    {growth_from_rest_to_motion, "`growth.unstable = \"move\"`"},
    {frozen_pieces, "`growth.fallen = \"freeze\"`"},
    {local_preconditioner, "`analysis.preconditioner = \"local\"`"},
    {layers, "supports in layers outside the plate"},
    {hubs, "supports of kind `\"hub\"`"},
    {hubs_on_springs, "hubs with `k_w`"},
    {nodes_on_edges, "`discretization.boundary` other than `\"images\"`"},
    {processes, "several processes (`pdplate_distributed`)"},
});

/// Words for what a formulation may lack.
constexpr auto features = std::to_array<std::pair<plate::Feature, std::string_view>>({
    {plate::Feature::horizon, "families within a horizon"},
    {plate::Feature::influence, "`discretization.influence`"},
    {plate::Feature::volume_correction, "`discretization.volume_correction`"},
    {plate::Feature::surface_correction, "`discretization.surface_correction`"},
    {plate::Feature::full_horizon, "`discretization.full_horizon`"},
    {plate::Feature::surface_nodes, "`discretization.boundary`"},
    {plate::Feature::twist_match, "`discretization.twist_match`"},
    {plate::Feature::layers, "supports in layers outside the plate"},
    {plate::Feature::any_direction, "mirrors and hard supports on edges of any direction"},
    {plate::Feature::graded_points, "`discretization.tip_spacing`, `hole_spacing`, and `srif.accuracy`"},
    {plate::Feature::short_horizon, "`analysis.preconditioner = \"local\"` and `\"two_level\"`"},
    {plate::Feature::levels, "`analysis.preconditioner = \"levels\"`"},
    {plate::Feature::factor, "`analysis.method = \"direct\"`"},
    {plate::Feature::single_precision, "`analysis.precision = \"mixed\"`"},
    {plate::Feature::lanczos, "`analysis.method = \"lanczos\"` and `analysis.kind = \"harmonic\"`"},
    {plate::Feature::symmetry, "conjugate gradients, motion, frequencies and load cases"},
    {plate::Feature::breaking_bonds, "`[growth]` by single bonds"},
    {plate::Feature::running_tips, "`[growth]` of tips in motion"},
    {plate::Feature::sections, "plies, directions, regions or factors of the section"},
    {plate::Feature::stiffeners, "`[[stiffener]]`"},
    {plate::Feature::in_plane, "loads in the plane"},
    {plate::Feature::stretching,
     "`analysis.nonlinear`, `analysis.kind = \"buckling\"`, motion and frequencies under loads in the plane"},
    {plate::Feature::touching_faces, "`cracks.contact`"},
    {plate::Feature::hubs_in_holes, "supports of kind `\"hub\"` in holes"},
    {plate::Feature::part_through, "`spring.depth`"},
});

std::string by_one_process(const char* what) {
  return fmt::format("{} yet by several processes: run it by one (pdplate)", what);
}

constexpr const char* own_estimates = "estimates the error itself: remove srif.richardson and srif.second_formulation";
constexpr const char* equilibria =
    "load cases are states of rest: they need analysis.kind = \"static\"; loads in time are [[load]] with a history";
constexpr const char* settlements = "load[].kind";
constexpr const char* of_linear = "is measured for linear plates: remove it, and state discretization.spacing";
constexpr const char* of_uncoupled =
    "compares factors of plates whose bending and stretching are not coupled: remove it, stiffener[].eccentricity, or "
    "spring[].depth";
constexpr const char* layer_kinds = "support[].kind";
constexpr const char* hub_springs = "support[].k_w";
constexpr const char* support_pushes = "support[].pushes";
constexpr const char* hub_inertia =
    "the mass of a hub that moves along w is not carried in motion yet: remove k_w (its centre rests)";

const std::vector<Exclusion> excluded_pairs{
    {lanczos, impact, "analysis.method",
     "\"lanczos\" needs a linear plate, and a mass that may bounce off makes it nonlinear; choose "
     "\"central_difference\""},
    {lanczos, single_precision, "analysis.precision",
     "\"mixed\" is of method = \"central_difference\", as Lanczos vectors need double precision; choose \"double\""},
    {lanczos, growth, "analysis.method",
     "\"lanczos\" needs a stiffness that does not change, and cracks that grow change it; choose "
     "\"central_difference\""},
    {lanczos, settlement, settlements,
     "\"settlement\" given: supports that move need time steps; choose analysis.method = \"central_difference\""},
    {lanczos, moving_load, "analysis.method",
     "\"lanczos\" needs loads that stay in place, and loads that move need steps; choose \"central_difference\""},
    {lanczos, unilateral_foundation, "analysis.method",
     "\"lanczos\" needs a linear plate, and soil that lifts off makes it nonlinear; choose \"central_difference\""},
    {single_precision, stiffness_damping, "analysis.precision",
     "damping by the stiffness takes small differences of forces, which single precision loses; choose \"double\""},
    {single_precision, impact, "analysis.precision",
     "contact with the mass of [impact] is computed in double precision only; choose \"double\""},
    {single_precision, growth, "analysis.precision",
     "growth of cracks is computed in double precision only; choose \"double\""},
    {settlement, harmonic, settlements,
     "\"settlement\" given: the harmonic response is that to forces; supports that vibrate need analysis.kind = "
     "\"dynamic\""},
    {settlement, growth_of_bonds_at_rest, "growth.criterion",
     "bonds that break one by one at rest are followed under loads alone, not under settlements: choose "
     "\"energy_release\""},
    {settlement, growth_by_displacement, "growth.control",
     "must be \"load\" beside settlements, which say how far supports move"},
    {settlement, growth_from_rest_to_motion, "growth.unstable",
     "\"move\" takes over loads into the motion, but not supports that have moved: choose \"stop\" or \"jump\""},
    {unilateral_foundation, stiffness_damping, "analysis.damping",
     "the stiffness changes where the plate leaves the soil, and so would damping by it: give mass alone"},
    {unilateral_foundation, frequencies, "foundation",
     "a plate that may lift off is not linear and has no frequencies: remove lifts_off"},
    {unilateral_foundation, harmonic, "foundation",
     "a plate that may lift off is not linear and has no harmonic response: remove lifts_off"},
    {unilateral_foundation, growth, "foundation",
     "the loads at which cracks grow are found for linear plates, and a plate that may lift off is none: remove "
     "lifts_off"},
    {unilateral_foundation, combinations, "combination",
     "each load case touches other soil, so that load cases do not add up: give their sum a [[case]] of its own"},
    {pushing_supports, motion, support_pushes,
     "supports that only push are found at rest, not in motion yet: remove it, or choose kind = \"static\""},
    {pushing_supports, frequencies, support_pushes,
     "a plate that may lift off is not linear and has no frequencies: remove it"},
    {pushing_supports, harmonic, support_pushes,
     "a plate that may lift off is not linear and has no harmonic response: remove it"},
    {pushing_supports, buckling, support_pushes,
     "a plate that may lift off has no loads at which it buckles at once: remove it"},
    {pushing_supports, growth, support_pushes,
     "the loads at which cracks grow are found for linear plates, and a plate that may lift off is none: remove it"},
    {pushing_supports, combinations, "combination",
     "in each load case other supports touch, so that load cases do not add up: give their sum a [[case]] of its own"},
    {pushing_supports, large_deflections, support_pushes,
     "supports that only push are not found with large deflections yet: remove it, or analysis.nonlinear"},
    {pushing_supports, unilateral_foundation, support_pushes,
     "contact of soil and of supports are not found together yet: remove it, or lifts_off"},
    {pushing_supports, factors_to_accuracy, "srif.accuracy",
     "goes by error estimates that were measured on supports that hold both ways: remove it, and state the spacing"},
    {pushing_supports, nodes_on_edges, "discretization.boundary",
     "points leave supports with \"images\" alone: choose it, or remove pushes"},
    {pushing_supports, processes, support_pushes, by_one_process("supports that only push cannot be found")},
    {equilibrium_start, initial_deflection, "initial.deflection",
     "is given beside start = \"equilibrium\", which is another deflection: remove one"},
    {growth, stiffness_damping, "analysis.damping",
     "the stiffness changes while cracks grow, and so would damping by it: give mass alone"},
    {growth, second_formulation, "srif.second_formulation",
     "compares one crack, and cracks that grow differ between formulations: run both cases and compare growth.csv"},
    {growth, richardson, "srif.richardson",
     "compares one crack, and cracks that grow differ between spacings: run the case with twice the spacing"},
    {growth, factors_to_accuracy, "srif.accuracy",
     "finds a spacing for one crack, and cracks that grow change: remove it, and state discretization.spacing"},
    {growth, load_cases, "growth",
     "cracks grow differently under every load case, so that these share no plate: remove it, or run each load case by "
     "itself"},
    {growth, directed_section, "growth",
     "growth.fracture_energy is one number, and toughness of plies and of directions is several: remove [growth]"},
    {growth_of_bonds, temperature, "growth.criterion",
     "breaking single bonds takes no account of temperature: choose \"energy_release\""},
    {tips_in_motion, temperature, "growth",
     "growth in motion takes no account of temperature: let cracks grow at rest, with unstable = \"stop\" or \"jump\""},
    {growth_of_bonds, growth_from_rest_to_motion, "growth.unstable",
     "\"move\" needs crack tips that run on, and single broken bonds have none; choose \"stop\" or \"jump\""},
    {growth_by_displacement, growth_from_rest_to_motion, "growth.control",
     "must be \"load\" with unstable = \"move\": the loads stay while the plate moves"},
    {impact, frozen_pieces, "growth.fallen",
     "\"freeze\" would hold a piece that the mass of [impact] has knocked out: choose \"move\""},
    {load_cases, motion, "case", equilibria},
    {load_cases, frequencies, "case", equilibria},
    {load_cases, harmonic, "case", equilibria},
    {load_cases, factors_to_accuracy, "srif.accuracy",
     "finds a spacing for one load, and [[case]] gives several: run each load case by itself, or state the spacing"},
    {factors_to_accuracy, richardson, "srif.accuracy", own_estimates},
    {factors_to_accuracy, second_formulation, "srif.accuracy", own_estimates},
    {factors_to_accuracy, varied_section, "srif.accuracy",
     "goes by error estimates that were measured on one isotropic section: remove it, and state the spacing"},
    {toughness, directed_section, "srif.toughness",
     "is one number, and a section with directions has a toughness for each: remove it"},
    {processes, harmonic, "analysis.kind", by_one_process("\"harmonic\" cannot be run")},
    {processes, lanczos, "analysis.method", by_one_process("\"lanczos\" cannot be run")},
    {processes, local_preconditioner, "analysis.preconditioner", by_one_process("\"local\" cannot be made")},
    {processes, nodes_on_edges, "discretization.boundary", by_one_process("only \"images\" can be run")},
    {processes, layers, layer_kinds, by_one_process("layers cannot be run")},
    {processes, hubs, layer_kinds,
     "\"hub\" ties points that different processes would own: run it by one (pdplate), or choose \"clamped\""},
    {hubs, nodes_on_edges, "discretization.boundary",
     "nodes at edges have no points that move as one body: choose \"images\""},
    {hubs_on_springs, motion, hub_springs, hub_inertia},
    {hubs_on_springs, frequencies, hub_springs, hub_inertia},
    {hubs_on_springs, harmonic, hub_springs, hub_inertia},
    {hubs_on_springs, growth_from_rest_to_motion, hub_springs, hub_inertia},
    {processes, second_formulation, "srif.second_formulation", by_one_process("a second formulation cannot be run")},
    {processes, factors_to_accuracy, "srif.accuracy", by_one_process("spacings cannot be sought")},
    {load_in_plane, harmonic, "analysis.kind",
     "loads in the plane have no harmonic response yet: choose \"static\" or \"dynamic\""},
    {load_in_plane, lanczos, "analysis.method",
     "\"lanczos\" moves plates that bend alone, and loads act in the plane; choose \"central_difference\""},
    {load_in_plane, stiffness_damping, "analysis.damping",
     "damping by the stiffness does not act in the plane yet: give mass alone"},
    {load_in_plane, growth_of_bonds, "growth.criterion",
     "growth by single bonds in tension takes another energy than is asked for: choose \"energy_release\""},
    {growth_in_plane, frozen_pieces, "growth.fallen",
     "\"freeze\" holds pieces of plates that bend alone: choose \"move\""},
    {large_deflections_in_motion, mean_temperature, "analysis.nonlinear",
     "heat in the plane is carried with large deflections at rest, not in motion yet: choose kind = \"static\", or "
     "remove it"},
    {large_deflections, settlement, settlements,
     "\"settlement\" given: supports that move are not carried with large deflections yet: remove it, or nonlinear"},
    {large_deflections, unilateral_foundation, "foundation",
     "soil that lifts off is not carried with large deflections yet: remove lifts_off, or analysis.nonlinear"},
    {large_deflections, lanczos, "analysis.method",
     "\"lanczos\" needs a linear plate, and large deflections make it nonlinear; choose \"central_difference\""},
    {large_deflections, stiffness_damping, "analysis.damping",
     "the stiffness changes with the deflections, and so would damping by it: give mass alone"},
    {large_deflections, equilibrium_start, "analysis.start",
     "\"equilibrium\" given: large deflections begin undeformed or with initial.deflection; let loads grow by a "
     "history"},
    {large_deflections, growth, "growth",
     "the loads at which cracks grow are found for linear plates: remove it, or analysis.nonlinear"},
    {large_deflections, factors_to_accuracy, "srif.accuracy", of_linear},
    {large_deflections, richardson, "srif.richardson", of_linear},
    {large_deflections, second_formulation, "srif.second_formulation", of_linear},
    {arc_length, touching_faces, "analysis.control",
     "\"arc_length\" follows smooth paths, and faces that open and close make kinks: choose \"load\", or remove "
     "cracks.contact"},
    {arc_length, load_cases, "analysis.control",
     "\"arc_length\" follows the loads of one case: choose \"load\", or give each load case a file of its own"},
    {constant_load, load_cases, "load",
     "constant loads are part of no load case: give each load case a file of its own, or remove load[].constant"},
    {touching_faces, lanczos, "analysis.method",
     "\"lanczos\" needs a linear plate, and faces of cracks that open and close make it nonlinear; choose "
     "\"central_difference\""},
    {touching_faces, stiffness_damping, "analysis.damping",
     "the stiffness changes where faces of cracks meet, and so would damping by it: give mass alone"},
    {touching_faces, tips_in_motion, "cracks.contact",
     "growth in motion takes no account of faces that touch: remove it, or let cracks grow at rest, with unstable = "
     "\"stop\" or \"jump\""},
    {touching_faces, growth_of_bonds, "cracks.contact",
     "single bonds that break leave no faces that could touch: remove it, or choose growth.criterion = "
     "\"energy_release\""},
    {touching_bonds, richardson, "srif.richardson",
     "bounds the errors of closed cracks in bonds in 13 of 20 plates only: choose srif.second_formulation, or "
     "discretization.formulation = \"galerkin\""},
    {touching_in_motion, second_formulation, "srif.second_formulation",
     "compares states at the same time, and faces that rattle meet at other times in each formulation: remove it, or "
     "cracks.contact"},
    {springs_on_cracks, growth, "growth",
     "springs between the faces of cracks are of cracks that do not grow: remove it, or spring[].cracks"},
    {springs_on_cracks, processes, "spring[].cracks", by_one_process("springs between faces cannot be made")},
    {springs_in_plane, large_deflections, "analysis.nonlinear",
     "springs between the faces of cracks act in the plane by linear theory: remove it, or opening, sliding and depth"},
    {springs_on_cracks, touching_faces, "cracks.contact",
     "contact is found between faces that nothing ties: remove it, or spring[].cracks"},
    {part_through, varied_section, "spring[].depth",
     "the springs of such cracks are known for one isotropic material: remove it, or what makes the section vary"},
    {buckling, unilateral_foundation, "foundation",
     "a plate that may lift off has no loads at which it buckles at once: remove lifts_off"},
    {load_cases, buckling, "case", equilibria},
    {motion, heavier_on_one_side, "section.plies",
     "plies that are heavier on one side turn as they move in the plane, which is not carried in motion yet: make "
     "densities symmetric"},
    {coupled_section, lanczos, "analysis.method",
     "\"lanczos\" moves plates that bend alone, and bending and stretching are coupled; choose \"central_difference\""},
    {coupled_section, stiffness_damping, "analysis.damping",
     "damping by the stiffness does not act in the plane yet: give mass alone"},
    {coupled_section, growth, "growth",
     "cracks grow by factors of bending and tension that do not act on each other: remove it, or "
     "stiffener[].eccentricity"},
    {coupled_section, factors_to_accuracy, "srif.accuracy", of_uncoupled},
    {coupled_section, richardson, "srif.richardson", of_uncoupled},
    {coupled_section, second_formulation, "srif.second_formulation", of_uncoupled},
    {results_to_accuracy, factors_to_accuracy, "srif.accuracy",
     "finds another discretisation than [accuracy]: remove one, and run the other with the spacing that it finds"},
    {results_to_accuracy, richardson, "srif.richardson",
     "compares factors of a spacing that is given: remove it, or state discretization.spacing in place of [accuracy]"},
    {results_to_accuracy, second_formulation, "srif.second_formulation",
     "compares factors of a spacing that is given: remove it, or state discretization.spacing in place of [accuracy]"},
    {results_to_accuracy, growth, "accuracy",
     "goes by errors of a plate that does not change, and cracks that grow change it: remove it"},
    {results_to_accuracy, arc_length, "accuracy",
     "goes by results at the full load, and \"arc_length\" follows a path: choose analysis.control = \"load\""},
    {results_to_accuracy, processes, "accuracy", by_one_process("the discretisation cannot be found")},
    {axial_stiffener, growth, "growth",
     "growth takes no account of axial forces of stiffeners: remove it, or stiffener[].axial"},
};

bool is_hub(const plate::Support& support) {
  return support.kind == plate::SupportKind::hub;
}

}  // namespace

const std::vector<Exclusion>& exclusions() {
  return excluded_pairs;
}

std::string_view words_of(Part part) {
  return std::ranges::find(words, part, &std::pair<Part, std::string_view>::first)->second;
}

namespace {

/// Parts that are asked for.
class AskedParts {
public:
  void operator()(bool asked, Part part) {
    if (asked) found_.push_back(part);
  }
  std::vector<Part> found() && { return std::move(found_); }

private:
  std::vector<Part> found_;
};

void add_growth(const Case& content, AskedParts& add) {
  using Kind = Analysis::Kind;
  const auto& g = *content.growth;
  const bool moves = content.analysis.kind == Kind::dynamic, rests = content.analysis.kind == Kind::static_;
  const bool bonds = g.by_bonds(), to_motion = rests && g.unstable == fracture::Growth::Unstable::move;
  add(true, growth);
  add(bonds, growth_of_bonds);
  add(bonds && rests, growth_of_bonds_at_rest);
  add(!bonds && (moves || to_motion), tips_in_motion);
  add(g.control != fracture::Growth::Control::load, growth_by_displacement);
  add(to_motion, growth_from_rest_to_motion);
  add(g.detached == fracture::Growth::Detached::freeze, frozen_pieces);
}

void add_factors(const post::SrifOptions& srif, AskedParts& add) {
  add(srif.accuracy.has_value(), factors_to_accuracy);
  add(srif.richardson, richardson);
  add(srif.second_formulation, second_formulation);
  add(srif.toughness.has_value(), toughness);
}

}  // namespace

std::vector<Part> parts_of(const Case& content, bool distributed) {
  AskedParts add;
  using Kind = Analysis::Kind;
  const auto& a = content.analysis;
  const auto any_load = [&](const auto& test) { return std::ranges::any_of(content.loads, test); };
  const bool moves = a.kind == Kind::dynamic, bonds = content.growth && content.growth->by_bonds();
  add(moves, motion);
  add(a.kind == Kind::frequencies, frequencies);
  add(a.kind == Kind::harmonic, harmonic);
  add(moves && a.method == Analysis::Method::lanczos, lanczos);
  add((moves || bonds) && a.precision == Analysis::Precision::mixed, single_precision);
  add(moves && a.start == Analysis::Start::equilibrium, equilibrium_start);
  add(moves && content.initial && content.initial->deflection.given(), initial_deflection);
  add(moves && content.impact, impact);
  add(moves && a.damping && a.damping->stiffness > 0, stiffness_damping);
  add(any_load([](const auto& load) { return load.template as<plate::Settlement>() != nullptr; }), settlement);
  add(any_load([](const auto& load) { return load.moves(); }), moving_load);
  const bool in_plane = any_load([](const auto& load) { return load.in_plane(); });
  add(in_plane, load_in_plane);
  add(in_plane && content.growth, growth_in_plane);
  add(a.nonlinear, large_deflections);
  add(a.nonlinear && moves, large_deflections_in_motion);
  add(a.control == plate::LoadControl::arc_length, arc_length);
  add(any_load([](const auto& load) { return load.history.kind == plate::History::Kind::constant; }), constant_load);
  add(content.faces_touch(), touching_faces);
  add(content.faces_touch() && !content.discretization.formulation->offers(plate::Feature::graded_points),
      touching_bonds);
  add(content.faces_touch() && moves, touching_in_motion);
  add(a.kind == Kind::buckling, buckling);
  add(content.unilateral(), unilateral_foundation);
  add(content.pushed(), pushing_supports);
  add(any_load([](const auto& load) { return load.template as<plate::Temperature>() != nullptr; }), temperature);
  const bool couples = content.section.couples();  // heat across the plate then acts in its plane
  add(any_load(
          [&](const auto& load) { return load.template as<plate::Temperature>() && (couples || load.in_plane()); }),
      mean_temperature);
  add(!content.load_cases.empty() || !content.combinations.empty(), load_cases);
  add(!content.combinations.empty(), combinations);
  add(content.ties_faces(), springs_on_cracks);
  add(std::ranges::any_of(content.springs, &plate::Spring::stretches), springs_in_plane);
  add(content.part_through(), part_through);
  add(!content.section.simple(), varied_section);
  add(!content.section.isotropic(), directed_section);
  add(content.coupled(), coupled_section);
  add(content.section.heavier_on_one_side(), heavier_on_one_side);
  const bool axial = std::ranges::any_of(content.stiffeners, &plate::Stiffener::stretches);
  add(axial, axial_stiffener);
  if (content.srif) add_factors(*content.srif, add);
  add(content.accuracy.has_value(), results_to_accuracy);
  add(a.preconditioner == plate::Preconditioning::local, local_preconditioner);
  add(std::ranges::any_of(content.supports, plate::is_layer, &plate::Support::kind), layers);
  add(std::ranges::any_of(content.supports, is_hub), hubs);
  add(std::ranges::any_of(content.supports, [](const auto& support) { return support.k_w.has_value(); }),
      hubs_on_springs);
  add(content.discretization.boundary != plate::EdgeMethod::images, nodes_on_edges);
  add(distributed, processes);
  if (content.growth) add_growth(content, add);
  return std::move(add).found();
}

namespace {

/// The keys of an exclusion: of a list those of its entries that have the part.
std::vector<std::string> keys_of(const Exclusion& exclusion, const Case& content) {
  std::vector<std::string> result;
  for (std::size_t i = 0; exclusion.key == settlements && i < content.loads.size(); ++i)
    if (content.loads[i].as<plate::Settlement>()) result.push_back(key_of_load(content, i) + ".kind");
  for (std::size_t i = 0; exclusion.key == layer_kinds && i < content.supports.size(); ++i)
    if (exclusion.one == hubs || exclusion.other == hubs ? is_hub(content.supports[i])
                                                         : plate::is_layer(content.supports[i].kind))
      result.push_back(fmt::format("support[{}].kind", i));
  for (std::size_t i = 0; exclusion.key == hub_springs && i < content.supports.size(); ++i)
    if (content.supports[i].k_w) result.push_back(fmt::format("support[{}].k_w", i));
  for (std::size_t i = 0; exclusion.key == support_pushes && i < content.supports.size(); ++i)
    if (content.supports[i].push != plate::Push::both_ways) result.push_back(fmt::format("support[{}].pushes", i));
  return result.empty() ? std::vector{exclusion.key} : result;
}

}  // namespace

std::vector<KeyError> excluded(const Case& content, bool distributed) {
  const auto parts = parts_of(content, distributed);
  const auto has = [&](Part part) { return std::ranges::find(parts, part) != parts.end(); };
  std::vector<KeyError> result;
  for (const auto& exclusion : exclusions()) {
    if (!has(exclusion.one) || !has(exclusion.other)) continue;
    for (const auto& key : keys_of(exclusion, content)) {
      const auto same = [&](const KeyError& old) { return old.key == key && old.what == exclusion.reason; };
      if (std::ranges::none_of(result, same)) result.push_back({key, exclusion.reason});
    }
  }
  return result;
}

bool may_stretch(Case content) {
  using Kind = Analysis::Kind;
  content.analysis.nonlinear = true;
  return (content.analysis.kind == Kind::static_ || content.analysis.kind == Kind::dynamic) &&
         plate::formulation_of(content.discretization).offers(plate::Feature::stretching) && excluded(content).empty();
}

bool may_break_bonds(Case content) {
  content.growth->criterion = fracture::Growth::Criterion::bond_energy;
  return plate::formulation_of(content.discretization).offers(plate::Feature::breaking_bonds) &&
         excluded(content).empty();
}

std::string exclusion_list() {
  std::string text;
  for (const auto& [one, other, key, reason] : exclusions())
    text += fmt::format("- {} and {}.\n  `{}` {}\n", words_of(one), words_of(other), key, reason);
  text += "\n## What a formulation lacks\n\n";
  auto kinds = plate::formulations();
  for (const auto nodes : {plate::EdgeMethod::surface_nodes, plate::EdgeMethod::fictitious_nodes}) {
    plate::Discretization on_edges;
    on_edges.formulation = plate::formulations().back(), on_edges.boundary = nodes;
    kinds.push_back(&plate::formulation_of(on_edges));
  }
  for (const auto* kind : kinds)
    for (const auto& [feature, words] : features)
      if (!kind->offers(feature)) text += fmt::format("- {}: {}.\n  {}\n", kind->words, words, kind->lacks.at(feature));
  return text;
}

}  // namespace cases
