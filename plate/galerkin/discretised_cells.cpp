#include "plate/galerkin/discretised_cells.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "geometry/cells/distributed_lattice.hpp"
#include "geometry/lattice/cloud.hpp"
#include "geometry/shape/predicates.hpp"
#include "plate/formulation/springs_and_stiffeners.hpp"
#include "plate/formulation/support_constraints.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/galerkin/operator.hpp"
#include "plate/galerkin/part_of_cells.hpp"
#include "plate/galerkin/supports.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"

namespace plate {

using geometry::Tessellation;

namespace {

/// Places at which loads, springs and supports act at a fixed point.
std::vector<geometry::Point> places_of_forces(const Problem& c) {
  std::vector<geometry::Point> result;
  for (const auto& load : c.loads)
    if (const auto x = load.point()) result.push_back(*x);
  for (const auto& spring : c.springs)
    if (spring.position) result.push_back(*spring.position);
  for (const auto& support : c.supports) result.insert(result.end(), support.points.begin(), support.points.end());
  return result;
}

/// Edges beside which twist and shear change within the layer h / sqrt(12 k_s).
std::vector<std::string> layered_edges(const Problem& c) {
  auto result = geometry::edge_names({c.outline.outer, {}});
  const auto holds = [](const Support& support) {
    return !support.holds_nothing() && support.kind != SupportKind::simply_supported;
  };
  std::erase_if(result, [&](const std::string& name) {
    return std::ranges::any_of(c.supports, [&](const Support& support) {
      return holds(support) && std::ranges::find(support.edges, name) != support.edges.end();
    });
  });
  return result;
}

}  // namespace

geometry::Grading grading_of(const Problem& c, double factor) {
  constexpr double of_growth = 7;             // a layer that spacings of it at the edge and this growth see: theory.md
  constexpr double layers = 2, beyond = 0.5;  // where spacings grow as at tips, and how farther away
  const auto& d = c.discretization;
  const auto times = [&](std::optional<double> spacing) {
    return spacing ? std::optional(factor * *spacing) : spacing;
  };
  geometry::Grading result{times(d.tip_spacing), times(d.hole_spacing), d.spacing_growth, places_of_forces(c)};
  for (const auto& support : c.supports)
    if (support.patch) result.parts.push_back(*support.patch);
  if (!d.tip_spacing) return result;
  const double wide = d.spacing_growth * d.spacing, layer = c.section.layer();
  const double at_edges = std::max({wide, std::sqrt(wide * layer), of_growth * d.spacing_growth * layer});
  result.corners = geometry::singular_corners(c.outline);
  result.at_corners = factor * wide / 2;
  if (at_edges < 0.7 * d.spacing)
    for (auto& name : layered_edges(c))
      result.edges.push_back({.name = std::move(name),
                              .spacing = factor * at_edges,
                              .layer = layers * layer,
                              .beyond = std::max(d.spacing_growth, beyond)});
  return result;
}

namespace {

/// Gives the borders on the rims of bodies their names: they are no faces of cracks.
void name_rims(Tessellation& cells, const std::vector<PartedBody>& bodies) {
  const double beside = 0.25 * cells.units.spacing;  // cracks are farther from rims
  for (const auto& body : bodies) {
    const auto on_rim = [&](std::uint32_t k) { return body.on_rim(cells.positions[k], cells.units.spacing, beside); };
    for (auto& border : cells.borders)
      if (border.edge == geometry::Curves::crack && on_rim(border.from) && on_rim(border.to))
        border.edge = std::int32_t(cells.names.size());
    cells.names.push_back(body.name());
  }
}

}  // namespace

Tessellation cells_of(const Problem& c, const std::vector<geometry::CrackPath>& paths, double factor) {
  const double spacing = factor * c.discretization.spacing;
  const auto grading = grading_of(c, factor);
  const auto bodies = parted_bodies(c, paths, spacing);
  auto parting = paths;
  for (const auto& body : bodies)
    for (auto& path : body.rims(c.outline, std::min(spacing, grading.at_holes.value_or(spacing))))
      parting.push_back(std::move(path));
  auto result = geometry::tessellation(c.outline, parting, spacing, own_places(c, paths, spacing), grading);
  name_rims(result, bodies);
  return result;
}

std::variant<GlobalCells, Refusal> possible_cells(const Problem& c, const std::vector<geometry::CrackPath>& paths,
                                                  double factor, bool distributed) {
  const auto& d = c.discretization;
  const double spacing = factor * d.spacing;
  try {  // constructors of geometry throw where cells are impossible
    const bool bodies = std::ranges::any_of(c.supports, is_body);  // coarser cells, too, where they part none
    if (!distributed || d.tip_spacing || d.hole_spacing || bodies) return GlobalCells(cells_of(c, paths, factor));
    return GlobalCells(geometry::GlobalLattice(c.outline, paths, spacing, own_places(c, paths, spacing)));
  } catch (const std::invalid_argument& error) {
    return Refusal{Subject::geometry, 0, error.what()};
  } catch (const std::length_error& error) {
    return Refusal{Subject::spacing, 0, fmt::format("{:g} given makes {}", spacing, error.what())};
  }
}

GlobalCells global_cells_of(const Problem& c, const std::vector<geometry::CrackPath>& paths, double factor,
                            bool distributed) {
  auto found = possible_cells(c, paths, factor, distributed);
  if (const auto* refusal = std::get_if<Refusal>(&found)) throw Refused({*refusal});
  return std::get<GlobalCells>(std::move(found));
}

GlobalCells required_cells(const Problem& c, const std::vector<geometry::CrackPath>& paths, bool distributed) {
  auto found = possible_cells(c, paths, 1, distributed);
  if (auto* refusal = std::get_if<Refusal>(&found)) {
    if (refusal->subject == Subject::geometry) refusal->what += "; refine";
    throw Refused({*refusal});
  }
  return std::get<GlobalCells>(std::move(found));
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

/// Load on points: forces that stay, and forces that move.
struct Acting {
  Forces forces;
  std::shared_ptr<const MovingForces> moving;
};

/// Cells of the plate that this rank sees (all of them on one process) and the part of these that it keeps.
class Plan {
public:
  Plan(const Problem& problem, std::vector<geometry::CrackPath> paths, GlobalCells whole, const Communicator& all)
      : problem_(problem), all_(all) {
    if (all.distributed())
      share(std::move(paths), std::move(whole));
    else
      keep_all(std::move(paths), std::move(std::get<Tessellation>(whole)));
  }

  DiscretisedPart discretised_part() && {
    auto& layout = *layout_;
    auto families = part_ ? galerkin_families(cells_, inside_) : galerkin_families(cells_);
    require_few_neighbours(families);
    require_consistent(families);
    layout.sections.emplace(problem_.section, cells_);
    layout.sections->add_masses(masses_, families.areas);
    layout.pieces = pieces(layout.boundary, families.families, problem_.section.law);
    for (std::size_t i = 0; i < problem_.loads.size(); ++i) add(problem_.loads[i], std::move(acting_[i]), families);
    if (!part_) return {std::move(layout), std::move(cells_), std::move(families), {}, {}};
    return {std::move(layout), std::move(cells_), std::move(families), std::move(part_->number),
            std::move(part_->column_block)};
  }

private:
  Boundary boundary_of(const Tessellation& cells, const std::vector<double>& areas) const {
    auto result = galerkin_boundary(cells, areas, geometry::to_lattice(problem_.outline, cells.units),
                                    problem_.supports, support_motions(problem_), {&all_}, problem_.section.law);
    result.elastic_supports = elastic_supports_of(problem_, cells);
    return result;
  }

  Forces forces_of(const Load& load, const Tessellation& cells, const std::vector<double>& areas,
                   const PointMap& map) const {
    return problem_.section.law == PlateLaw::membrane ? nodal_forces_in_plane(load, cells, areas)
                                                      : nodal_forces(load, cells, areas, map);
  }

  void keep_all(std::vector<geometry::CrackPath> paths, Tessellation cells) {
    const auto areas = areas_of(cells);
    const auto tips = geometry::tips(paths);
    layout_.emplace(Layout{problem_, std::move(paths), tips, boundary_of(cells, areas), cut_share(cells, areas), {}});
    masses_ = stiffener_masses(problem_, cells);
    for (const auto& load : problem_.loads)
      acting_.push_back({forces_of(load, cells, areas, {}), load.moves()
                                                                ? std::make_shared<MovingForces>(moving_forces(
                                                                      load, cells, areas.size(), {}, &problem_.outline))
                                                                : nullptr});
    cells_ = std::move(cells);
  }

  void share(std::vector<geometry::CrackPath> paths, GlobalCells whole) {
    const auto tips = geometry::tips(paths);
    inside_ = about_first_inside(whole);
    const auto seen = cells_with_overlap(all_, problem_, whole, tips);
    const auto& cells = seen.cells;
    const auto areas = areas_of(cells);
    auto boundary = boundary_of(cells, areas);
    part_ = part_of_cells(all_, problem_, seen, boundary.elastic_supports, tips);
    boundary = restricted(boundary, *part_, problem_.loads.size());
    const auto& part = part_->part;
    layout_.emplace(
        Layout{problem_, std::move(paths), tips, std::move(boundary), restricted(cut_share(cells, areas), part), {}});
    masses_ = restricted(stiffener_masses(problem_, cells), part);
    PointMap map{&all_};
    for (const int owner : seen.owners) map.owned.push_back(owner == all_.rank());
    for (const auto& load : problem_.loads) {
      auto& acting = acting_.emplace_back(restricted(forces_of(load, cells, areas, map), part), nullptr);
      if (load.moves())
        acting.moving = std::make_shared<MovingForces>(
            restricted(moving_forces(load, cells, areas.size(), map, &problem_.outline), *part_));
    }
    cells_ = std::move(part_->part.cells);
  }

  /// Vertices and places far closer together than points are give points near them more neighbours than are kept.
  void require_few_neighbours(const GalerkinFamilies& families) const {
    constexpr double most = 32, wanted = 5;  // neighbours; times the distance of the places
    std::size_t worst = 0;
    const auto count = [&](std::size_t k) { return families.families[k].size(); };
    for (std::size_t k = 0; k < families.areas.size(); ++k)
      if (count(k) > count(worst)) worst = k;
    const double largest = largest_of(all_, double(count(worst)));
    if (largest <= most) return;
    const geometry::Point& x = cells_.positions[worst];
    double near = geometry::distance_to_boundary(problem_.outline, x);
    Refusal refusal{Subject::geometry, 0, "corners"};
    for (std::size_t i = 0; i < problem_.cracks.size(); ++i)
      if (const double away = geometry::distance(problem_.cracks[i], x); away < near)
        near = away, refusal = {Subject::crack, i, "vertices or further cracks"};
    refusal.what =
        fmt::format("{} about ({:.4g}, {:.4g}) are far closer together than points: take fewer, or `spacing` = {:.2g}",
                    refusal.what, x.x(), x.y(),
                    std::min(wanted * usual_distance(families, worst), problem_.discretization.spacing / 2));
    throw Refused({refusal});
  }

  /// Median over the neighbours of point k of the distance to the nearest other neighbour.
  double usual_distance(const GalerkinFamilies& families, std::size_t k) const {
    std::vector<double> least;
    for (const auto& one : families.families[k]) {
      least.push_back(INFINITY);
      for (const auto& other : families.families[k])
        if (const double away = (cells_.positions[one.neighbour] - cells_.positions[other.neighbour]).norm(); away > 0)
          least.back() = std::min(least.back(), away);
    }
    std::ranges::nth_element(least, least.begin() + std::ptrdiff_t(least.size() / 2));
    return least[least.size() / 2];
  }

  void require_consistent(const GalerkinFamilies& families) const {
    const auto residuals = consistency_residuals(families, cells_, layout_->boundary.map.owned);
    if (std::max(residuals.first, residuals.second) > 1e-10)
      throw std::logic_error(fmt::format("families are not variationally consistent: {:.2e}, {:.2e} spacings",
                                         residuals.first, residuals.second));
  }

  void add(const Load& load, Acting acting, const GalerkinFamilies& families) {
    auto& layout = *layout_;
    const auto points = families.areas.size();
    TimedLoad result{std::move(acting.forces), load.history,
                     free_curvature(load, problem_.section, layout.boundary.cloud.positions, points)};
    if (result.curvature.size() > 0)
      result.forces = force_of_curvature(families, problem_.section, result.curvature, layout.boundary.map);
    if (const auto beside = free_curvature_beside(load, problem_.section, layout.boundary.cloud.positions, points);
        beside.size() > 0)
      result.forces += force_of_curvature(families, coupling_of(problem_).section, beside, layout.boundary.map);
    if (const auto strain = linear_strain(problem_, load); strain && strain->varies())
      result.forces = forces_of_free_field(*strain, families);
    result.lift = layout.boundary.constraints.lift(layout.loads.size(), points);
    if (part_ && load.as<Settlement>() && result.lift.cols() == 0)
      result.lift = zero_state(points);  // all have one, also those that do not see what moves
    result.moving = std::move(acting.moving);
    if (const auto* pressure = load.as<Pressure>();
        pressure && pressure->gravity &&
        !layout.sections->uniform())  // the load has its value where the section has its own mass
      for (Eigen::Index k = 0; k < result.forces.cols(); ++k)
        result.forces.col(k) *= (*layout.sections)[std::size_t(k)].mass / problem_.section.mass();
    layout.loads.push_back(std::move(result));
  }

  /// The forces that hold the free field of a linear mean temperature.
  Forces forces_of_free_field(const LinearStrain& strain, const GalerkinFamilies& families) const {
    const auto block = part_ ? part_->column_block : std::vector<std::uint32_t>();
    Forces forces;
    GalerkinOperator(families, *layout_->sections, {}, block)
        .internal_force(free_field(layout_->boundary.cloud.positions, problem_, strain), forces);
    return -forces;
  }

  const Problem& problem_;
  const Communicator& all_;
  std::optional<PartOfCells> part_;  // where the plate is distributed
  Tessellation cells_;               // that are kept
  Tessellation inside_;              // those about the first point inside a distributed lattice
  std::vector<double> masses_;
  std::vector<Acting> acting_;  // by loads
  std::optional<Layout> layout_;
};

}  // namespace

DiscretisedPart discretised_part(const Problem& problem, std::vector<geometry::CrackPath> paths, GlobalCells whole,
                                 const Communicator& all, Stopwatch& stopwatch) {
  auto result = Plan(problem, std::move(paths), std::move(whole), all).discretised_part();
  stopwatch.lap("families");
  return result;
}

namespace {

using geometry::CellBox;
using geometry::Point;

/// A plate and its shares, where points are counted by boxes of cells.
struct Shares {
  geometry::LatticeUnits units;
  std::vector<double> points;  // of every process
  std::vector<CellBox> boxes;  // about these
  std::function<double(const CellBox&)> count;
  bool whole = false;
};

Shares shares_of(const geometry::GlobalLattice& lattice, int processes) {
  const geometry::DistributedLattice shared(lattice, processes);
  Shares result{lattice.units(), {}, {}, {}, false};
  for (int one = 0; one < processes; ++one) {
    const auto& part = shared.part(one);
    result.points.push_back(double(part.points));
    result.boxes.push_back(geometry::box_between(lattice.units(), part.low, part.high));
  }
  result.count = [&lattice](const CellBox& box) {
    double found = 0;
    for (long j = std::max(0L, box.low[1]); j < std::min(box.high[1], lattice.points().rows()); ++j)
      for (const auto& run : lattice.points().row(j))
        found += double(std::max(0L, std::min<long>(run.to, box.high[0]) - std::max<long>(run.from, box.low[0])));
    for (const auto& x : lattice.others()) found += box.contains(geometry::cell_of(x));
    return found;
  };
  return result;
}

Shares shares_of(const geometry::Tessellation& cells, int processes) {
  const auto owners = geometry::shared_out(cells, processes);
  Shares result{cells.units, std::vector<double>(std::size_t(processes), 0), {}, {}, true};
  std::vector<Point> low(result.points.size(), Point::Constant(INFINITY)), high(low.size(), -low.front());
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const auto one = std::size_t(owners[k]);
    ++result.points[one];
    low[one] = low[one].cwiseMin(cells.positions[k]), high[one] = high[one].cwiseMax(cells.positions[k]);
  }
  for (std::size_t one = 0; one < low.size(); ++one)
    result.boxes.push_back(geometry::box_between(cells.units, low[one], high[one]));
  result.count = [&cells](const CellBox& box) {
    return double(std::ranges::count_if(
        cells.positions, [&](const Point& x) { return box.contains(geometry::cell_of(cells.units.to_lattice(x))); }));
  };
  return result;
}

/// Points within `reach` of a place, but for those in a box.
double beyond(const Shares& shares, const Point& x, double reach, const CellBox& box) {
  const Point at = shares.units.to_lattice(x);
  const double radius = reach / shares.units.spacing;
  double found = 0;
  for (auto j = long(std::floor(at.y() - radius)); double(j) <= at.y() + radius; ++j) {
    const double half = std::sqrt(std::max(0.0, radius * radius - std::pow(double(j) - at.y(), 2)));
    const CellBox row{{long(std::ceil(at.x() - half)), j}, {long(std::floor(at.x() + half)) + 1, j + 1}};
    found += shares.count(row);
    if (const auto both = common(row, box); !is_empty(both)) found -= shares.count(both);
  }
  return found;
}

}  // namespace

