#include "plate/galerkin/shared/coarser_parts.hpp"

#include <algorithm>
#include <stdexcept>

#include "plate/formulation/attached/elastically_held.hpp"
#include "plate/formulation/parts/pieces.hpp"
#include "plate/galerkin/shared/laid_out.hpp"
#include "plate/galerkin/shared/part_of_cells.hpp"
#include "plate/galerkin/shared/sum_by_owners.hpp"
#include "plate/galerkin/supports.hpp"
#include "plate/model/refused.hpp"
#include "plate/solve/reduction.hpp"

namespace plate {
namespace {

/// What a process needs of a level, and for its points of a finer plate, of which `own` take from it.
class LevelOfParts {
public:
  LevelOfParts(const Ranks& all, const Problem& problem, WholeCells whole, const std::vector<geometry::Point>& seen,
               const std::vector<char>& own)
      : problem_(problem) {
    inside_ = about_first_inside(whole);
    const auto besides = box_of(whole, seen, own);
    const auto here = seen_cells(all, problem, whole, {}, besides);
    const auto& cells = here.cells;
    to_finer_ = transfer_to(seen, cells, own);
    std::vector<char> asked(cells.positions.size(), 0);
    for (const auto& share : to_finer_.shares) asked[share.other] = 1;
    auto boundary =
        galerkin_boundary(cells, areas_of(cells), geometry::to_lattice(problem.outline, cells.units), problem.supports);
    boundary.attached = attached_stiffness(problem, cells);
    part_ = part_of_cells(all, problem, here, boundary.attached, {}, asked);
    boundary_ = restricted(boundary, part_, 0);
    const auto& number = part_.part.number;
    for (auto& share : to_finer_.shares)
      share.other = std::uint32_t(std::ranges::lower_bound(number, share.other) - number.begin());
    sum_ = std::make_shared<SumByOwners>(all, std::move(part_.copies));
  }

  /// Asks no other process; nothing where there is none.
  std::optional<GalerkinLevel> level() && try {
    auto& cells = part_.part.cells;
    auto beside = geometry::seen_positions(cells);
    GalerkinOperator plate(galerkin_families(cells, inside_), PointSections(problem_.section, cells),
                           boundary_.attached, part_.stretch);
    return GalerkinLevel{std::move(cells), std::move(beside),    std::move(boundary_),
                         std::move(plate), std::move(to_finer_), std::move(sum_)};
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  } catch (const Refused&) {
    return std::nullopt;
  }

private:
  /// The cells about the finer points that take from these.
  static std::optional<geometry::CellBox> box_of(const WholeCells& whole, const std::vector<geometry::Point>& seen,
                                                 const std::vector<char>& own) {
    const auto* lattice = std::get_if<geometry::WholeLattice>(&whole);
    if (!lattice) return std::nullopt;
    std::optional<geometry::CellBox> result;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      if (!own[k]) continue;
      const auto [i, j] = geometry::cell_of(lattice->units().to_lattice(seen[k]));
      if (!result) result = {{i, j}, {i + 1, j + 1}};
      result->low = {std::min(result->low[0], i), std::min(result->low[1], j)};
      result->high = {std::max(result->high[0], i + 1), std::max(result->high[1], j + 1)};
    }
    return result ? std::optional(result->grown(2)) : std::nullopt;
  }

  const Problem& problem_;
  geometry::Tessellation inside_;  // the cells about the first point inside it
  LevelTransfer to_finer_;
  PartOfCells part_;
  Boundary boundary_;
  std::shared_ptr<const SumByOwners> sum_;
};

}  // namespace

std::size_t points_of_all(const Boundary& boundary) {
  return std::size_t(sum_of_all(double(boundary.own.empty() ? std::ptrdiff_t(boundary.cloud.plate_points)
                                                            : std::ranges::count(boundary.own, char(1)))));
}

std::vector<GalerkinLevel> coarser_parts(const Ranks& all, const Formulation& plate,
                                         const std::vector<geometry::Point>& seen) {
  const Problem& c = plate.problem();
  constexpr std::size_t few = 4000;  // points, as one process has on its last level
  const auto [low, high] = geometry::bounding_box(c.outline);
  std::vector<GalerkinLevel> result;
  std::size_t points = points_of_all(plate.boundary());
  for (double factor = 2; points > few && factor * c.discretization.spacing <= (high - low).minCoeff() / 8;
       factor *= 2) {
    try {
      auto whole = whole_cells_of(c, plate.paths(), factor);
      const auto count = points_of(whole);
      const bool first = result.empty();
      auto level = LevelOfParts(all, c, std::move(whole), first ? seen : result.back().seen,
                                first ? plate.boundary().own : result.back().boundary.own)
                       .level();
      if (largest_of_all(level ? 0 : 1) > 0) break;
      if (pieces(level->boundary, level->plate.families().families).size() != plate.pieces().size()) break;
      result.push_back(std::move(*level));
      points = count;
    } catch (const std::invalid_argument&) {  // the same in all processes, as the next
      break;                                  // cracks and edges are too close to each other for such points
    } catch (const Refused&) {
      break;  // a part that is held has none of them, or a process would
    }
  }
  return result;
}

}  // namespace plate
