#include "plate/galerkin/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "geometry/cells/tessellation.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/formulation/springs_and_stiffeners.hpp"
#include "plate/galerkin/discretised_cells.hpp"
#include "plate/galerkin/part_of_cells.hpp"
#include "plate/galerkin/stiffness.hpp"
#include "plate/galerkin/supports.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace plate {

SumByOwners::SumByOwners(const Communicator& all, std::vector<Copy> copies)
    : all_(all), sent_(std::size_t(all.size())) {
  std::vector<std::vector<std::uint32_t>> there(sent_.size());
  for (const auto& copy : copies)
    sent_[std::size_t(copy.owner)].push_back(copy.point), there[std::size_t(copy.owner)].push_back(copy.of_owner);
  std::vector<std::string> texts;
  for (const auto& numbers : there) texts.push_back(text_of(numbers));
  for (const auto& text : all.exchanged(std::move(texts))) received_.push_back(values_of<std::uint32_t>(text));
}

void SumByOwners::add(Forces& forces) const {
  std::vector<std::string> texts;
  for (const auto& points : sent_) {
    std::vector<double> values;
    values.reserve(unknowns_per_point * points.size());
    for (const auto k : points)
      for (Eigen::Index c = 0; c < unknowns_per_point; ++c) values.push_back(forces(c, k));
    texts.push_back(text_of(values));
    for (const auto k : points) forces.col(k).setZero();
  }
  const auto found = all_.exchanged(std::move(texts));
  for (std::size_t from = 0; from < found.size(); ++from) {
    const auto values = values_of<double>(found[from]);
    for (std::size_t i = 0; i < received_[from].size(); ++i)
      for (std::size_t c = 0; c < unknowns_per_point; ++c)
        forces(Eigen::Index(c), received_[from][i]) += values[index_by_points(i, c)];
  }
}

namespace {

constexpr int sweeps = 2;      // before and after
constexpr double share = 1.5;  // weight of a sweep times the largest eigenvalue

}  // namespace

LevelTransfer<double> transfer_to(const std::vector<geometry::Point>& seen, const geometry::Tessellation& coarse,
                                  const std::vector<char>& own) {
  const geometry::CellLocator locate(coarse);
  std::vector<geometry::CellLocator::Found> found(seen.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (own.empty() || own[k]) found[k] = locate(seen[k], seen[k]);
  LevelTransfer<double> result;
  result.first.push_back(0);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    for (std::size_t i = 0; i < found[k].count; ++i) {
      const double weight = found[k].weights[i];
      if (std::abs(weight) < 1e-5) continue;  // what a face point is seen beside it
      const geometry::Point lever = weight / 2 * (seen[k] - coarse.positions[found[k].points[i]]);
      result.shares.push_back({found[k].points[i], weight, lever.x(), lever.y()});
    }
    result.first.push_back(result.shares.size());
  }
  return result;
}

GalerkinMultigrid::GalerkinMultigrid(const GalerkinOperator& plate, const Constraints& constraints,
                                     const std::vector<geometry::Point>& seen, std::vector<MultigridLevel> coarser)
    : coarser_(std::move(coarser)) {
  for (std::size_t level = 0; level < coarser_.size(); ++level) {
    const auto& finer = level == 0 ? plate : coarser_[level - 1].plate;
    const auto& held = level == 0 ? constraints : coarser_[level - 1].boundary.constraints;
    Sweeps s{&finer, &held, folded_diagonal(finer, held), {}, {}, {}, {}, {}, {}};
    const double step = stable_time_step(finer, held, s.inverse_diagonal);
    s.inverse_diagonal =
        s.inverse_diagonal.unaryExpr([&](double d) { return d > 0 ? share * step * step / 4 / d : 0; });
    s.from_coarser = coarser_[level].sum
                         ? std::move(coarser_[level].to_finer)
                         : transfer_to(level == 0 ? seen : coarser_[level - 1].seen, coarser_[level].cells);
    s.to_coarser = s.from_coarser.transposed(coarser_[level].plate.points());
    sweeps_.push_back(std::move(s));
  }
  const auto& [cells, beside, boundary, last, to_finer, sum] = coarser_.back();
  if (boundary.map.distributed())
    last_ = std::make_unique<DistributedFactor>(last, boundary, stiffness_matrix(last));
  else
    last_ = std::make_unique<AssembledPlate>(last, boundary.constraints, stiffness_matrix(last));
}

