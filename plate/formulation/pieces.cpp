#include "plate/formulation/pieces.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "plate/model/dense_algebra.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

/// Numbers that stand for one set, each known by the smallest of them.
class Same {
public:
  std::int64_t first(std::int64_t a) const {
    for (auto at = smaller_.find(a); at != smaller_.end(); at = smaller_.find(a)) a = at->second;
    return a;
  }
  void join(std::int64_t a, std::int64_t b) {
    a = first(a), b = first(b);
    if (a != b) smaller_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::map<std::int64_t, std::int64_t> smaller_;
};

}  // namespace

std::vector<std::int64_t> set_numbers(DisjointSets& sets, const Boundary& boundary) {
  std::vector<std::int64_t> result(boundary.cloud.size());
  const std::int64_t begin = std::int64_t(boundary.map.rank()) << 32;
  for (std::uint32_t k = 0; k < result.size(); ++k) result[k] = begin + sets.root(k);
  auto theirs = result;
  boundary.constraints.fetch(theirs);
  std::set<std::pair<std::int64_t, std::int64_t>> joined;
  for (std::size_t k = 0; k < result.size(); ++k)
    if (theirs[k] != result[k]) joined.emplace(result[k], theirs[k]);
  std::vector<std::int64_t> own;
  for (const auto& [a, b] : joined) own.insert(own.end(), {a, b});
  Same same;
  const auto pairs = gathered(boundary.map, own);
  for (std::size_t i = 0; i < pairs.size(); i += 2) same.join(pairs[i], pairs[i + 1]);
  for (auto& number : result) number = same.first(number);
  return result;
}

namespace {

/// The three rigid motions at one degree of freedom: w = 1; w = x, theta_y = -1; w = y, theta_x = 1. In the plane,
/// where theta_x = -v and theta_y = u: u = 1; v = 1; u = -y, v = x.
Eigen::Vector3d rigid(const Dof& dof, const geometry::Point& x, PlateLaw law) {
  if (law == PlateLaw::membrane)
    return dof.component == 0   ? Eigen::Vector3d(0, 0, 0)
           : dof.component == 1 ? Eigen::Vector3d(0, -1, -x.x())
                                : Eigen::Vector3d(1, 0, -x.y());
  switch (dof.component) {
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
    for (const auto& bond : families[k])  // far from its owned points a process does not know what has broken
      if (bond.neighbour < k && (boundary.owns(k) || boundary.owns(bond.neighbour))) sets.join(k, bond.neighbour);
  for (const auto& tie : boundary.constraints.ties()) sets.join(tie.follower.point, tie.leader.point);
  boundary.elastic_supports.for_each_joined([&](std::uint32_t k, std::uint32_t j) { sets.join(k, j); });
  return sets;
}

using Grams = std::map<std::int64_t, Eigen::Matrix3d>;  // by the numbers of pieces

void share(const PointMap& map, Grams& grams) {
  struct Part {
    std::int64_t number;
    double entries[9];
  };
  std::vector<Part> own;
  for (const auto& [number, gram] : grams) {
    own.push_back({number, {}});
    Eigen::Map<Eigen::Matrix3d>(own.back().entries) = gram;
  }
  for (auto& [number, gram] : grams) gram.setZero();
  for (const auto& part : gathered(map, own))
    grams.try_emplace(part.number, Eigen::Matrix3d::Zero()).first->second +=
        Eigen::Map<const Eigen::Matrix3d>(part.entries);
}

/// Stiffness of foundations and springs against the rigid motions of every piece, divided by its largest entry. A link
/// between two pieces holds neither: only rounding errors remain of it, and these are set to zero.
template <typename Rows>
Grams elastic(const Boundary& boundary, const std::vector<std::int64_t>& piece_of, const Rows& at) {
  constexpr double rounding = 1e-11;
  Grams result, sizes;
  const double spacing = boundary.cloud.units.spacing;
  const auto length = [&](const Dof& dof) { return is_deflection(dof) ? spacing : 1; };
  for (const auto& part : boundary.elastic_supports.holding())
    part->for_each([&](const Dof& row, const Dof& column, double value) {
      if (!boundary.owns(row.point)) return;
      const auto number = piece_of[row.point];
      const bool within = number == piece_of[column.point];
      const Eigen::Matrix3d one =
          value * length(row) * length(column) * at(row) * at(within ? column : row).transpose();
      result.try_emplace(number, Eigen::Matrix3d::Zero()).first->second += one;
      sizes.try_emplace(number, Eigen::Matrix3d::Zero()).first->second += one.cwiseAbs();
    });
  if (!boundary.elastic_supports.parts().empty()) share(boundary.map, result), share(boundary.map, sizes);
  for (auto& [number, own] : result) {
    const double largest = own.cwiseAbs().maxCoeff();
    if (largest > rounding * sizes.at(number).maxCoeff())
      own /= largest;
    else
      own.setZero();
  }
  return result;
}

/// A piece, and where the rows of its conditions count from [lattice units].
struct Found {
  Piece piece;
  geometry::Point origin{0, 0};
};
using AllFound = std::map<std::int64_t, Found>;

/// Collective: merges the pieces that the ranks have found. The first point of each is the lowest, of these the one to
/// the left.
void share(const PointMap& map, AllFound& found) {
  struct Part {
    std::int64_t number, points;
    double position[2], origin[2];
  };
  std::vector<Part> own;
  for (const auto& [number, one] : found)
    own.push_back({number,
                   std::int64_t(one.piece.points),
                   {one.piece.position.x(), one.piece.position.y()},
                   {one.origin.x(), one.origin.y()}});
  auto parts = gathered(map, own);
  std::ranges::sort(parts, {}, [](const Part& p) { return std::tuple(p.number, p.origin[1], p.origin[0]); });
  for (auto& [number, one] : found) one.piece.points = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Found& one = found[parts[i].number];
    one.piece.points += std::size_t(parts[i].points);
    if (i > 0 && parts[i - 1].number == parts[i].number) continue;
    one.piece.position = {parts[i].position[0], parts[i].position[1]};
    one.origin = {parts[i].origin[0], parts[i].origin[1]};
  }
}

AllFound found_in(const Boundary& boundary, const std::vector<std::int64_t>& piece_of) {
  AllFound found;
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k) {
    if (!boundary.owns(k)) continue;
    auto& [piece, origin] = found[piece_of[k]];
    if (piece.points++ == 0)
      piece.position = boundary.cloud.positions[k], piece.first_point = k, origin = boundary.lattice[k];
  }
  share(boundary.map, found);
  return found;
}

