#include "plate/galerkin/shared/laid_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "plate/formulation/attached/elastically_held.hpp"
#include "plate/formulation/attached/stiffeners.hpp"
#include "plate/formulation/supports/inside.hpp"
#include "plate/galerkin/operator.hpp"
#include "plate/galerkin/shared/part_of_cells.hpp"
#include "plate/galerkin/supports.hpp"
#include "plate/model/loading/moving_forces.hpp"
#include "plate/model/loading/temperature.hpp"
#include "plate/model/refused.hpp"

namespace plate {

using geometry::Tessellation;

Tessellation cells_of(const Problem& c, const std::vector<geometry::CrackPath>& paths, double factor) {
  const auto& d = c.discretization;
  const auto times = [&](std::optional<double> spacing) {
    return spacing ? std::optional(factor * *spacing) : spacing;
  };
  return geometry::tessellation(c.outline, paths, factor * d.spacing, own_places(c, paths, factor * d.spacing),
                                {times(d.tip_spacing), times(d.hole_spacing), d.spacing_growth});
}

WholeCells whole_cells_of(const Problem& c, const std::vector<geometry::CrackPath>& paths, double factor) {
  const auto& d = c.discretization;
  if (!ranks() || d.tip_spacing || d.hole_spacing) return cells_of(c, paths, factor);
  const double spacing = factor * d.spacing;
  return geometry::WholeLattice(c.outline, paths, spacing, own_places(c, paths, spacing));
}

std::vector<double> cut_share(const Tessellation& cells, const std::vector<double>& areas) {
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

namespace {

/// What this process sees of the plate, or all of it, and what of that it keeps.
class Plan {
public:
  Plan(const Problem& problem, std::vector<geometry::CrackPath> paths, WholeCells whole) : problem_(problem) {
    const auto tips = geometry::tips(paths);
    const bool all_of_it = std::ranges::any_of(problem.loads, [](const Load& load) { return load.evaluated(); });
    if (const Ranks* all = ranks()) {
      if (std::holds_alternative<geometry::WholeLattice>(whole)) inside_ = about_first_inside(whole);
      seen_ = seen_cells(*all, problem, std::move(whole), tips, {}, all_of_it);
    } else {
      seen_.cells = std::move(std::get<Tessellation>(whole));
    }
    const auto& cells = seen_.cells;
    areas_ = areas_of(cells);
    auto boundary = galerkin_boundary(cells, areas_, geometry::to_lattice(problem.outline, cells.units),
                                      problem.supports, support_motions(problem));
    boundary.attached = attached_stiffness(problem, cells);
    if (const Ranks* all = ranks()) {
      part_ = part_of_cells(*all, problem, seen_, boundary.attached, tips);
      boundary = restricted(boundary, *part_, problem.loads.size());
    }
    layout_.emplace(Layout{problem, std::move(paths), tips, std::move(boundary), {}, {}});
    layout_->cut = here(cut_share(cells, areas_));
    masses_ = here(stiffener_masses(problem, cells));
  }

  GalerkinFamilies families() const {
    return part_ ? galerkin_families(part_->part.cells, inside_ ? *inside_ : seen_.cells)
                 : galerkin_families(seen_.cells);
  }

  LaidOut laid_out() && {
    auto& layout = *layout_;
    auto families = this->families();
    require_consistent(families);
    layout.sections.emplace(problem_.section, cells());
    layout.sections->add_masses(masses_, families.areas);
    layout.pieces = pieces(layout.boundary, families.families);
    for (const auto& load : problem_.loads) add(load, families);
    if (!part_) return {std::move(layout), std::move(seen_.cells), std::move(families), {}, {}};
    return {std::move(layout), std::move(part_->part.cells), std::move(families), std::move(part_->number),
            std::move(part_->stretch)};
  }

private:
  const Tessellation& cells() const { return part_ ? part_->part.cells : seen_.cells; }

  template <typename Values>
  Values here(Values values) const {
    return part_ ? restricted(values, part_->part) : values;
  }

  void require_consistent(const GalerkinFamilies& families) const {
    const auto residuals = consistency_residuals(families, cells(), layout_->boundary.own);
    if (std::max(residuals.first, residuals.second) > 1e-10)
      throw std::logic_error(fmt::format("families are not variationally consistent: {:.2e}, {:.2e} spacings",
                                         residuals.first, residuals.second));
  }

  void add(const Load& load, const GalerkinFamilies& families) {
    auto& layout = *layout_;
    const auto points = families.areas.size();
    TimedLoad result{here(nodal_forces(load, seen_.cells, areas_)), load.history,
                     free_curvature(load, problem_.section, layout.boundary.cloud.positions, points)};
    if (result.curvature.size() > 0)
      result.forces = force_of_curvature(families, problem_.section, result.curvature, layout.boundary.own);
    result.lift = layout.boundary.constraints.lift(layout.loads.size(), points);
    if (part_ && load.kind == Load::Kind::settlement && result.lift.cols() == 0)
      result.lift = State::Zero(3, Eigen::Index(points));  // all have one, also those that do not see what moves
    if (load.moves()) {
      auto moving = moving_forces(load, seen_.cells, areas_.size());
      result.moving = std::make_shared<MovingForces>(part_ ? restricted(std::move(moving), *part_) : std::move(moving));
    }
    if (load.gravity && !layout.sections->uniform())  // the load has its value where the section has its own mass
      for (Eigen::Index k = 0; k < result.forces.cols(); ++k)
        result.forces.col(k) *= (*layout.sections)[std::size_t(k)].mass / problem_.section.mass();
    layout.loads.push_back(std::move(result));
  }

  const Problem& problem_;
  SeenCells seen_;
  std::optional<Tessellation> inside_;  // the cells about the first point inside a lattice, where not all are seen
  std::vector<double> areas_, masses_;  // of what is seen; of the points that are kept
  std::optional<PartOfCells> part_;     // where several processes share the plate
  std::optional<Layout> layout_;
};

}  // namespace

LaidOut laid_out(const Problem& problem, std::vector<geometry::CrackPath> paths, WholeCells whole,
                 Stopwatch& stopwatch) {
  auto result = Plan(problem, std::move(paths), std::move(whole)).laid_out();
  stopwatch.lap("families");
  return result;
}

}  // namespace plate
