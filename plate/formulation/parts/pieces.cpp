#include "plate/formulation/parts/pieces.hpp"

#include <algorithm>
#include <map>

#include "plate/formulation/parts/disjoint_sets.hpp"
#include "plate/model/algebra/dense.hpp"

namespace plate {
namespace {

/// The three rigid motions at one degree of freedom: w = 1; w = x, theta_y = -1; w = y, theta_x = 1.
Eigen::Vector3d rigid(std::uint32_t dof, const geometry::Point& x) {
  switch (dof % 3) {
    case 0:
      return {1, x.x(), x.y()};
    case 1:
      return {0, 0, 1};
    default:
      return {0, -1, 0};
  }
}

DisjointSets connected(const Boundary& boundary, const geometry::Families& families) {
  DisjointSets sets(families.points());
  for (std::uint32_t k = 0; k < families.points(); ++k)
    for (const auto& bond : families[k])
      if (bond.neighbour < k) sets.join(k, bond.neighbour);
  for (const auto& tie : boundary.constraints.ties()) sets.join(tie.follower / 3, tie.leader / 3);
  return sets;
}

/// What foundations and springs have against the rigid motions of every piece, over the largest entry. A link between
/// two pieces holds neither: of those, rounding is left.
template <typename Rows>
std::map<std::uint32_t, Eigen::Matrix3d> elastic(const Boundary& boundary, DisjointSets& sets, const Rows& at) {
  constexpr double rounding = 1e-11;
  std::map<std::uint32_t, Eigen::Matrix3d> result, sizes;
  const double spacing = boundary.cloud.units.spacing;
  const auto length = [&](std::uint32_t dof) { return dof % 3 == 0 ? spacing : 1; };
  for (const auto& part : boundary.attached.parts())
    part->for_each([&](std::uint32_t row, std::uint32_t column, double value) {
      const auto root = sets.root(row / 3);
      const bool within = root == sets.root(column / 3);
      const Eigen::Matrix3d one =
          value * length(row) * length(column) * at(row) * at(within ? column : row).transpose();
      result.try_emplace(root, Eigen::Matrix3d::Zero()).first->second += one;
      sizes.try_emplace(root, Eigen::Matrix3d::Zero()).first->second += one.cwiseAbs();
    });
  for (auto& [root, own] : result) {
    const double largest = own.cwiseAbs().maxCoeff();
    if (largest > rounding * sizes.at(root).maxCoeff())
      own /= largest;
    else
      own.setZero();
  }
  return result;
}

}  // namespace

std::vector<std::uint32_t> fallen(const Boundary& boundary, const geometry::Families& families) {
  const auto all = pieces(boundary, families);
  auto sets = connected(boundary, families);
  std::vector<std::uint32_t> off;  // roots
  const bool held = std::ranges::any_of(all, [](const Piece& piece) { return piece.free_modes < 3; });
  for (std::size_t i = held ? 0 : 1; i < all.size(); ++i)
    if (all[i].free_modes == 3) off.push_back(sets.root(all[i].first_point));
  std::ranges::sort(off);
  std::vector<std::uint32_t> result;
  if (off.empty()) return result;
  for (std::uint32_t k = 0; k < families.points(); ++k)
    if (std::ranges::binary_search(off, sets.root(k))) result.push_back(k);
  return result;
}

std::vector<Piece> pieces(const Boundary& boundary, const geometry::Families& families) {
  auto sets = connected(boundary, families);

  std::map<std::uint32_t, Piece> found;
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k) {
    Piece& piece = found[sets.root(k)];
    if (piece.points++ == 0) piece.position = boundary.cloud.positions[k], piece.first_point = k;
  }

  // a rigid motion survives where it meets every condition of the piece: rows of conditions, their Gram matrix
  std::map<std::uint32_t, Eigen::Matrix3d> gram;
  for (const auto& [root, piece] : found) gram[root].setZero();
  const auto add = [&](std::uint32_t dof, const Eigen::Vector3d& row) {
    if (const auto entry = gram.find(sets.root(dof / 3)); entry != gram.end()) entry->second += row * row.transpose();
  };
  const auto at = [&](std::uint32_t dof) {  // in lattice units about the piece's first point
    return rigid(dof, boundary.lattice[dof / 3] - boundary.lattice[found[sets.root(dof / 3)].first_point]);
  };
  for (const auto dof : boundary.constraints.fixed())
    if (found.contains(sets.root(dof / 3))) add(dof, at(dof));
  const auto scaled_factor = [&](const Constraints::Tie& tie) {  // w in spacings, rotations as they are
    return tie.follower % 3 == 0 && tie.leader % 3 != 0 ? tie.factor / boundary.cloud.units.spacing : tie.factor;
  };
  const auto& ties = boundary.constraints.ties();
  for (std::size_t i = 0; i < ties.size();) {
    const auto follower = ties[i].follower;
    const bool counts = found.contains(sets.root(follower / 3));
    Eigen::Vector3d row = counts ? at(follower) : Eigen::Vector3d(0, 0, 0);
    for (; i < ties.size() && ties[i].follower == follower; ++i)
      if (counts) row -= scaled_factor(ties[i]) * at(ties[i].leader);
    if (counts) add(follower, row);
  }

  for (auto& [root, own] : elastic(boundary, sets, at))
    if (found.contains(root)) gram[root] += own;

  std::vector<Piece> result;
  for (auto& [root, piece] : found) {
    // scaled to a unit diagonal, because rows in lattice units grow with the size of the plate
    const Eigen::Matrix3d& g = gram[root];
    const Eigen::Vector3d scale = g.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0; });
    const Eigenpairs eigen = eigenpairs(scale.asDiagonal() * g * scale.asDiagonal());
    piece.free_modes = static_cast<int>((eigen.values.array() < 1e-9).count());
    result.push_back(piece);
  }
  std::stable_sort(result.begin(), result.end(), [](const Piece& a, const Piece& b) { return a.points > b.points; });
  return result;
}

}  // namespace plate