/// The conditions that supports, ties, foundations and springs set to the rigid motions of every piece.
Grams conditions(const Boundary& boundary, const std::vector<std::int64_t>& piece_of, const AllFound& found,
                 PlateLaw law) {
  constexpr double nothing = 1e-5;  // rows of ties to points on circles are 1e-7
  Grams gram;
  for (const auto& [number, one] : found) gram[number].setZero();
  const auto counts = [&](const Dof& dof) { return found.contains(piece_of[dof.point]); };
  const auto add = [&](const Dof& dof, const Eigen::Vector3d& row) {
    gram.at(piece_of[dof.point]) += row * row.transpose();
  };
  const auto at = [&](const Dof& dof) {  // in lattice units about the piece's first point
    return rigid(dof, boundary.lattice[dof.point] - found.at(piece_of[dof.point]).origin, law);
  };
  for (const auto dof : boundary.constraints.fixed())
    if (counts(dof)) add(dof, at(dof));
  const auto scaled_factor = [&](const Constraints::Tie& tie) {  // w in spacings, rotations as they are
    return is_deflection(tie.follower) && !is_deflection(tie.leader) ? tie.factor / boundary.cloud.units.spacing
                                                                     : tie.factor;
  };
  const auto& ties = boundary.constraints.ties();
  for (std::size_t i = 0; i < ties.size();) {
    const auto follower = ties[i].follower;
    Eigen::Vector3d row = counts(follower) ? at(follower) : Eigen::Vector3d(0, 0, 0);
    for (; i < ties.size() && ties[i].follower == follower; ++i)
      if (counts(follower)) row -= scaled_factor(ties[i]) * at(ties[i].leader);
    if (row.norm() > nothing) add(follower, row);  // points of a rigid disc hinder no rigid motion
  }
  share(boundary.map, gram);
  for (auto& [number, own] : elastic(boundary, piece_of, at))
    if (found.contains(number)) gram[number] += own;
  return gram;
}

/// The pieces and their numbers, the largest first.
std::vector<std::pair<std::int64_t, Piece>> numbered(const Boundary& boundary,
                                                     const std::vector<std::int64_t>& piece_of, PlateLaw law) {
  auto found = found_in(boundary, piece_of);
  const auto grams = conditions(boundary, piece_of, found, law);
  std::vector<std::pair<std::int64_t, Piece>> result;
  for (auto& [number, one] : found) {
    // a rigid motion survives where it meets every condition of the piece: rows of conditions, their Gram matrix,
    // scaled to a unit diagonal, because rows in lattice units grow with the size of the plate
    const Eigen::Matrix3d& g = grams.at(number);
    const Eigen::Vector3d scale = g.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0; });
    const Eigenpairs eigen = eigenpairs(scale.asDiagonal() * g * scale.asDiagonal());
    one.piece.free_modes = static_cast<int>((eigen.values.array() < 1e-9).count());
    result.emplace_back(number, one.piece);
  }
  std::ranges::stable_sort(result, std::greater<>(), [](const auto& one) { return one.second.points; });
  return result;
}

}  // namespace

std::vector<std::uint32_t> detached_points(const Boundary& boundary, const geometry::Families& families) {
  auto sets = connected(boundary, families);
  const auto piece_of = set_numbers(sets, boundary);
  const auto all = numbered(boundary, piece_of, PlateLaw::bending);
  std::vector<std::int64_t> off;
  const bool held = std::ranges::any_of(all, [](const auto& one) { return one.second.free_modes < 3; });
  for (std::size_t i = held ? 0 : 1; i < all.size(); ++i)
    if (all[i].second.free_modes == 3) off.push_back(all[i].first);
  std::ranges::sort(off);
  std::vector<std::uint32_t> result;
  if (off.empty()) return result;
  for (std::uint32_t k = 0; k < families.points(); ++k)
    if (std::ranges::binary_search(off, piece_of[k])) result.push_back(k);
  return result;
}

std::vector<Piece> pieces(const Boundary& boundary, const geometry::Families& families, PlateLaw law) {
  auto sets = connected(boundary, families);
  std::vector<Piece> result;
  for (const auto& [number, piece] : numbered(boundary, set_numbers(sets, boundary), law)) result.push_back(piece);
  return result;
}

}  // namespace plate
