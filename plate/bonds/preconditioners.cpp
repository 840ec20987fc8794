#include "plate/bonds/preconditioners.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "plate/bonds/family_weights.hpp"
#include "plate/bonds/rows/lattice_operator.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/matrices/factor.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {
namespace {

constexpr double sweep = 0.6;  // weight of a Jacobi sweep
constexpr double reach = 1.5;  // horizon of the short-horizon plate, in spacings

/// A section whose bond-based plate (Poisson's ratio 1/3, no dilatation) comes nearest to the one given: D (1 + nu) and
/// D (1 - nu) met in the geometric mean, the same shear stiffness; of a membrane its own D.
Section bond_based(const Section& s) {
  Section result = s;
  result.poisson = 1.0 / 3;
  const double D =
      s.bending_stiffness() * std::sqrt((1 - s.poisson * s.poisson) / (1 - result.poisson * result.poisson));
  if (s.law == PlateLaw::membrane) {
    result.young = D * (1 - result.poisson * result.poisson) / s.thickness;
    return result;
  }
  result.young = 12 * D * (1 - result.poisson * result.poisson) / std::pow(s.thickness, 3);
  result.shear_correction *= s.shear_stiffness() / result.shear_stiffness();
  return result;
}

}  // namespace

FamilyOperator local_operator(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                              const Discretization& discretization) {
  auto families = geometry::without(plate.families(), [&](std::uint32_t k, std::uint32_t j) {
    return (boundary.lattice[k] - boundary.lattice[j]).norm() > reach;
  });
  Discretization full_cells = discretization;
  full_cells.volume_correction = VolumeCorrection::none;
  auto shapes = bond_shapes(families.vectors(), section, full_cells);
  const auto& areas = boundary.cloud.areas;
  const auto kinds = family_kinds(families, areas, boundary.active);
  auto weights = position_aware(families, shapes, areas, boundary.active, kinds, bond_based(section)).weights;
  FamilyOperator result(std::move(families), std::move(shapes), areas, std::move(weights));
  result.set_elastic_supports(plate.elastic_supports());
  return result;
}

ShortHorizonPreconditioner::ShortHorizonPreconditioner(const FamilyOperator& plate, const Boundary& boundary,
                                                       const Section& section, const Discretization& discretization,
                                                       const Forces& added)
    : plate_(plate, plate.elastic_supports(), everywhere(plate.elastic_supports())),
      constraints_(boundary.constraints) {
  const Forces diagonal = folded_diagonal(plate, constraints_);
  inverse_diagonal_ = diagonal.unaryExpr([](double d) { return d > 0 ? sweep / d : 0.0; });
  const FamilyOperator local = local_operator(plate, boundary, section, discretization);
  const Forces both = folded_diagonal(local, constraints_).cwiseMin(diagonal);
  PointMatrix stiffness = stiffness_matrix(local, false);
  if (added.size() > 0) stiffness = plus(std::move(stiffness), added);
  const PointMatrix matrix = folded(std::move(stiffness), constraints_);
  unknowns_ = unknowns(both, elimination_order(matrix, both));
  factor_ = factorised(of_unknowns(matrix, unknowns_));
}

void ShortHorizonPreconditioner::apply(const Forces& residual, State& result) const {
  const auto subtract_product = [&](State& direction) {  // rest = residual - K direction
    constraints_.impose(direction);
    plate_.internal_force(direction, product_);
    constraints_.fold(product_);
    rest_ = residual + product_;
  };
  result = inverse_diagonal_.cwiseProduct(residual);
  subtract_product(result);
  const Eigen::MatrixXd local = factor_->solve(gathered(unknowns_, rest_));
  for (Eigen::Index u = 0; u < local.rows(); ++u) at_dof(result, unknowns_.dof[std::size_t(u)]) += local(u, 0);
  subtract_product(result);
  result += inverse_diagonal_.cwiseProduct(rest_);
}