void GalerkinMultigrid::cycle(std::size_t level, const Forces& residual, State& result) const {
  if (level == sweeps_.size()) {
    last_->apply(residual, result);
    return;
  }
  const Sweeps& s = sweeps_[level];
  const auto find_rest = [&] {  // residual - K result
    s.constraints->impose(result);
    s.plate->internal_force(result, s.product);
    s.constraints->fold(s.product);
    s.rest = residual + s.product;
  };
  result = s.inverse_diagonal.cwiseProduct(residual);
  for (int i = 1; i < sweeps; ++i) {
    find_rest();
    result += s.inverse_diagonal.cwiseProduct(s.rest);
  }
  find_rest();
  const auto& coarse_level = coarser_[level];
  const auto coarse_points = Eigen::Index(coarse_level.plate.points());
  s.coarse_force.resize(unknowns_per_point, coarse_points);
#pragma omp parallel for schedule(static)
  for (Eigen::Index i = 0; i < coarse_points; ++i) {
    PointValues sum(0, 0, 0);
    for (auto n = s.to_coarser.first[std::size_t(i)]; n < s.to_coarser.first[std::size_t(i) + 1]; ++n) {
      const auto& share = s.to_coarser.shares[n];
      const double force = s.rest(0, share.other);  // psi = (-theta_y, theta_x)
      sum += PointValues(share.weight * force, share.weight * s.rest(1, share.other) + share.y * force,
                         share.weight * s.rest(2, share.other) - share.x * force);
    }
    s.coarse_force.col(i) = sum;
  }
  if (coarse_level.sum) coarse_level.sum->add(s.coarse_force);
  coarse_level.boundary.constraints.fold(s.coarse_force);
  cycle(level + 1, s.coarse_force, s.coarse);
  coarse_level.boundary.constraints.impose(s.coarse);
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < result.cols(); ++k)
    for (auto n = s.from_coarser.first[std::size_t(k)]; n < s.from_coarser.first[std::size_t(k) + 1]; ++n) {
      const auto& share = s.from_coarser.shares[n];
      const PointValues u = s.coarse.col(share.other);
      result(0, k) += share.weight * u[0] + share.y * u[1] - share.x * u[2];
      result(1, k) += share.weight * u[1];
      result(2, k) += share.weight * u[2];
    }
  for (int i = 0; i < sweeps; ++i) {
    find_rest();
    result += s.inverse_diagonal.cwiseProduct(s.rest);
  }
}

void GalerkinMultigrid::apply(const Forces& residual, State& result) const {
  cycle(0, residual, result);
}

std::size_t GalerkinMultigrid::bytes() const {
  std::size_t sum = last_->bytes();
  for (const auto& level : coarser_)
    sum +=
        level.plate.bytes() + level.plate.families().families.bytes() + level.seen.size() * 2 * sizeof(geometry::Point);
  for (const auto& s : sweeps_)
    sum += 2 * s.from_coarser.shares.size() * sizeof(LevelTransfer<double>::Share) + 6 * s.rest.size() * sizeof(double);
  return sum;
}

namespace {

/// Part of a multigrid level that a rank needs for itself and for its points of a finer plate, of which `own`
/// interpolate from the level.
class DistributedMultigridLevel {
public:
  DistributedMultigridLevel(const Communicator& all, const Problem& problem, GlobalCells whole,
                            const std::vector<geometry::Point>& seen, const std::vector<char>& own)
      : problem_(problem) {
    inside_ = about_first_inside(whole);
    const auto besides = box_of(whole, seen, own);
    const auto here = cells_with_overlap(all, problem, whole, {}, besides);
    const auto& cells = here.cells;
    to_finer_ = transfer_to(seen, cells, own);
    std::vector<char> asked(cells.positions.size(), 0);
    for (const auto& share : to_finer_.shares) asked[share.other] = 1;
    auto boundary = galerkin_boundary(cells, areas_of(cells), geometry::to_lattice(problem.outline, cells.units),
                                      problem.supports, {}, {&all}, problem.section.law);
    boundary.elastic_supports = elastic_supports_of(problem, cells);
    part_ = part_of_cells(all, problem, here, boundary.elastic_supports, {}, asked);
    boundary_ = restricted(boundary, part_, 0);
    const auto& number = part_.part.number;
    for (auto& share : to_finer_.shares)
      share.other = std::uint32_t(std::ranges::lower_bound(number, share.other) - number.begin());
    sum_ = std::make_shared<SumByOwners>(all, std::move(part_.copies));
  }

