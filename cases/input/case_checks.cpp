#include "cases/input/case_file.hpp"
#include "cases/input/formulations.hpp"
#include "cases/input/keys.hpp"
#include "cases/input/refused.hpp"
#include "geometry/shape/crack_extension.hpp"
#include "geometry/shape/snapping.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/faults/edge_faults.hpp"
#include "plate/solve/suitability.hpp"

namespace cases {
namespace {

/// Shape and cracks; true where edges and points can be checked against the shape.
bool check_geometry(const Case& content, Reading& reading) {
  for (const char* key : {"geometry.outline", "geometry.holes"})
    if (!reading.sound(key)) return false;
  if (content.outline.outer.vertices.empty()) return false;
  const auto shape_faults = geometry::faults(content.outline);
  for (const auto& fault : shape_faults) reading.complain("geometry." + fault.where, fault.what);
  if (!shape_faults.empty()) return false;
  if (!reading.sound("geometry.cracks")) return true;
  for (const auto& fault : geometry::faults(content.outline, content.cracks, geometry::tolerance(content.outline)))
    reading.complain("geometry." + fault.where, fault.what);
  return true;
}

/// Names of edges, kinds and places of supports and loads.
void check_edges(const Case& content, Reading& reading) {
  for (const auto& fault : plate::faults_of_edges(content)) {
    const auto key = key_of(fault);
    if (fault.subject == plate::Subject::support_direction &&
        !reading.sound(fmt::format("support[{}].kind", fault.number)))
      continue;
    if (!reading.sound(key) || (fault.subject == plate::Subject::load_position && !reading.given(key))) continue;
    reading.complain(key, fault.what);
  }
}

void check_lengths(const Case& content, Reading& reading) {
  for (const auto& fault : plate::faults_of_lengths(content, content.analysis)) {
    const bool known =
        fault.subject == plate::Subject::spacing ? !reading.finds_spacing : reading.sound("section.thickness");
    if (known && reading.sound("discretization.spacing")) reading.complain(key_of(fault), fault.what);
  }
}

void check_probes(const Case& content, Reading& reading) {
  for (const auto& [name, point] : content.output.probes)
    if (!plate::on_plate(content.outline, point))
      reading.complain("output.probes." + name, text_of(point) + " given, must lie in the plate or on its boundary");
}

void check_tips(const Case& content, Reading& reading) {
  if (!content.srif || !reading.sound("geometry") || (content.growth && content.growth->by_bonds())) return;
  const auto paths = plate::crack_paths(content);
  if (geometry::tips(paths).empty())
    reading.complain("srif",
                     "there is no crack tip to find intensity factors at: remove [srif] or give geometry.cracks");
}

/// What growth by single bonds has and that by tips has not, and the other way round.
void check_criterion(const fracture::Growth& growth, Reading& reading) {
  using enum fracture::Growth::Criterion;
  const bool limits = growth.criterion == curvature_shear && (growth.critical_curvature || growth.critical_shear);
  if (!reading.given("growth.fracture_energy") && !limits)
    reading.complain("growth.fracture_energy", "is missing, must be a number > 0");
  if (growth.criterion != curvature_shear)
    for (const char* key : {"growth.critical_curvature", "growth.critical_shear"})
      if (reading.given(key)) reading.complain(key, "is of criterion = \"curvature_shear\": remove it");
  if (!growth.by_bonds() && reading.given("growth.apparent_toughness"))
    reading.complain("growth.apparent_toughness", "is of criteria for bonds: remove it");
  if (limits && !reading.given("growth.fracture_energy") && reading.given("growth.apparent_toughness"))
    reading.complain("growth.apparent_toughness",
                     "divides what follows from growth.fracture_energy, which is not given: remove it");
  if (growth.by_bonds())
    for (const char* key : {"growth.direction", "growth.increment"})
      if (reading.given(key))
        reading.complain(key, "is of criterion = \"energy_release\": bonds break where they fail; remove it");
}

/// From rest to motion.
void check_switch(const Case& content, Reading& reading) {
  const auto& growth = *content.growth;
  const bool moves = growth.unstable == fracture::Growth::Unstable::move;
  if (!moves) {
    if (reading.given("growth.duration")) reading.complain("growth.duration", "is of unstable = \"move\": remove it");
    return;
  }
  if (!reading.given("growth.duration")) reading.complain("growth.duration", "is missing, must be a number > 0");
  if (!reading.given("section.density"))
    reading.complain("section.density", "is missing, must be a number > 0: the plate may begin to move");
  if (growth.by_bonds())
    reading.complain(
        "growth.unstable",
        "\"move\" given: cracks of broken bonds cannot be handed over to a motion; choose \"stop\" or \"jump\"");
  if (growth.control != fracture::Growth::Control::load)
    reading.complain("growth.control",
                     "must be \"load\" with unstable = \"move\": the loads stay while the plate moves");
}

/// How the states between which bonds break one by one, or tips run, may be found.
void check_analysis_of_growth(const Case& content, Reading& reading) {
  const bool moves = content.analysis.kind == Analysis::Kind::dynamic;
  if (!moves && !content.growth->by_bonds()) return;
  if (content.analysis.precision == Analysis::Precision::mixed)
    reading.complain("analysis.precision", "growth is in double precision only; choose \"double\"");
  if (moves) return;
  if (content.analysis.method != Analysis::Method::cg)
    reading.complain("analysis.method",
                     "breaking bonds takes a solution for each, by conjugate gradients with one factor; choose \"cg\"");
  if (content.analysis.preconditioner != plate::Preconditioning::automatic)
    reading.complain("analysis.preconditioner",
                     "bonds that break in a static case have one of their own; choose \"auto\"");
}

void check_growth(const Case& content, Reading& reading) {
  if (!content.growth || !reading.sound("geometry")) return;
  check_criterion(*content.growth, reading);
  check_analysis_of_growth(content, reading);
  if (content.analysis.kind == Analysis::Kind::static_) check_switch(content, reading);
  const auto paths = plate::crack_paths(content);
  if (!content.growth->by_bonds() && geometry::tips(paths).empty())
    reading.complain("growth",
                     "there is no crack tip that could grow: give geometry.cracks, criterion = \"bond_energy\", or "
                     "remove [growth]");
  double longest = 0, all = 0;
  for (const auto& crack : content.cracks)
    longest = std::max(longest, geometry::length(crack)), all += geometry::length(crack);
  const double there = content.growth->by_bonds() ? all : longest;
  if (content.growth->max_length && there >= *content.growth->max_length)
    reading.complain("growth.max_length", fmt::format("{} given, must be larger than the {:.6g} of geometry.cracks",
                                                      number_text(*content.growth->max_length), there));
  const auto has = [&](const char* method) {
    return std::ranges::find(content.srif->methods, method) != content.srif->methods.end();
  };
  if (content.srif && !content.growth->by_bonds() && !has("virtual_crack_extension") && !has("domain_integral"))
    reading.complain("srif.methods",
                     "growth needs an energy release rate: add \"virtual_crack_extension\" or \"domain_integral\"");
  if (content.srif && content.srif->second_formulation)
    reading.complain("srif.second_formulation",
                     "is not available with [growth]: run both cases and compare their growth.csv");
  if (content.srif && content.srif->richardson)
    reading.complain("srif.richardson", "is not available with [growth]: run the case with twice the spacing");
}

/// What only steps have, and what only Lanczos vectors.
void check_motion(const Case& content, Reading& reading) {
  if (content.analysis.kind != Analysis::Kind::dynamic) return;
  if (content.analysis.method != Analysis::Method::lanczos) {
    if (reading.given("analysis.tolerance"))
      reading.complain("analysis.tolerance", "is of method = \"lanczos\"; steps have analysis.time_step: remove it");
    return;
  }
  const auto complain = [&](const char* key) {
    reading.complain(key, "is of method = \"central_difference\"; Lanczos vectors take no steps: remove it");
  };
  if (content.analysis.time_step) complain("analysis.time_step");
  if (reading.given("analysis.safety")) complain("analysis.safety");
  if (content.analysis.precision == Analysis::Precision::mixed)
    reading.complain("analysis.precision", "\"mixed\" is of method = \"central_difference\"; choose \"double\"");
  if (const auto& kind = *content.discretization.formulation; !kind.offers(plate::Feature::lanczos) && !content.growth)
    reading.complain("analysis.method", kind.lacks.at(plate::Feature::lanczos) + "; choose \"central_difference\"");
  if (content.growth)
    reading.complain("analysis.method",
                     "\"lanczos\" given: growth in motion takes steps; choose \"central_difference\"");
}

/// What stands in the way of finding the discretisation.
void check_accuracy(const Case& content, Reading& reading) {
  if (!content.srif || !content.srif->accuracy) return;
  const auto complain = [&](const std::string& what) { reading.complain("srif.accuracy", what); };
  if (const auto& kind = *content.discretization.formulation; !kind.offers(plate::Feature::graded_points))
    complain(kind.lacks.at(plate::Feature::graded_points) + " (formulation " + content.formulation_reason +
             "): remove it or that");
  else if (content.analysis.kind == Analysis::Kind::dynamic && content.analysis.method != Analysis::Method::lanczos)
    complain("moves the plate by Lanczos vectors: remove what asks for steps (analysis.method, time_step, safety)");
  if (content.growth) complain("is not available with [growth]");
  if (content.srif->richardson || content.srif->second_formulation)
    complain("has estimates of its own: remove srif.richardson and srif.second_formulation");
  for (const char* method : {"virtual_crack_extension", "domain_integral", "series_fit"})
    if (std::ranges::find(content.srif->methods, method) == content.srif->methods.end())
      complain(fmt::format("compares methods: add \"{}\" to srif.methods, or remove these", method));
}

}  // namespace

void snap_cracks(Case& content, Reading& reading) {
  constexpr double share = 0.05;  // of a spacing: points do not tell the difference
  if (!reading.sound("geometry") || content.outline.outer.vertices.size() < 3) return;
  const double spacing = content.discretization.spacing_at_tips();
  auto found = geometry::snapped(content.outline, std::move(content.cracks), spacing > 0 ? share * spacing : INFINITY);
  content.cracks = std::move(found.cracks);
  for (const auto& snap : found.snaps)
    reading.found().notes.push_back(
        fmt::format("geometry.cracks[{}]: its {} at {} was {:.2g} from {} and is taken to end there", snap.crack,
                    snap.at_back ? "last point" : "first point",
                    text_of(snap.at_back ? content.cracks[snap.crack].back() : content.cracks[snap.crack].front()),
                    snap.distance, snap.onto));
}

void check_case(const Case& content, Reading& reading) {
  if (content.loads.empty() && reading.kind != Analysis::Kind::frequencies && reading.sound("load"))
    reading.complain("load", "nothing loads the plate: give at least one [[load]]");
  check_formulation(content, reading);
  if (!check_geometry(content, reading)) return;
  check_lengths(content, reading);
  check_edges(content, reading);
  check_probes(content, reading);
  check_tips(content, reading);
  check_growth(content, reading);
  check_accuracy(content, reading);
  check_motion(content, reading);
}

}  // namespace cases