std::vector<PartEstimate> estimated_parts(const Problem& problem, int processes) {
  constexpr long seen = 4, rings = 3;  // cells about owned points, and about these: part_of_cells(), cells_about()
  const auto paths = crack_paths(problem);
  const auto& d = problem.discretization;
  const bool graded = d.tip_spacing || d.hole_spacing;
  const auto whole = required_cells(problem, paths, true);
  require_parts(whole, processes);
  const auto shares = std::visit([&](const auto& cells) { return shares_of(cells, processes); }, whole);
  std::vector<PartEstimate> result;
  for (std::size_t one = 0; one < shares.boxes.size(); ++one) {
    const auto box = shares.boxes[one].grown(seen + rings);
    PartEstimate part{shares.points[one], shares.count(box), 0, graded};
    std::vector<CellBox> looked_at{box};
    for (const auto& tip : geometry::tips(paths)) {
      if (!shares.boxes[one].contains(geometry::cell_of(shares.units.to_lattice(tip.position)))) continue;
      const double reach = reach_about_tip(problem, tip) + (graded ? 0 : rings * d.spacing);
      part.seen += beyond(shares, tip.position, reach, box);
      const Point corner = Point::Constant(reach);
      looked_at.push_back(geometry::box_between(shares.units, tip.position - corner, tip.position + corner));
    }
    for (std::size_t other = 0; other < shares.boxes.size(); ++other)
      part.neighbours += other != one && std::ranges::any_of(looked_at, [&](const CellBox& cells) {
                           return !is_empty(common(cells, shares.boxes[other]));
                         });
    result.push_back(part);
  }
  return result;
}

}  // namespace plate
