#include "cases/driver/assembly_galerkin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "cases/driver/assembly_checks.hpp"
#include "cases/driver/trust.hpp"

namespace cases {
namespace {

/// The points where loads and supports act get a point of their own.
std::vector<geometry::Point> single_points(const Case& c) {
  std::vector<geometry::Point> points;
  for (const auto& support : c.supports) points.insert(points.end(), support.points.begin(), support.points.end());
  for (const auto& load : c.loads)
    if (load.kind == plate::Load::Kind::point_force) points.push_back(load.position);
  return points;
}

/// The share of what lies about a place that other points there stand for: both faces of a crack, parted from each
/// other.
std::vector<double> cut_share(const geometry::Tessellation& cells, const std::vector<double>& areas) {
  std::map<std::pair<double, double>, double> around;
  std::vector<char> faces(areas.size(), 0);
  for (const auto& border : cells.borders)
    if (border.edge == geometry::Curves::crack) faces[border.from] = faces[border.to] = 1;
  const auto place = [&](std::size_t k) { return std::pair(cells.positions[k].x(), cells.positions[k].y()); };
  for (std::size_t k = 0; k < areas.size(); ++k)
    if (faces[k]) around[place(k)] += areas[k];
  std::vector<double> result(areas.size(), 0);
  for (std::size_t k = 0; k < areas.size(); ++k)
    if (faces[k]) result[k] = 1 - areas[k] / around.at(place(k));
  return result;
}

/// With all spacings `factor` times as wide.
geometry::Tessellation cells_of(const Case& c, const std::vector<geometry::CrackPath>& paths, double factor) {
  const auto& d = c.discretization;
  const auto times = [&](std::optional<double> spacing) {
    return spacing ? std::optional(factor * *spacing) : spacing;
  };
  return geometry::tessellation(c.outline, paths, factor * d.spacing, single_points(c),
                                {times(d.tip_spacing), times(d.hole_spacing), d.spacing_growth});
}

geometry::Tessellation cells_of(const CaseFile& file, const std::vector<geometry::CrackPath>& paths) {
  try {
    return cells_of(file.content, paths, 1);
  } catch (const std::invalid_argument& error) {
    throw CaseError({{file.place("geometry"), "geometry", fmt::format("{}; refine", error.what())}});
  }
}

}  // namespace

Assembly assemble_galerkin(const CaseFile& file, std::vector<geometry::CrackPath> paths, Stopwatch& stopwatch) {
  const Case& c = file.content;
  auto cells = cells_of(file, paths);
  stopwatch.lap("geometry");
  auto families = plate::galerkin_families(cells);
  const auto residuals = plate::consistency_residuals(families, cells);
  if (std::max(residuals.first, residuals.second) > 1e-10)
    throw std::logic_error(fmt::format("families are not variationally consistent: {:.2e}, {:.2e} spacings",
                                       residuals.first, residuals.second));
  const auto outline = geometry::to_lattice(c.outline, cells.units);
  auto boundary = plate::galerkin_boundary(cells, families.areas, outline, c.supports);
  check_modes(file, boundary);
  std::vector<std::string> warnings;
  check_held(file, plate::pieces(boundary, families.families), warnings);
  warn_of_distrust(c, boundary, warnings);
  auto shapes = plate::bond_shapes(families.families.vectors(), c.section, c.discretization);
  auto cut = cut_share(cells, families.areas);
  std::vector<plate::TimedLoad> loads;
  for (const auto& load : c.loads) loads.push_back({plate::nodal_forces(load, cells, families.areas), load.history});
  stopwatch.lap("families");

  plate::GalerkinOperator op(std::move(families), c.section);
  auto seen = geometry::seen_positions(cells);
  stopwatch.lap("parameters");
  const auto tips = geometry::tips(paths);
  return {std::move(paths),
          tips,
          std::move(boundary),
          std::move(cut),
          GalerkinPlate{std::move(cells), std::move(op), std::move(seen), std::move(shapes)},
          {},
          std::move(loads),
          std::move(warnings),
          false};
}

std::vector<plate::GalerkinLevel> coarser_plates(const Case& c, const Assembly& assembly) {
  constexpr std::size_t few = 4000;  // points; their factor costs some ten products of a hundred thousand points
  const auto [low, high] = geometry::bounding_box(c.outline);
  const auto pieces_of = [](const plate::Boundary& boundary, const geometry::Families& families) {
    return plate::pieces(boundary, families).size();
  };
  const auto pieces = pieces_of(assembly.boundary, assembly.families());
  std::vector<plate::GalerkinLevel> result;
  for (double factor = 2; factor * c.discretization.spacing <= (high - low).minCoeff() / 8; factor *= 2) {
    if ((result.empty() ? assembly.plate().points() : result.back().plate.points()) <= few) break;
    try {
      auto cells = cells_of(c, assembly.paths, factor);
      auto families = plate::galerkin_families(cells);
      auto boundary =
          plate::galerkin_boundary(cells, families.areas, geometry::to_lattice(c.outline, cells.units), c.supports);
      if (pieces_of(boundary, families.families) != pieces) break;
      auto seen = geometry::seen_positions(cells);
      result.push_back({std::move(cells), std::move(seen), std::move(boundary),
                        plate::GalerkinOperator(std::move(families), c.section)});
    } catch (const std::invalid_argument&) {
      break;  // cracks and edges are too close to each other for such points
    }
  }
  return result;
}

}  // namespace cases
