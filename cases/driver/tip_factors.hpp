#pragma once
#include "cases/driver/assembly.hpp"
#include "post/factors/tip_methods.hpp"

/// The intensity factors of a case's tips.
namespace cases {

/// Distance from a tip within which nothing disturbs the field of the tip (post::clear_distance), not even loads and pins.
double clear_distance(const Case& content, const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip);

/// The least of all these tips; infinite without tips.
double least_clear_distance(const Case& content, const std::vector<geometry::CrackPath>& paths, const std::vector<geometry::Tip>& tips);

/// The methods for the intensity factors of every tip, set up before anything is solved. `assembly` must outlive them.
/// Throws CaseError where no method can work at any tip.
std::vector<post::TipMethods> tip_methods(const CaseFile& file, const Assembly& assembly);

/// Does a ring of points fit about the tip, as every energy release rate needs?
bool ringed(const Case& content, const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip);

/// Cracks that grow by their tips need the energy release rate of each from the start, whatever methods [srif] names. Tips too
/// near to an edge, a load or another crack for it: CaseError at rest, a warning in motion, where they stay.
void check_growing_tips(const CaseFile& file, Assembly& assembly);

/// Adds a warning for each tip that has something within two spacings: what lies between is not resolved, and the whole plate may be wrong.
void warn_of_ligaments(const Case& content, Assembly& assembly);

/// Which methods are missing at which tips, and why.
std::vector<std::string> left_out(const Assembly& assembly, const std::vector<post::TipMethods>& methods);

/// The intensity factors of all tips, normalised, the recommended one of each tip first.
std::vector<post::Srif> srifs(const Case& content, const Assembly& assembly, const std::vector<post::TipMethods>& methods,
                              const plate::State& state, bool all_rings = true);

}  // namespace cases