namespace {

using geometry::Point;

struct Source {
  std::uint32_t coarse;
  double weight;
  Point away;  // from it to the point [length]
};

/// Weights with sum 1, and the lever that the rotations have: half the distance where the weights are balanced, which
/// is exact for quadratic deflections, all of it where they are not, which is exact for rigid motions.
void normalise(std::vector<Source>& sources, double spacing) {
  double sum = 0;
  Point mean(0, 0);
  for (const auto& s : sources) sum += s.weight;
  for (auto& s : sources) s.weight /= sum, mean += s.weight * s.away;
  const double lever = mean.norm() < 1e-9 * spacing ? 0.5 : 1;
  for (auto& s : sources) s.away *= lever;
}

}  // namespace

Transfer::Transfer(const geometry::Families& families, const Boundary& boundary) {
  constexpr std::uint32_t none = std::uint32_t(-1);
  const std::size_t points = families.points();
  const auto cell = [&](std::size_t k) {
    return Cell{std::int32_t(std::floor(boundary.lattice[k].x())), std::int32_t(std::floor(boundary.lattice[k].y()))};
  };
  const auto even = [](std::int32_t i) { return i % 2 == 0; };
  std::vector<std::uint32_t> coarse_of(points, none);
  for (std::size_t k = 0; k < boundary.cloud.plate_points; ++k)
    if (const Cell c = cell(k); even(c.column) && even(c.row)) {
      coarse_of[k] = std::uint32_t(cell_.size());
      cell_.push_back({c.column / 2, c.row / 2});
      fine_point_.push_back(std::uint32_t(k));
    }
  fine_.first.assign(points + 1, 0);
  std::vector<Source> sources;
  for (std::size_t k = 0; k < points; ++k) {
    sources.clear();
    const Cell own = cell(k);
    const auto add = [&](std::uint32_t c) {
      const Cell other = cell(c);
      const int columns = std::abs(other.column - own.column), rows = std::abs(other.row - own.row);
      if (coarse_of[c] == none || columns > 1 || rows > 1) return;
      sources.push_back({coarse_of[c], (columns ? 0.5 : 1) * (rows ? 0.5 : 1),
                         boundary.cloud.positions[k] - boundary.cloud.positions[c]});
    };
    if (boundary.is_plate(std::uint32_t(k))) {
      add(std::uint32_t(k));
      if (coarse_of[k] == none)
        for (const auto& bond : families[k]) add(bond.neighbour);
    }
    if (!sources.empty()) normalise(sources, boundary.cloud.units.spacing);
    for (const auto& s : sources)
      fine_.shares.push_back({s.coarse, float(s.weight), float(s.weight * s.away.x()), float(s.weight * s.away.y())});
    fine_.first[k + 1] = fine_.shares.size();
  }
  coarse_ = fine_.transposed(cell_.size());
}

// w = sum weight w_c - x theta_y + y theta_x: no shear strain between the points
void Transfer::prolong(const State& coarse, State& fine) const {
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < fine_.first.size() - 1; ++k) {
    PointValues sum = PointValues::Zero();
    for (auto i = fine_.first[k]; i < fine_.first[k + 1]; ++i) {
      const auto& s = fine_.shares[i];
      const auto u = coarse.col(Eigen::Index(s.other));
      const double weight = s.weight;
      sum += PointValues(weight * u[0] + s.y * u[1] - s.x * u[2], weight * u[1], weight * u[2]);
    }
    fine.col(Eigen::Index(k)) += sum;
  }
}

void Transfer::restrict_to(State& coarse, const Forces& fine) const {
  coarse.resize(unknowns_per_point, Eigen::Index(coarse_points()));
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < coarse_points(); ++c) {
    PointValues sum = PointValues::Zero();
    for (auto i = coarse_.first[c]; i < coarse_.first[c + 1]; ++i) {
      const auto& s = coarse_.shares[i];
      const auto f = fine.col(Eigen::Index(s.other));
      const double weight = s.weight;
      sum += PointValues(weight * f[0], weight * f[1] + s.y * f[0], weight * f[2] - s.x * f[0]);
    }
    coarse.col(Eigen::Index(c)) = sum;
  }
}

namespace {

int remainder(std::int32_t i) {
  return ((i % coarse_window) + coarse_window) % coarse_window;
}

}  // namespace

