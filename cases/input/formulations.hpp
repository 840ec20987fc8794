#pragma once
#include "cases/input/toml_reader.hpp"

/// Which formulation of the plate a case is for, and what only one of them has.
namespace cases {

/// As in case files.
std::string formulation_name(plate::Formulation formulation);

/// Of the kinds that hold points outside the plate.
bool is_layer(plate::SupportKind kind);

/// One thing that a case asks for and that only bonds over a horizon have.
struct OfBonds {
  std::string asked;    // in words: horizon_ratio, precision = "mixed"
  std::string key;      // whose value the Galerkin plate refuses
  std::string refusal;  // what is said then; empty where it takes it, without effect
};

/// All that a case asks for and that only bonds have, in the order of its tables: by this "auto" chooses, and this the
/// Galerkin plate refuses. A key of the horizon counts where it is given, and is refused away from its default.
std::vector<OfBonds> of_bonds(const Case& content, const Reading& reading);

/// Does the file choose a formulation itself? "auto" is the same as none.
bool states_formulation(const toml::table& root);

/// Puts the formulation that "auto" stands for in the place of the Galerkin plate, which a case is read for unless it
/// states another, and the reason beside it. Complains about keys of graded points in a case for bonds.
void settle_formulation(bool stated, Case& content, Reading& reading);

/// Graded points move by Lanczos vectors unless the case states a method or asks for steps: stable steps follow the least spacing.
void settle_method(Case& content, const Reading& reading);

/// What one formulation has and the other has not.
void check_formulation(const Case& content, Reading& reading);

}  // namespace cases
