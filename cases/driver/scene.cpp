#include "cases/driver/scene.hpp"

#include "cases/input/formulations.hpp"

namespace cases {
namespace {

constexpr double vector_bytes = 3 * sizeof(double);  // one state or force

std::string name_of(plate::SurfaceCorrection correction) {
  switch (correction) {
    case plate::SurfaceCorrection::none: return "none";
    case plate::SurfaceCorrection::volume: return "volume";
    case plate::SurfaceCorrection::arbitrary_horizon: return "arbitrary horizon";
    case plate::SurfaceCorrection::position_aware: return "position-aware";
  }
  return "";
}

template <typename T>
double bytes_of(const std::vector<T>& values) {
  return double(values.size() * sizeof(T));
}

double weight_bytes(const plate::FamilyOperator& plate) {
  const auto& weights = plate.weights();
  return bytes_of(weights.kind) + bytes_of(weights.a) + bytes_of(weights.first) + bytes_of(weights.bonds) +
         bytes_of(plate.patterns().bonds) + bytes_of(plate.patterns().first) + bytes_of(plate.runs().runs) +
         bytes_of(plate.runs().example) + 2 * sizeof(double) * double(plate.points());
}

double cell_bytes(const geometry::Tessellation& cells) {
  return bytes_of(cells.positions) + bytes_of(cells.squares) + bytes_of(cells.triangles) + bytes_of(cells.borders);
}

std::string name_of(Analysis::Kind kind) {
  switch (kind) {
    case Analysis::Kind::static_: return "static";
    case Analysis::Kind::dynamic: return "dynamic";
    case Analysis::Kind::frequencies: return "frequencies";
  }
  return "";
}

}  // namespace

std::vector<post::ScenePart> scene(const Case& c, const Assembly& assembly) {
  const double points = double(assembly.boundary.cloud.plate_points), all = double(assembly.boundary.cloud.size());
  const double list = double(assembly.families().bytes());
  const double loads = double(assembly.loads.size()) * vector_bytes * all / points;
  const bool mixed = c.analysis.precision == Analysis::Precision::mixed;
  using enum Analysis::Method;
  const auto method = c.analysis.method;

  std::vector<post::ScenePart> parts{
      {"points", "geometry", all * (2 * sizeof(geometry::Point) + sizeof(double)) / points, 0},
      {"families, by patterns of bonds", "families", list / points, 0}};
  if (const auto* galerkin = assembly.galerkin()) {
    parts.push_back({"weights of the families, rows and bonds", "parameters", double(galerkin->op.bytes()) / points, 0});
    parts.push_back({"cells", "geometry", cell_bytes(galerkin->cells) / points, 0});
  } else {
    const auto& plate = *assembly.ordinary();
    parts.push_back({"weights of the bonds, surface correction " + name_of(c.discretization.surface_correction),
                     "parameters", weight_bytes(plate) / points, 0});
    parts.push_back({"rows of points", "parameters", double(plate.rows().bytes()) * (mixed ? 1.5 : 1) / points, 0});
  }
  if (!assembly.boundary.fictitious.empty())
    parts.push_back({"fictitious points (part of the points)", "", double(assembly.boundary.fictitious.size()) *
                     (sizeof(plate::FictitiousPoint) + 3 * sizeof(plate::Constraints::Tie)) / points, 0});
  if (!assembly.loads.empty()) parts.push_back({"loads", "", loads, 0});
  if (method == central_difference)
    parts.push_back({mixed ? "central differences: state, velocity; state and force in single precision"
                           : "central differences: state, velocity, force",
                     "solve", 3 * vector_bytes * all / points, 0});
  else if (method == adr)
    parts.push_back({"adaptive dynamic relaxation: 7 vectors", "solve", 7 * vector_bytes * all / points, 0});
  else if (method == cg || method == direct)
    parts.push_back({"conjugate gradients: 6 vectors, without a factor", "solve", 6 * vector_bytes * all / points, 0});
  else if (c.analysis.kind == Analysis::Kind::dynamic)
    parts.push_back({"72 Lanczos vectors, their forces and modes, without a factor", "solve", 3 * 72 * vector_bytes * all / points, 0});
  else
    parts.push_back({"Lanczos iteration and conjugate gradients", "solve",
                     (4 * double(c.analysis.modes) + 16) * vector_bytes * all / points, 0});
  if (c.srif) parts.push_back({"intensity factors, probes, energies", "srif", 0, 0});
  parts.push_back({"output", "output", (c.output.vtk ? 2 : 1) * 3 * vector_bytes, 0});
  return parts;
}

post::Summary about(const Case& c, const Assembly& assembly) {
  post::Summary summary;
  summary.title = c.title;
  summary.formulation = formulation_name(c.discretization.formulation);
  summary.formulation_reason = c.formulation_reason;
  summary.points = assembly.boundary.cloud.plate_points;
  summary.bonds = assembly.bonds();
  summary.fictitious_points = assembly.boundary.fictitious.size();
  summary.fictitious_bonds = assembly.fictitious_bonds();
  summary.spacing = c.discretization.spacing;
  summary.horizon = c.discretization.horizon();
  if (const auto& match = assembly.match)
    summary.position_aware = {match->exact, match->blended, match->arbitrary_horizon};
  summary.scene = scene(c, assembly);
  summary.warnings = assembly.warnings;
  summary.analysis.kind = name_of(c.analysis.kind);
  return summary;
}

}  // namespace cases