CoarseCells::CoarseCells(const std::vector<Transfer::Cell>& cells) {
  if (!cells.empty()) low_ = high_ = cells.front();
  for (const auto& c : cells) {
    low_.column = std::min(low_.column, c.column), low_.row = std::min(low_.row, c.row);
    high_.column = std::max(high_.column, c.column), high_.row = std::max(high_.row, c.row);
  }
  point_.assign(std::size_t(width()) * std::size_t(high_.row - low_.row + 1), -1);
  for (std::size_t i = 0; i < cells.size(); ++i) point_[index(cells[i])] = std::int32_t(i);
}

std::int32_t CoarseCells::at(const Transfer::Cell& c) const {
  const bool inside = c.column >= low_.column && c.column <= high_.column && c.row >= low_.row && c.row <= high_.row;
  return inside ? point_[index(c)] : -1;
}

void for_each_coarse_column(const Operator& L, const Transfer& transfer, const Constraints& constraints,
                            const CoarseCells& index, const CoarseVisit& visit) {
  const auto& cells = transfer.cells();
  const auto coarse_points = std::uint32_t(cells.size());
  State coarse(unknowns_per_point, Eigen::Index(coarse_points)), fine(unknowns_per_point, Eigen::Index(L.points()));
  Forces force;
  for (int color = 0; color < coarse_window * coarse_window; ++color)
    for (int component = 0; component < unknowns_per_point; ++component) {
      const int column = color % coarse_window, row = color / coarse_window;
      coarse.setZero(), fine.setZero();
      for (std::uint32_t i = 0; i < coarse_points; ++i)
        if (remainder(cells[i].column) == column && remainder(cells[i].row) == row)
          coarse(component, Eigen::Index(i)) = 1;
      transfer.prolong(coarse, fine);
      constraints.impose(fine);
      L.internal_force(fine, force);
      constraints.fold(force);
      constraints.fetch(force);
      transfer.restrict_to(coarse, force);
#pragma omp parallel for schedule(static)
      for (std::uint32_t i = 0; i < coarse_points; ++i) {
        // the point of this color in the window about i
        const auto& c = cells[i];
        const int x = remainder(column - c.column + coarse_window / 2) - coarse_window / 2,
                  y = remainder(row - c.row + coarse_window / 2) - coarse_window / 2;
        if (const auto j = index.at({c.column + x, c.row + y}); j >= 0)
          visit(i, std::uint32_t(j), component, -coarse.col(Eigen::Index(i)));
      }
    }
}

namespace {

/// A matrix of zeros that couples every coarse point to those in the window about it.
PointMatrix zeros(const std::vector<Transfer::Cell>& cells, const CoarseCells& index) {
  PointMatrix result;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto begin = std::ptrdiff_t(result.row.size());
    for (int y = -coarse_window / 2; y <= coarse_window / 2; ++y)
      for (int x = -coarse_window / 2; x <= coarse_window / 2; ++x)
        if (const auto j = index.at({cells[i].column + x, cells[i].row + y}); j >= std::int32_t(i))
          result.row.push_back(std::uint32_t(j));
    std::sort(result.row.begin() + begin, result.row.end());
    result.first.push_back(result.row.size());
  }
  result.block.assign(result.row.size(), Eigen::Matrix3d::Zero());
  return result;
}

Forces diagonal_of(const PointMatrix& matrix) {
  Forces result(unknowns_per_point, Eigen::Index(matrix.points()));
  for (std::size_t k = 0; k < matrix.points(); ++k)
    result.col(Eigen::Index(k)) = matrix.block[matrix.first[k]].diagonal();
  return result;
}

/// The lower triangle of R L R^T.
PointMatrix coarse_stiffness(const Operator& L, const Transfer& transfer, const Constraints& constraints) {
  const CoarseCells index(transfer.cells());
  PointMatrix result = zeros(transfer.cells(), index);
  for_each_coarse_column(L, transfer, constraints, index,
                         [&](std::uint32_t i, std::uint32_t j, int component, const PointValues& K_ij) {
                           if (j < i) return;  // what j has of i, i has of j
                           const auto begin = result.row.begin() + std::ptrdiff_t(result.first[i]),
                                      end = result.row.begin() + std::ptrdiff_t(result.first[i + 1]);
                           const auto at = std::lower_bound(begin, end, j) - result.row.begin();
                           result.block[std::size_t(at)].row(component) = K_ij.transpose();
                         });
  return without_rounding(result);
}

