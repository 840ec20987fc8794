#include "plate/edges/extrapolation.hpp"

#include <fmt/format.h>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "plate/model/dense_algebra.hpp"
#include "plate/model/errors.hpp"

namespace plate {

namespace {

/// Products of powers of x of degree 1 to `order`, from the highest power of the first component on.
Eigen::RowVectorXd monomials(const Eigen::VectorXd& x, int order) {
  const int dimension = int(x.size());
  std::vector<double> result;
  std::vector<int> power(std::size_t(dimension), 0);
  const std::function<void(int, int, double)> add = [&](int component, int left, double product) {
    if (component + 1 == dimension) {
      result.push_back(product * std::pow(x[component], left));
      return;
    }
    for (int k = left; k >= 0; --k) add(component + 1, left - k, product * std::pow(x[component], k));
  };
  for (int degree = 1; degree <= order; ++degree) add(0, degree, 1);
  return Eigen::Map<Eigen::RowVectorXd>(result.data(), Eigen::Index(result.size()));
}

}  // namespace

int taylor_terms(int dimension, int order) {
  int terms = 1;
  for (int i = 1; i <= dimension; ++i) terms = terms * (order + i) / i;
  return terms;
}

Eigen::VectorXd taylor_weights(const Eigen::MatrixXd& nodes, const Eigen::VectorXd& at, int order) {
  const Eigen::Index count = nodes.cols(), derivatives = taylor_terms(int(nodes.rows()), order) - 1;
  Eigen::VectorXd weights = Eigen::VectorXd::Unit(count, 0);
  if (derivatives == 0) return weights;
  const auto refuse = [&] {
    throw Refused({{Subject::spacing, 0,
                    fmt::format("an extrapolation of order {} needs {} nodes that determine it, {} are there", order,
                                derivatives + 1, count)}});
  };
  if (count <= derivatives) refuse();
  const Eigen::MatrixXd apart = nodes.rightCols(count - 1).colwise() - nodes.col(0);
  const double unit = apart.cwiseAbs().maxCoeff();
  Eigen::MatrixXd expansions(derivatives, count - 1);  // of each node about the first, without its value
  for (Eigen::Index q = 0; q + 1 < count; ++q) expansions.col(q) = monomials(apart.col(q) / unit, order).transpose();
  const auto [shares, rank] = least_norm(expansions, monomials((at - nodes.col(0)) / unit, order).transpose());
  if (rank < derivatives) refuse();
  weights.tail(count - 1) = shares;
  weights[0] = 1 - weights.tail(count - 1).sum();
  return weights;
}

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
constexpr double same_position = 1e-9;  // spacings: lattice positions differ by more, or are equal but for rounding

/// Centre of an expansion: a real node, or a surface node and the cells behind it.
struct Stand {
  int cell;     // a real node
  int face;     // its surface node; -1: expanded about the real node itself
  int unknown;  // the column of its value
  Eigen::Vector3d position;
};

Stand on_node(const LatticeBody& b, int k) {
  return {k, -1, k, b.position(k)};
}

Stand on_surface(const LatticeBody& b, int s) {
  return {b.surface[std::size_t(s)].inner, s, b.real + s, b.surface_position(s)};
}

/// Numbers of steps along each of `axes`, no more than `order` together; none first.
std::vector<LatticeBody::Index> principal_lattice(const std::vector<int>& axes, int order) {
  std::vector<LatticeBody::Index> steps{{0, 0, 0}};
  for (const int axis : axes) {
    const auto before = steps;
    for (int k = 1; k <= order; ++k)
      for (auto step : before)
        if (step.sum() + k <= order) step[axis] = k, steps.push_back(step);
  }
  return steps;
}

/// The node that so many steps lead to, away from `at`; the first step from a surface node leads to its real node.
Stand stepped(const LatticeBody& b, const Stand& from, LatticeBody::Index steps, const Eigen::Vector3d& at) {
  LatticeBody::Index place = b.nodes[std::size_t(from.cell)];
  const int normal = from.face < 0 ? -1 : b.surface[std::size_t(from.face)].axis;
  const bool on_face = normal >= 0 && steps[normal] == 0;
  if (normal >= 0 && !on_face) --steps[normal];
  for (int axis = 0; axis < b.dimension; ++axis)
    place[axis] += at[axis] > from.position[axis] ? -steps[axis] : steps[axis];
  const int k = b.node(place);
  const auto missing = [&] {
    return Refused({{Subject::spacing, 0,
                     fmt::format("an edge has too few nodes behind it at ({}, {}, {}) of the "
                                 "lattice for an extrapolation of this order; refine",
                                 place[0], place[1], place[2])}});
  };
  if (k < 0 || k >= b.real) throw missing();
  if (!on_face) return on_node(b, k);
  const auto& face = b.surface[std::size_t(from.face)];
  const int s = b.surface_node(k, face.axis, face.side);
  if (s < 0) throw missing();
  return on_surface(b, s);
}

void add_expansion(const LatticeBody& b, const Stand& centre, const Eigen::Vector3d& at, int order, int row,
                   double share, Triplets& to) {
  std::vector<int> axes;
  for (int axis = 0; axis < b.dimension; ++axis)
    if (std::abs(at[axis] - centre.position[axis]) > same_position) axes.push_back(axis);
  const auto lattice = principal_lattice(axes, order);
  Eigen::MatrixXd nodes(Eigen::Index(axes.size()), Eigen::Index(lattice.size()));
  std::vector<int> unknowns;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const Stand node = stepped(b, centre, lattice[i], at);
    nodes.col(Eigen::Index(i)) = node.position(axes);
    unknowns.push_back(node.unknown);
  }
  const Eigen::VectorXd weights = axes.empty() ? Eigen::VectorXd::Ones(1) : taylor_weights(nodes, at(axes), order);
  for (std::size_t i = 0; i < unknowns.size(); ++i) to.emplace_back(row, unknowns[i], share * weights[Eigen::Index(i)]);
}