  /// Asks no other rank; absent where cracks, edges and supports have no room for such points.
  std::optional<MultigridLevel> level() && try {
    auto& cells = part_.part.cells;
    auto beside = geometry::positions_inside_faces(cells);
    GalerkinOperator plate(galerkin_families(cells, inside_), PointSections(problem_.section, cells),
                           boundary_.elastic_supports, part_.column_block);
    return MultigridLevel{std::move(cells), std::move(beside),    std::move(boundary_),
                          std::move(plate), std::move(to_finer_), std::move(sum_)};
  } catch (const Refused&) {
    return std::nullopt;
  }

private:
  /// The cells about the finer points that take from these.
  static std::optional<geometry::CellBox> box_of(const GlobalCells& whole, const std::vector<geometry::Point>& seen,
                                                 const std::vector<char>& own) {
    const auto* lattice = std::get_if<geometry::GlobalLattice>(&whole);
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
  LevelTransfer<double> to_finer_;
  PartOfCells part_;
  Boundary boundary_;
  std::shared_ptr<const SumByOwners> sum_;
};

/// Throws Refused where cracks, edges and supports have no room for such points.
MultigridLevel global_level(const Problem& c, geometry::Tessellation cells) {
  auto families = galerkin_families(cells);
  auto boundary = galerkin_boundary(cells, families.areas, geometry::to_lattice(c.outline, cells.units), c.supports, {},
                                    {}, c.section.law);
  auto seen = geometry::positions_inside_faces(cells);
  auto elastic_supports = elastic_supports_of(c, cells);
  PointSections sections(c.section, cells);
  return MultigridLevel{std::move(cells), std::move(seen), std::move(boundary),
                        GalerkinOperator(std::move(families), std::move(sections), std::move(elastic_supports))};
}

}  // namespace

std::size_t points_of_all(const Boundary& boundary) {
  const auto& owned = boundary.map.owned;
  const auto here = owned.empty() ? std::ptrdiff_t(boundary.cloud.plate_points) : std::ranges::count(owned, char(1));
  return std::size_t(sum_of_all(boundary.map, double(here)));
}

std::vector<MultigridLevel> multigrid_levels(const Formulation& plate, const std::vector<geometry::Point>& seen) {
  const Communicator& all = plate.communicator();
  const Problem& c = plate.problem();
  constexpr std::size_t few = 4000;  // points; their factor costs some ten products of a hundred thousand points
  const auto [low, high] = geometry::bounding_box(c.outline);
  std::vector<MultigridLevel> result;
  std::size_t points = points_of_all(plate.boundary());
  for (double factor = 2; points > few && factor * c.discretization.spacing <= (high - low).minCoeff() / 8;
       factor *= 2) {
    try {
      auto found = possible_cells(c, plate.paths(), factor, all.distributed());
      auto* const cells = std::get_if<GlobalCells>(&found);
      if (!cells) break;  // on every rank: cracks and edges are too close to each other for such points
      points = points_of(*cells);
      const bool first = result.empty();
      auto level = all.distributed() ? DistributedMultigridLevel(
                                           all, c, std::move(*cells), first ? seen : result.back().seen,
                                           first ? plate.boundary().map.owned : result.back().boundary.map.owned)
                                           .level()
                                     : global_level(c, std::get<geometry::Tessellation>(std::move(*cells)));
      if (largest_of(all, level ? 0 : 1) > 0) break;
      if (pieces(level->boundary, level->plate.families().families).size() != plate.pieces().size()) break;
      result.push_back(std::move(*level));
    } catch (const Refused&) {
      break;  // on every rank: a part that is held has none of them, or a rank would
    }
  }
  return result;
}

}  // namespace plate
