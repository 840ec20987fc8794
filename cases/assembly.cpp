#include "cases/assembly.hpp"

#include <fmt/format.h>
#include <algorithm>
#include "cases/trust.hpp"
#include "geometry/seeding.hpp"
#include "plate/mechanisms.hpp"

namespace cases {
namespace {

using Seconds = std::chrono::duration<double>;

std::string free_motion(const plate::Piece& piece) {
  return fmt::format("the piece of {} point{} about ({:g}, {:g}) can move as a rigid body in {} of 3 ways",
                     piece.points, piece.points == 1 ? "" : "s", piece.position.x(), piece.position.y(),
                     piece.free_modes);
}

/// Statics: nothing may move freely. Otherwise a loose piece is allowed, and said.
void check_held(const CaseFile& file, const std::vector<plate::Piece>& pieces, std::vector<std::string>& warnings) {
  std::vector<Problem> problems;
  for (const auto& piece : pieces) {
    if (piece.free_modes == 0) continue;
    const bool whole = pieces.size() == 1;
    const std::string key = whole ? "support" : "geometry.cracks";
    const std::string what = whole ? "the plate is not held: " + free_motion(piece) +
                                         "; hold an edge, or pin three points that are not on one line"
                                   : "cracks cut the plate into pieces, and " + free_motion(piece);
    problems.push_back({file.place(key), key, what});
  }
  if (problems.empty()) return;
  if (file.content.analysis.kind == Analysis::Kind::static_) throw CaseError(problems);
  if (pieces.size() > 1)
    for (const auto& problem : problems) warnings.push_back(problem.what);
}

std::string hanging(const plate::LoosePart& part) {
  return fmt::format("the part of {} point{} about ({:g}, {:g}) hangs by bonds along one line through ({:g}, {:g}) and "
                     "can turn about it",
                     part.points, part.points == 1 ? "" : "s", part.position.x(), part.position.y(), part.ligament.x(),
                     part.ligament.y());
}

/// A ligament one row of points wide is a hinge. Statics: no load may turn it; else it is said.
void check_mechanisms(const CaseFile& file, const plate::Mechanisms& found, std::vector<std::string>& warnings) {
  const bool statics = file.content.analysis.kind == Analysis::Kind::static_;
  for (const auto& part : {found.driven, found.twisted})
    if (part && statics)
      throw CaseError({{file.place("geometry.cracks"), "geometry.cracks",
                        "cracks and edges leave a ligament one row of points wide, which is a hinge: " + hanging(*part) +
                            " under the load; a finer spacing gives it two rows"}});
  if (found.twisting > 0)
    warnings.push_back(fmt::format("{} point{} bonds along one line only, in ligaments one row of points wide: the "
                                   "rotation about that line has no stiffness{}",
                                   found.twisting, found.twisting == 1 ? " has" : "s have",
                                   statics ? " and no load, and stays zero" : ""));
  if (found.motions > 0)
    warnings.push_back(fmt::format("parts that hang by bonds along one line can move in {} way{} without resistance{}",
                                   found.motions, found.motions == 1 ? "" : "s",
                                   found.driven ? ": " + hanging(*found.driven) : "; no load does so"));
  const bool may_move = found.motions > 0 || !found.searched;
  if (may_move && file.content.analysis.preconditioner == Analysis::Preconditioner::two_level)
    throw CaseError({{file.place("analysis.preconditioner"), "analysis.preconditioner",
                      "\"two_level\" needs a plate without motions that nothing resists, and parts of this one hang by "
                      "bonds along one line; choose \"diagonal\""}});
  if (!found.searched)
    warnings.push_back(fmt::format("bonds along one line divide the plate into {} parts, too many to look for motions "
                                   "without resistance", found.parts));
}

void check_edges_fit(const plate::Boundary& boundary, double spacing, std::vector<std::string>& warnings) {
  for (const auto& side : boundary.sides) {
    const int axis = side.normal_axis();
    if (axis < 0 || side.along_lattice() || side.kind == plate::SupportKind::free) continue;
    const double cells = side.edge.from[axis];
    warnings.push_back(
        fmt::format("edge '{}' lies {:.3f} spacings from the lattice's origin, not on a boundary between "
                    "cells: spacing {:.6g} would put it there",
                    side.name, cells, spacing * cells / std::round(cells)));
  }
}

/// A plate of n degrees of freedom has n modes; a quarter of them is more than anyone can mean.
void check_modes(const CaseFile& file, const plate::Boundary& boundary) {
  if (file.content.analysis.kind != Analysis::Kind::frequencies) return;
  const auto mass =
      plate::mass(file.content.section, boundary.cloud.areas, boundary.active, boundary.constraints);
  const auto most = std::size_t((mass.array() > 0).count()) / 4;
  if (file.content.analysis.modes > most)
    throw CaseError({{file.place("analysis.modes"), "analysis.modes",
                      fmt::format("{} given, must be at most {}, a quarter of the plate's degrees of freedom",
                                  file.content.analysis.modes, most)}});
}

/// A lattice that is far from isotropic at its rim cannot be fitted with a weight that is not negative.
void check_weights(const CaseFile& file, const std::vector<plate::BondShape>& shapes) {
  for (const auto& bond : shapes)
    if (bond.weight < 0)
      throw CaseError({{file.place("discretization.volume_correction"), "discretization.volume_correction",
                        fmt::format("\"lattice_fitted\" has a negative weight at horizon_ratio {:g}; choose \"linear\", or "
                                    "a ratio a little above a whole number",
                                    file.content.discretization.horizon_ratio)}});
}

std::vector<plate::TimedLoad> timed_loads(const Case& c, const geometry::Cloud& cloud) {
  std::vector<plate::TimedLoad> loads;
  for (const auto& load : c.loads) loads.push_back({plate::nodal_forces(load, cloud, c.outline), load.history});
  return loads;
}

struct Weights {
  plate::HorizonWeights weights;
  std::optional<plate::MatchCounts> counts;
};

Weights horizon_weights(const Case& c, const plate::Boundary& boundary, const geometry::Families& families,
                        const std::vector<plate::BondShape>& shapes) {
  const auto& areas = boundary.cloud.areas;
  const auto kinds = plate::family_kinds(families, areas, boundary.active);
  if (c.discretization.surface_correction == plate::SurfaceCorrection::position_aware) {
    auto found = plate::position_aware(families, shapes, areas, boundary.active, kinds, c.section);
    return {std::move(found.weights), found.counts};
  }
  const auto parameters =
      plate::horizon_parameters(families, shapes, areas, boundary.active, c.section, c.discretization);
  return {plate::weights_of_parameters(families, shapes, areas, kinds, parameters), std::nullopt};
}

}  // namespace

void Stopwatch::lap(const std::string& stage) {
  const auto now = std::chrono::steady_clock::now();
  const double spent = Seconds(now - last_).count();
  last_ = now;
  const auto entry = std::find_if(seconds_.begin(), seconds_.end(), [&](const auto& s) { return s.first == stage; });
  if (entry == seconds_.end())
    seconds_.emplace_back(stage, spent);
  else
    entry->second += spent;
}

double Stopwatch::seconds(const std::string& stage) const {
  for (const auto& [name, spent] : seconds_)
    if (name == stage) return spent;
  return 0;
}

double Stopwatch::total() const {
  double sum = 0;
  for (const auto& [stage, seconds] : seconds_) sum += seconds;
  return sum;
}

plate::Forces mass_of(const Case& c, const Assembly& assembly) {
  const auto& boundary = assembly.boundary;
  return plate::mass(c.section, boundary.cloud.areas, boundary.active, boundary.constraints, c.analysis.rotary_inertia);
}

std::size_t Assembly::bonds() const {
  const auto& families = plate.families();
  std::size_t count = 0;
  for (std::size_t k = 0; k < boundary.cloud.plate_points; ++k)
    for (const auto& bond : families[k]) count += boundary.is_plate(bond.neighbour);
  return count;
}

std::size_t Assembly::fictitious_bonds() const {
  return plate.families().bonds() - bonds();
}

Assembly assemble(const CaseFile& file, Stopwatch& stopwatch) {
  const Case& c = file.content;
  const auto& d = c.discretization;
  const auto [low, high] = geometry::bounding_box(c.outline);
  const auto paths = geometry::crack_paths(c.outline, c.cracks, 1e-9 * (high - low).norm());

  auto cloud = geometry::lattice(c.outline, d.spacing);
  const auto outline = geometry::to_lattice(c.outline, cloud.units);
  auto boundary = plate::boundary(std::move(cloud), outline, c.supports, d);
  std::vector<std::string> warnings = boundary.warnings;
  check_edges_fit(boundary, d.spacing, warnings);
  check_modes(file, boundary);
  stopwatch.lap("geometry");

  const auto whole = geometry::families(boundary.cloud, d.horizon(), plate::sees(boundary, outline, d.horizon_ratio));
  auto families = fracture::sever(boundary, whole, geometry::to_lattice(paths, boundary.cloud.units), d.horizon_ratio);
  const auto pieces = plate::pieces(boundary, families);
  check_held(file, pieces, warnings);
  warn_of_distrust(c, boundary, warnings);
  stopwatch.lap("families");

  auto shapes = plate::bond_shapes(families.vectors(), c.section, d);
  check_weights(file, shapes);
  auto cut = fracture::cut_share(whole, families, shapes, boundary.cloud.plate_points);
  const auto& areas = boundary.cloud.areas;
  auto loads = timed_loads(c, boundary.cloud);
  plate::Forces load = plate::Forces::Zero(3, Eigen::Index(boundary.cloud.size()));
  for (const auto& one : loads) load += one.forces;
  const auto mechanisms = plate::mechanisms(boundary, families, pieces, load);
  check_mechanisms(file, mechanisms, warnings);
  auto [weights, counts] = horizon_weights(c, boundary, families, shapes);
  plate::LatticeOperator plate(plate::FamilyOperator(std::move(families), std::move(shapes), areas, std::move(weights)));
  stopwatch.lap("parameters");

  return {paths,
          geometry::tips(paths),
          std::move(boundary),
          std::move(cut),
          std::move(plate),
          counts,
          std::move(loads),
          std::move(warnings),
          mechanisms.motions > 0 || !mechanisms.searched};
}

}  // namespace cases