/// Returns all stands that are as near to `at` as the nearest one.
std::vector<Stand> nearest(const std::vector<Stand>& all, const Eigen::Vector3d& at) {
  std::vector<Stand> result;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& one : all) {
    const double distance = (one.position - at).norm();
    if (distance < least - same_position) result.clear();
    if (distance < least + same_position) result.push_back(one);
    least = std::min(least, distance);
  }
  return result;
}

}  // namespace

WeightRows extrapolation(const LatticeBody& b, Centre centre, int order) {
  const bool surface = centre == Centre::surface_node;
  std::vector<Stand> centres;
  for (std::size_t s = 0; s < b.surface.size(); ++s)
    centres.push_back(surface ? on_surface(b, int(s)) : on_node(b, b.surface[s].inner));
  Triplets entries;
  for (int k = 0; k < b.real; ++k) entries.emplace_back(k, k, 1.0);
  for (int k = b.real; k < b.count(); ++k) {
    const auto near = nearest(centres, b.position(k));
    for (const auto& one : near) add_expansion(b, one, b.position(k), order, k, 1.0 / double(near.size()), entries);
  }
  for (int i = 0; i < int(b.sights.size()); ++i) {
    const auto& [k, s] = b.sights[std::size_t(i)];
    const Stand before = surface ? on_surface(b, s) : on_node(b, b.surface[std::size_t(s)].inner);
    add_expansion(b, before, b.position(k), order, b.count() + i, 1, entries);
  }
  WeightRows rows(b.values(), b.real + (surface ? Eigen::Index(b.surface.size()) : 0));
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

WeightRows surface_values(const LatticeBody& b, int order) {
  Triplets entries;
  for (int s = 0; s < int(b.surface.size()); ++s)
    add_expansion(b, on_node(b, b.surface[std::size_t(s)].inner), b.surface_position(s), order, s, 1, entries);
  WeightRows rows(Eigen::Index(b.surface.size()), b.real);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

WeightRows for_each_unknown(const std::vector<WeightRows>& rows) {
  if (rows.empty()) throw std::invalid_argument("a node needs an unknown");
  const Eigen::Index unknowns = Eigen::Index(rows.size());
  Triplets entries;
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    const auto& own = rows[std::size_t(i)];
    if (own.rows() != rows[0].rows() || own.cols() != rows[0].cols())
      throw std::invalid_argument("the unknowns of a node have values at other nodes");
    for (Eigen::Index row = 0; row < own.outerSize(); ++row)
      for (WeightRows::InnerIterator entry(own, row); entry; ++entry)
        entries.emplace_back(i + unknowns * row, i + unknowns * entry.col(), entry.value());
  }
  WeightRows result(unknowns * rows[0].rows(), unknowns * rows[0].cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

WeightRows for_each_unknown(const WeightRows& rows, int unknowns) {
  return for_each_unknown(std::vector<WeightRows>(std::size_t(unknowns), rows));
}

}  // namespace plate
