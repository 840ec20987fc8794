#pragma once
#include <cmath>
#include <optional>

#include "post/factors/tip_methods.hpp"

namespace plate {
class Formulation;
struct Heat;
struct Stretch;
struct Problem;
struct TouchingFaces;
}  // namespace plate

/// The intensity factors of a plate's tips.
namespace post {

/// Distance from a tip within which nothing disturbs its field, not even loads and pins [length].
double clear_distance(const plate::Problem& problem, const std::vector<geometry::CrackPath>& paths,
                      const geometry::Tip& tip);

/// The least of all these tips; infinite without tips.
double least_clear_distance(const plate::Problem& problem, const std::vector<geometry::CrackPath>& paths,
                            const std::vector<geometry::Tip>& tips);

/// The spacing at the tips that intensity factors need where the points of a plate are too far apart for them: a sixth
/// of the layer beside the faces where the plate is thinner than 12 spacings (a 24th and 48 where faces of cracks
/// touch), a 32nd of the clear distance where that is below 24 spacings, at least a 256th of the spacing [length].
/// Absent where its points serve.
std::optional<double> tip_spacing_for(const plate::Problem& problem);

/// True where a ring of points fits about the tip, as every energy release rate needs.
bool ringed(const plate::Problem& problem, const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip);

/// The largest radius of the rings about tips whose spacings are `wider` than those of the plate [spacings]; 0 where no
/// tip is. The rings of graded points hold about as many at any spacing.
double widest_ring(const plate::Problem& problem, double wider);

/// The methods for every tip of a plate, which must outlive them; at some tips none may work.
std::vector<TipMethods> tip_methods(const plate::Formulation& plate, const SrifOptions& options);

/// The methods for a tip of cracks that have grown; none where no method works there. `view`: of the plate with these
/// cracks. `reach`: largest radius of rings [length].
std::optional<TipMethods> tip_methods(std::shared_ptr<const TipView> view, const plate::Problem& problem,
                                      const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip,
                                      const SrifOptions& options, double reach = INFINITY);

/// The intensity factors of all tips, normalised, the recommended one of each tip first. `heat`: what temperatures do
/// to the plate in this state; `stretch`: what deflections do to a plate in its plane.
std::vector<Srif> srifs(const plate::Formulation& plate, const SrifOptions& options,
                        const std::vector<TipMethods>& methods, const plate::State& state, bool all_rings = true,
                        const plate::Heat* heat = nullptr, const plate::Stretch* stretch = nullptr);

/// Faces of the plate at which cracks are closed next to every tip.
std::vector<ClosedTip> closed_tips(const plate::TouchingFaces& found, const plate::Formulation& plate);

/// Messages about tips without intensity factors, and why; of single methods that are missing where the case names its
/// methods.
std::vector<std::string> left_out(const std::vector<geometry::Tip>& tips, const std::vector<TipMethods>& methods,
                                  const SrifOptions& options);

/// A warning for each tip that has something within two spacings: what lies between is not resolved, and the whole
/// plate may be wrong.
std::vector<std::string> warnings_about_ligaments(const plate::Formulation& plate);

/// Factors that are not resolved, and those whose estimated error is above 3 % of the largest factor. `largest`: that
/// every tip ever has. `remedy`: Formulation::remedy().
std::vector<std::string> warnings_about_factors(const std::vector<Srif>& srifs, const std::vector<double>& largest,
                                                double thickness, const std::string& remedy);

}  // namespace post