class FactorisedCoarsePlate : public CoarsePlate {
public:
  explicit FactorisedCoarsePlate(const PointMatrix& matrix) {
    const Forces diagonal = diagonal_of(matrix);
    unknowns_ = unknowns(diagonal, elimination_order(matrix, diagonal));
    factor_ = factorised(of_unknowns(matrix, unknowns_));
  }

  void solve(const Forces& force, State& u) const override {
    const Eigen::MatrixXd solution = factor_->solve(plate::gathered(unknowns_, force));
    u.setZero(force.rows(), force.cols());
    for (Eigen::Index i = 0; i < solution.rows(); ++i) at_dof(u, unknowns_.dof[std::size_t(i)]) = solution(i, 0);
  }
  std::size_t bytes() const override { return factor_->bytes(); }

private:
  Unknowns unknowns_;
  std::unique_ptr<Factor> factor_;
};

class DistributedCoarsePlate : public CoarsePlate {
public:
  DistributedCoarsePlate(const Operator& L, const Transfer& transfer, const Boundary& boundary)
      : constraints_(boundary.constraints),
        points_(Eigen::Index(boundary.cloud.size())),
        fine_(transfer.fine_points()) {
    for (std::uint32_t i = 0; i < fine_.size(); ++i)
      if (boundary.owns(fine_[i])) own_.push_back(i);
    inverse_ = boundary.map.communicator->inverse(rows(L, transfer, boundary, numbers(boundary.map)));
  }

  void solve(const Forces& force, State& u) const override {
    std::vector<double> values;
    values.reserve(unknowns_per_point * own_.size());
    for (const auto i : own_)
      for (Eigen::Index c = 0; c < unknowns_per_point; ++c) values.push_back(force(c, Eigen::Index(i)));
    inverse_->apply(values);
    u.setZero(force.rows(), force.cols());
    for (std::size_t n = 0; n < own_.size(); ++n)
      for (Eigen::Index c = 0; c < unknowns_per_point; ++c) u(c, Eigen::Index(own_[n])) = values[index_by_points(n, c)];
    fetch(u);
  }
  std::size_t bytes() const override { return 0; }  // the libraries behind it do not say

private:
  /// Fetches the values of ghosts of the coarse plate through their points of the fine one.
  void fetch(State& coarse) const {
    State fine = zero_state(points_);
    for (std::size_t i = 0; i < fine_.size(); ++i) fine.col(fine_[i]) = coarse.col(Eigen::Index(i));
    constraints_.fetch(fine);
    for (std::size_t i = 0; i < fine_.size(); ++i) coarse.col(Eigen::Index(i)) = fine.col(fine_[i]);
  }

  /// Global numbers of all coarse points seen on this rank; -1 where their owner is not asked.
  std::vector<std::int64_t> numbers(const PointMap& map) const {
    const auto counts = gathered(map, std::vector<std::int64_t>{std::int64_t(own_.size())});
    const auto before = std::accumulate(counts.begin(), counts.begin() + map.rank(), std::int64_t(0));
    std::vector<std::int64_t> fine(std::size_t(points_), 0);
    for (const auto k : fine_) fine[k] = -1;
    for (std::size_t n = 0; n < own_.size(); ++n) fine[fine_[own_[n]]] = before + std::int64_t(n);
    constraints_.fetch(fine);
    std::vector<std::int64_t> result;
    for (const auto k : fine_) result.push_back(fine[k]);
    return result;
  }

