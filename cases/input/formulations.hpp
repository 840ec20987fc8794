#pragma once
#include "cases/input/toml_reader.hpp"
#include "plate/model/numerical_method.hpp"

/// Choice of the formulation for a case, and features that not every formulation supports.
namespace cases {

struct Case;
struct CaseFile;

/// Feature that a case asks for and that not every formulation can do.
struct Asked {
  std::string words;  // horizon_ratio, precision = "mixed"
  std::string key;    // whose value a formulation refuses that cannot do it ...
  plate::Feature feature;
  bool refused;        // ... or takes without effect
  std::string remedy;  // what to do then
};

/// Returns all features that the case asks for, in the order of its tables. A key of the horizon counts where it is
/// given, and is refused away from its default.
std::vector<Asked> asked(const Case& content, const Reading& reading);

/// Puts the keys of root["recipe"] into the tree where they are absent: those of [analysis] and [srif] where there is
/// such a table and the analysis has that key. Reports a formulation that the recipe is not of. Returns the recipe with
/// its keys in words, and what the file gives instead of them; nothing without a recipe.
std::string apply_recipe(toml::table& root, Reading& reading);

/// True where the file chooses a formulation itself. "auto" is the same as none.
bool states_formulation(const toml::table& root);

/// Puts the formulation that "auto" stands for, and the reason, in the place of the one that a case is read for unless
/// it states another. Complains about keys of graded points in a case that needs a formulation without.
void resolve_formulation(bool stated, Case& content, Reading& reading);

/// Sets the spacing at the tips that factors need (post::tip_spacing_for), at rest and for harmonic responses, or that
/// of the plate for closer points at re-entrant corners, in a formulation with graded points, unless the case moves,
/// grows, gives one or says `refine_tips = false`. Requires a case without problems.
void resolve_grading(Case& content, const Reading& reading);

/// Sets the method unless the case states one: direct at rest where the stiffness is not symmetric; for graded points
/// in motion, whose stable steps follow the least spacing, Lanczos vectors if it does not ask for steps.
void resolve_method(Case& content, const Reading& reading);

/// Reports what the formulation of the case cannot do.
void check_formulation(const Case& content, Reading& reading);

/// The case in the other formulation, without files for fields. Settings that only one formulation has take their
/// defaults. Throws CaseError where the case cannot be stated in it.
CaseFile in_other_formulation(const CaseFile& file);

}  // namespace cases
