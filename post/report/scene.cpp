#include "post/report/scene.hpp"

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/discretization.hpp"
#include "plate/solve/analysis.hpp"
#include "post/files/summary.hpp"

namespace post {
namespace {

constexpr double vector_bytes = 3 * sizeof(double);  // one state or force

}  // namespace

std::vector<ScenePart> scene(const plate::Formulation& plate, const plate::Analysis& analysis, const Given& given) {
  const double points = double(plate.cloud().plate_points), all = double(plate.cloud().size());
  const bool mixed = analysis.precision == plate::Analysis::Precision::mixed;
  using enum plate::Analysis::Method;
  const auto method = analysis.method;

  std::vector<ScenePart> parts;
  for (const auto& part : plate::memory_of(plate, mixed))
    parts.push_back({part.name, part.stage, part.bytes / points, 0});
  if (method == central_difference)
    parts.push_back({mixed ? "central differences: state, velocity; state and force in single precision"
                           : "central differences: state, velocity, force",
                     "solve", 3 * vector_bytes * all / points, 0});
  else if (method == adr)
    parts.push_back({"adaptive dynamic relaxation: 7 vectors", "solve", 7 * vector_bytes * all / points, 0});
  else if (method == cg || method == direct)
    parts.push_back({"conjugate gradients: 6 vectors, without a factor", "solve", 6 * vector_bytes * all / points, 0});
  else if (analysis.kind != plate::Analysis::Kind::frequencies)
    parts.push_back({"72 Lanczos vectors, their forces and modes, without a factor", "solve",
                     3 * 72 * vector_bytes * all / points, 0});
  else
    parts.push_back({"Lanczos iteration and conjugate gradients", "solve",
                     (4 * double(analysis.modes) + 16) * vector_bytes * all / points, 0});
  if (given.factors) parts.push_back({"intensity factors, probes, energies", "srif", 0, 0});
  constexpr double vtk_bytes = 560;  // measured 560 to 570 at 40,000 and 161,000 points
  parts.push_back({"output", "output", 3 * vector_bytes + (given.fields ? vtk_bytes : 0), 0});
  return parts;
}

Summary about(const plate::Formulation& plate, const plate::Analysis& analysis, const Given& given) {
  Summary summary;
  summary.formulation = plate.kind().name;
  summary.points = plate.cloud().plate_points;
  summary.bonds = plate.bonds();
  summary.fictitious_points = plate.fictitious_points();
  summary.fictitious_bonds = plate.fictitious_bonds();
  summary.spacing = plate.discretization().spacing;
  summary.horizon = plate.discretization().horizon();
  if (const auto match = plate.matched())
    summary.position_aware = {match->exact, match->blended, match->arbitrary_horizon};
  summary.scene = scene(plate, analysis, given);
  summary.analysis.kind = plate::name_of(analysis.kind);
  return summary;
}

}  // namespace post