  DistributedRows rows(const Operator& L, const Transfer& transfer, const Boundary& boundary,
                       const std::vector<std::int64_t>& number) const {
    constexpr std::size_t most = coarse_window * coarse_window;
    constexpr double rounding = 1e-12;
    struct Block {
      std::int64_t column = -1;
      std::array<double, 9> entries{};
      double largest() const {
        return std::abs(*std::ranges::max_element(entries, {}, [](double value) { return std::abs(value); }));
      }
    };
    std::vector<std::array<Block, most>> found(own_.size());
    std::vector<std::int32_t> place(fine_.size(), -1);
    for (std::size_t n = 0; n < own_.size(); ++n) place[own_[n]] = std::int32_t(n);
    const auto& cells = transfer.cells();
    for_each_coarse_column(L, transfer, constraints_, CoarseCells(cells),
                           [&](std::uint32_t i, std::uint32_t j, int component, const PointValues& K_ij) {
                             if (place[i] < 0) return;
                             const auto x = cells[j].column - cells[i].column, y = cells[j].row - cells[i].row;
                             const auto half = coarse_window / 2;
                             auto& block =
                                 found[std::size_t(place[i])][std::size_t((y + half) * coarse_window + x + half)];
                             block.column = number[j];
                             for (int c = 0; c < unknowns_per_point; ++c)
                               block.entries[std::size_t(unknowns_per_point * c + component)] = K_ij[c];
                           });
    DistributedRows result;
    for (std::size_t n = 0; n < own_.size(); ++n) {
      auto& blocks = found[n];
      std::ranges::sort(blocks, {}, &Block::column);
      double largest = 0;
      for (const auto& block : blocks) largest = std::max(largest, block.largest());
      for (const auto& block : blocks) {
        if (block.largest() <= rounding * largest) continue;
        if (block.column < 0) throw std::logic_error("a coarse point is coupled to one whose owner nobody asks");
        result.column.push_back(block.column);
        result.block.insert(result.block.end(), block.entries.begin(), block.entries.end());
      }
      result.first.push_back(result.column.size());
      const auto& x = boundary.cloud.positions[fine_[own_[n]]];
      result.position.insert(result.position.end(), {x.x(), x.y()});
    }
    return result;
  }

  const Constraints& constraints_;
  Eigen::Index points_;
  std::vector<std::uint32_t> fine_;  // the point of the plate that each coarse one is
  std::vector<std::uint32_t> own_;   // coarse owned points
  std::unique_ptr<DistributedInverse> inverse_;
};

constexpr int sweeps = 2;       // before and after
constexpr double weight = 0.6;  // of a sweep

}  // namespace

std::unique_ptr<CoarsePlate> coarse_plate(const Operator& L, const Transfer& transfer, const Boundary& boundary) {
  if (boundary.map.distributed()) return std::make_unique<DistributedCoarsePlate>(L, transfer, boundary);
  return std::make_unique<FactorisedCoarsePlate>(coarse_stiffness(L, transfer, boundary.constraints));
}

TwoLevelPreconditioner::TwoLevelPreconditioner(const FamilyOperator& plate, const Boundary& boundary,
                                               const Section& section, const Discretization& discretization)
    : plate_(plate, plate.elastic_supports(), everywhere(plate.elastic_supports())),
      constraints_(boundary.constraints),
      transfer_(plate.families(), boundary) {
  const Forces diagonal = folded_diagonal(plate, constraints_);
  inverse_diagonal_ = diagonal.unaryExpr([](double d) { return d > 0 ? weight / d : 0.0; });
  const LatticeOperator local(local_operator(plate, boundary, section, discretization));
  const PlateInContact touched(local, local.elastic_supports(), everywhere(local.elastic_supports()));
  coarse_plate_ = coarse_plate(touched, transfer_, boundary);
}

void TwoLevelPreconditioner::apply(const Forces& residual, State& result) const {
  const auto subtract_product = [&] {  // rest = residual - K result
    constraints_.impose(result);
    plate_.internal_force(result, product_);
    constraints_.fold(product_);
    rest_ = residual + product_;
  };
  result = inverse_diagonal_.cwiseProduct(residual);
  for (int i = 1; i < sweeps; ++i) {
    subtract_product();
    result += inverse_diagonal_.cwiseProduct(rest_);
  }
  subtract_product();
  constraints_.fetch(rest_);
  transfer_.restrict_to(coarse_force_, rest_);
  coarse_plate_->solve(coarse_force_, coarse_);
  transfer_.prolong(coarse_, result);
  for (int i = 0; i < sweeps; ++i) {
    subtract_product();
    result += inverse_diagonal_.cwiseProduct(rest_);
  }
}

}  // namespace plate
