#include "cases/driver/assembly_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "plate/solve/motion/dynamics.hpp"

namespace cases {
namespace {

std::string free_motion(const plate::Piece& piece) {
  return fmt::format("the piece of {} point{} about ({:g}, {:g}) can move as a rigid body in {} of 3 ways",
                     piece.points, piece.points == 1 ? "" : "s", piece.position.x(), piece.position.y(),
                     piece.free_modes);
}

bool finds_rest(const Case& content) {
  const auto& analysis = content.analysis;
  return analysis.kind == Analysis::Kind::static_ ||
         (analysis.kind == Analysis::Kind::dynamic && analysis.start == Analysis::Start::equilibrium);
}

std::string hanging(const plate::LoosePart& part) {
  return fmt::format(
      "the part of {} point{} about ({:g}, {:g}) hangs by bonds along one line through ({:g}, {:g}) and "
      "can turn about it",
      part.points, part.points == 1 ? "" : "s", part.position.x(), part.position.y(), part.ligament.x(),
      part.ligament.y());
}

}  // namespace

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
  if (finds_rest(file.content)) throw CaseError(problems);
  if (pieces.size() > 1)
    for (const auto& problem : problems) warnings.push_back(problem.what);
}

void check_mechanisms(const CaseFile& file, const plate::Mechanisms& found, std::vector<std::string>& warnings) {
  const bool statics = finds_rest(file.content);
  for (const auto& part : {found.driven, found.twisted})
    if (part && statics)
      throw CaseError({{file.place("geometry.cracks"), "geometry.cracks",
                        "cracks and edges leave a ligament one row of points wide, which is a hinge: " +
                            hanging(*part) + " under the load; a finer spacing gives it two rows"}});
  if (found.twisting > 0)
    warnings.push_back(fmt::format(
        "{} point{} bonds along one line only, in ligaments one row of points wide: the "
        "rotation about that line has no stiffness{}",
        found.twisting, found.twisting == 1 ? " has" : "s have", statics ? " and no load, and stays zero" : ""));
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
    warnings.push_back(
        fmt::format("bonds along one line divide the plate into {} parts, too many to look for motions "
                    "without resistance",
                    found.parts));
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

void check_modes(const CaseFile& file, const plate::Boundary& boundary) {
  if (file.content.analysis.kind != Analysis::Kind::frequencies) return;
  const auto mass = plate::mass(file.content.section, boundary.cloud.areas, boundary.active, boundary.constraints);
  const auto most = std::size_t((mass.array() > 0).count()) / 4;
  if (file.content.analysis.modes > most)
    throw CaseError({{file.place("analysis.modes"), "analysis.modes",
                      fmt::format("{} given, must be at most {}, a quarter of the plate's degrees of freedom",
                                  file.content.analysis.modes, most)}});
}

void check_weights(const CaseFile& file, const std::vector<plate::BondShape>& shapes) {
  for (const auto& bond : shapes)
    if (bond.weight < 0)
      throw CaseError(
          {{file.place("discretization.volume_correction"), "discretization.volume_correction",
            fmt::format("\"lattice_fitted\" has a negative weight at horizon_ratio {:g}; choose \"linear\", or "
                        "a ratio a little above a whole number",
                        file.content.discretization.horizon_ratio)}});
}

}  // namespace cases
