#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "cases/input/problems.hpp"
#include "plate/model/problem.hpp"

namespace cases {

struct Case;

/// Feature that a case may use, beside its plate and its supports.
enum class Part {
  motion,
  frequencies,
  harmonic,
  lanczos,
  single_precision,
  equilibrium_start,
  initial_deflection,
  impact,
  stiffness_damping,
  settlement,
  moving_load,
  load_in_plane,
  growth_in_plane,
  large_deflections,
  large_deflections_in_motion,
  arc_length,
  constant_load,
  touching_faces,
  touching_bonds,
  touching_in_motion,
  buckling,
  unilateral_foundation,
  pushing_supports,
  temperature,
  mean_temperature,
  load_cases,
  combinations,
  springs_on_cracks,
  springs_in_plane,
  part_through,
  varied_section,
  directed_section,
  coupled_section,
  heavier_on_one_side,
  axial_stiffener,
  factors_to_accuracy,
  results_to_accuracy,
  richardson,
  second_formulation,
  toughness,
  growth,
  growth_of_bonds,
  growth_of_bonds_at_rest,
  tips_in_motion,
  growth_by_displacement,
  growth_from_rest_to_motion,
  frozen_pieces,
  local_preconditioner,
  layers,
  hubs,
  hubs_on_springs,
  nodes_on_edges,
  processes
};

/// Two parts that do not go together, the key that is to change, and the reason, as a message says it.
struct Exclusion {
  Part one, other;
  std::string key;  // of settlements "load[].kind", of supports "support[].kind", "support[].k_w" or "support[].pushes"
  std::string reason;
};

/// Pairs of parts that are refused, all of them.
const std::vector<Exclusion>& exclusions();

/// A part in the words of case files.
std::string_view words_of(Part part);

/// The parts that a case asks for. `distributed`: several ranks are to run it.
std::vector<Part> parts_of(const Case& content, bool distributed = false);

/// The exclusions that a case meets, by its keys.
std::vector<KeyError> excluded(const Case& content, bool distributed = false);

/// True where a case would be accepted with large deflections.
bool may_stretch(Case content);
/// True where a case with growth would be accepted with bonds that break one by one.
bool may_break_bonds(Case content);

/// The exclusions, and what each formulation lacks, as two lists in Markdown.
std::string exclusion_list();

}  // namespace cases
