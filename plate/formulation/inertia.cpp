#include "plate/formulation/inertia.hpp"

#include "geometry/cells/tessellation.hpp"
#include "plate/model/space.hpp"

#include <array>

namespace plate {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

double area_of(const geometry::Tessellation& cells, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const geometry::Point x = cells.local[b] - cells.local[a], y = cells.local[c] - cells.local[a];
  return (x.x() * y.y() - x.y() * y.x()) / 2;
}

/// Integrals of products of the linear functions of triangles and the bilinear ones of squares, in every cell times the
/// mean of the weights of its points.
template <typename Weight>
Triplets products(const geometry::Tessellation& cells, const Weight& weight) {
  Triplets entries;
  const auto mean = [&](const auto& cell) {
    double sum = 0;
    for (const auto k : cell) sum += weight(k);
    return sum / double(cell.size());
  };
  for (const auto& cell : cells.triangles) {
    const double part = mean(cell) * area_of(cells, cell[0], cell[1], cell[2]) / 12;
    for (const auto i : cell)
      for (const auto j : cell) entries.emplace_back(int(i), int(j), i == j ? 2 * part : part);
  }
  constexpr std::array<double, 3> apart{4, 2, 1};  // the same corner, along an edge, across
  for (const auto& cell : cells.squares) {
    const double part = mean(cell) * 2 * area_of(cells, cell[0], cell[1], cell[2]) / 36;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const std::size_t steps = (j + 4 - i) % 4;
        entries.emplace_back(int(cell[i]), int(cell[j]), part * apart[steps == 3 ? 1 : steps]);
      }
  }
  return entries;
}

/// Entries of P^T M P between two leaders of a point, both of one component, on each of the two.
Forces between_leaders(const Forces& mass, const Constraints& constraints) {
  Forces result = zero_forces(std::size_t(mass.cols()));
  const auto& ties = constraints.ties();
  for (std::size_t i = 0; i < ties.size(); ++i)
    for (std::size_t j = i + 1; j < ties.size() && ties[j].follower == ties[i].follower; ++j) {
      if (ties[i].leader.component != ties[j].leader.component) continue;
      const double shared = at_dof(mass, ties[i].follower) * ties[i].factor * ties[j].factor;
      at_dof(result, ties[i].leader) += shared, at_dof(result, ties[j].leader) += shared;
    }
  return result;
}

}  // namespace

Forces mass(const PointSections& sections, const std::vector<double>& areas, const std::vector<char>& active,
            const Constraints& constraints, double rotary) {
  Forces result = zero_forces(areas.size());
  for (std::size_t k = 0; k < areas.size(); ++k) {
    const double translation = sections[k].mass, rotation = rotary * sections[k].rotary;
    if (active[k])
      result.col(static_cast<Eigen::Index>(k)) << translation * areas[k], rotation * areas[k], rotation * areas[k];
  }
  constraints.fold_diagonal(result);
  return result;
}

Forces whole_mass(Forces mass, const Constraints& constraints) {
  const Forces shared = between_leaders(mass, constraints);
  constraints.fold_diagonal(mass);
  return mass + shared;
}

Inertia::Inertia(const PointSections& sections, const geometry::Tessellation& cells, const Constraints& constraints,
                 double rotary)
    : translation_(1), rotation_(rotary), constraints_(&constraints) {
  const auto fill = [&](Products& matrix, const auto& weight) {
    const auto points = Eigen::Index(cells.positions.size());
    const auto entries = products(cells, weight);
    matrix.resize(points, points);
    matrix.setFromTriplets(entries.begin(), entries.end());
  };
  if (sections.uniform()) {
    translation_ = sections[0].mass, rotation_ = rotary * sections[0].rotary;
    fill(areas_, [](std::uint32_t) { return 1.0; });
  } else {
    fill(areas_, [&](std::uint32_t k) { return sections[k].mass; });
    fill(rotary_areas_, [&](std::uint32_t k) { return sections[k].rotary; });
  }
}

Forces Inertia::operator()(const State& state) const {
  if (!constraints_) return diagonal_.cwiseProduct(state);
  Forces result = whole(state);
  constraints_->fold(result);
  return result;
}

Forces Inertia::whole(const State& state) const {
  Forces result(unknowns_per_point, state.cols());
  if (areas_.rows() == state.size()) {
    Eigen::Map<Eigen::VectorXd>(result.data(), result.size()) =
        areas_ * Eigen::Map<const Eigen::VectorXd>(state.data(), state.size());
    return result;
  }
  for (Eigen::Index i = 0; i < unknowns_per_point; ++i) {
    const auto& areas = i == 0 || rotary_areas_.size() == 0 ? areas_ : rotary_areas_;
    result.row(i) = (i == 0 ? translation_ : rotation_) * (areas * state.row(i).transpose()).transpose();
  }
  return result;
}

}  // namespace plate
