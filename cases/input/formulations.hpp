#pragma once
#include "cases/input/toml_reader.hpp"
#include "plate/model/numerical_method.hpp"

/// Which formulation of the plate a case is for, and what not every one of them can do.
namespace cases {

struct Case;

/// One thing that a case asks for and that not every formulation can do.
struct Asked {
  std::string words;  // horizon_ratio, precision = "mixed"
  std::string key;    // whose value a formulation refuses that cannot do it ...
  plate::Feature feature;
  bool refused;        // ... or takes without effect
  std::string remedy;  // what to do then
};

/// All of them, in the order of the tables of the case. A key of the horizon counts where it is given, and is refused
/// away from its default.
std::vector<Asked> asked(const Case& content, const Reading& reading);

/// Does the file choose a formulation itself? "auto" is the same as none.
bool states_formulation(const toml::table& root);

/// Puts the formulation that "auto" stands for, and the reason, in the place of the one that a case is read for unless
/// it states another. Complains about keys of graded points in a case that needs a formulation without.
void resolve_formulation(bool stated, Case& content, Reading& reading);

/// At rest and for harmonic responses, in a formulation with graded points: the spacing at the tips that factors need
/// (post::tip_spacing_for), unless the case gives one or says `refine_tips = false`. Of a case without problems.
void resolve_grading(Case& content, const Reading& reading);

/// Unless the case states a method: direct at rest where the stiffness is not symmetric; for graded points in motion,
/// whose stable steps follow the least spacing, Lanczos vectors if it does not ask for steps.
void resolve_method(Case& content, const Reading& reading);

/// Reports what the formulation of the case cannot do.
void check_formulation(const Case& content, Reading& reading);

}  // namespace cases
