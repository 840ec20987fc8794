#include "cases/papers/bodies/competitors.hpp"

#include <Eigen/Dense>

#include "cases/papers/bodies/equilibrium.hpp"

namespace boundary_bodies {

namespace {

struct Moduli {
  double lambda, mu;
};

/// From the constants of two dimensions (Sca23 5).
Moduli moduli(const Material& m) {
  const double mu = m.k_e / 8;
  return {(m.k_theta + 4 * mu) / 2 - mu, mu};
}

/// A bond from a node, in the plane, with the volume of its other end within the horizon.
struct PlaneBond {
  int to;
  Eigen::Vector2d direction;
  double length, influence, volume;
};

std::vector<PlaneBond> bonds_of(const Solid& s, int i) {
  std::vector<PlaneBond> result;
  for (const auto& [away, fraction] : s.family) {
    const int j = s.body.node(s.body.nodes[std::size_t(i)] + away);
    if (j < 0 || j >= s.body.real) continue;
    const Eigen::Vector3d x = away.matrix().cast<double>();
    result.push_back({j, Eigen::Vector2d(x[0], x[1]) / x.norm(), s.spacing * x.norm(),
                      s.influence(x.norm() / s.horizon), fraction * s.volume()});
  }
  return result;
}

/// Weighted volume of a family inside.
double weighted_volume(const Solid& s) {
  double m = 0;
  for (const auto& [away, fraction] : s.family) {
    const double length = away.matrix().cast<double>().norm();
    m += s.influence(length / s.horizon) * length * length * s.spacing * s.spacing * fraction * s.volume();
  }
  return m;
}

Eigen::Index count(const std::vector<PlaneBond>& bonds) {
  return Eigen::Index(bonds.size());
}

/// Influences next to `given` (in the mean square over the volumes) with sum of influence x part x volume = target.
Eigen::VectorXd matched(const Eigen::VectorXd& given, const Eigen::MatrixXd& parts, const Eigen::VectorXd& volumes,
                        const Eigen::Vector3d& target) {
  const Eigen::MatrixXd weighted = volumes.asDiagonal() * parts;
  const Eigen::Matrix3d G = parts.transpose() * weighted;
  const Eigen::VectorXd multipliers = G.completeOrthogonalDecomposition().solve(target - weighted.transpose() * given);
  return given + parts * multipliers;
}

/// Influences of the bonds of a node for the dilatation and the deviator, times the volumes.
std::pair<Eigen::VectorXd, Eigen::VectorXd> position_aware_influences(const std::vector<PlaneBond>& bonds, double m) {
  const Eigen::Index n = count(bonds);
  Eigen::VectorXd dilatation(n), deviator(n), volumes(n);
  Eigen::MatrixXd stretches(n, 3), squares(n, 3);
  for (Eigen::Index b = 0; b < n; ++b) {
    const auto& [to, direction, length, influence, volume] = bonds[std::size_t(b)];
    const double c = direction[0], s = direction[1];
    const Eigen::Vector3d e = length * Eigen::Vector3d(c * c, s * s, 2 * c * s);  // of the three deformations
    stretches.row(b) = length * e;
    squares.row(b) = (e - length / 2 * Eigen::Vector3d(1, 1, 0)).array().square();
    dilatation[b] = 2 * influence / m, deviator[b] = 4 * influence / m, volumes[b] = volume;
  }
  dilatation = matched(dilatation, stretches, volumes, {1, 1, 0});
  deviator = matched(deviator, squares, volumes, {0.5, 0.5, 2});
  return {dilatation.cwiseProduct(volumes), deviator.cwiseProduct(volumes)};
}

}  // namespace

Eigen::MatrixXd position_aware_stiffness(const Solid& s) {
  const auto [lambda, mu] = moduli(s.material);
  const double m = weighted_volume(s);
  const Eigen::Index unknowns = 2 * s.body.real;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (int i = 0; i < s.body.real; ++i) {
    const auto bonds = bonds_of(s, i);
    const auto [dilatation, deviator] = position_aware_influences(bonds, m);
    Eigen::VectorXd theta = Eigen::VectorXd::Zero(unknowns), mean = theta;  // sums of rows of stretches
    double squares = 0;
    for (Eigen::Index b = 0; b < count(bonds); ++b) {
      const auto& bond = bonds[std::size_t(b)];
      const auto at = [&](Eigen::VectorXd& row, double weight) {
        row.segment<2>(2 * bond.to) += weight * bond.length * bond.direction;
        row.segment<2>(2 * i) -= weight * bond.length * bond.direction;
      };
      at(theta, dilatation[b]), at(mean, deviator[b]);
      squares += deviator[b] * bond.length * bond.length;
      const Eigen::Matrix2d block = s.volume() * 2 * mu * deviator[b] * bond.direction * bond.direction.transpose();
      K.block<2, 2>(2 * i, 2 * i) += block, K.block<2, 2>(2 * bond.to, 2 * bond.to) += block;
      K.block<2, 2>(2 * i, 2 * bond.to) -= block, K.block<2, 2>(2 * bond.to, 2 * i) -= block;
    }
    // energy: (lambda + mu) / 2 theta^2 + mu sum deviator (e - theta x / 2)^2
    K += s.volume() * ((lambda + mu + mu * squares / 2) * theta * theta.transpose() -
                       mu * (mean * theta.transpose() + theta * mean.transpose()));
  }
  return K;
}

namespace {

/// Displacements of a square's nodes and of fictitious nodes by mirrors.
class Mirrors {
public:
  Mirrors(const Solid& s, const Conditions& c, bool tangential, int last)
      : s_(s), c_(c), tangential_(tangential), last_(last), moduli_(moduli(s.material)) {}

  /// Displacement component of a place: row over the unknowns of real nodes, last entry: what is added.
  Eigen::VectorXd operator()(const std::array<int, 2>& place, int component) const {
    for (int axis = 0; axis < 2; ++axis) {
      const int at = place[std::size_t(axis)];
      if (at >= 0 && at <= last_) continue;
      return beyond(place, axis, at < 0 ? -1 : 1, component);
    }
    return Eigen::VectorXd::Unit(2 * s_.body.real + 1, 2 * node(place) + component);
  }

private:
  int node(const std::array<int, 2>& place) const { return s_.body.node({place[0], place[1], 0}); }

  Eigen::VectorXd beyond(std::array<int, 2> place, int axis, int side, int component) const {
    const int at = place[std::size_t(axis)];
    const double apart = s_.spacing * (side < 0 ? -2 * at - 1 : 2 * (at - last_) - 1);  // from the mirror node
    std::array<int, 2> edge = place;  // the node next to the face, or to its end
    for (int& i : edge) i = std::clamp(i, 0, last_);
    const int face = s_.body.surface_node(node(edge), axis, side);
    place[std::size_t(axis)] = side < 0 ? -at - 1 : 2 * last_ + 1 - at;
    const Eigen::VectorXd mirror = (*this)(place, component);
    const Eigen::Index one = mirror.size() - 1;
    if (c_.held(s_.body.surface[std::size_t(face)], component)) {
      Eigen::VectorXd odd = -mirror;
      odd[one] += 2 * c_.displacement(s_.at_surface(face))[component];
      return odd;
    }
    return mirror + apart * derivative(face, edge, component);
  }

  /// Along the outward normal of a face, from the traction there.
  Eigen::VectorXd derivative(int face, const std::array<int, 2>& edge, int component) const {
    const auto [lambda, mu] = moduli_;
    const auto& [inner, axis, side, distance] = s_.body.surface[std::size_t(face)];
    const bool normal = component == axis;
    const double modulus = normal ? lambda + 2 * mu : mu;
    const int other = 1 - axis;
    const Eigen::Vector3d p = c_.traction(s_.at_surface(face), side * Eigen::Vector3d::Unit(axis));
    Eigen::VectorXd row = Eigen::VectorXd::Zero(2 * s_.body.real + 1);
    row[row.size() - 1] = p[component] / modulus;
    if (tangential_) row -= side * (normal ? lambda / modulus : 1) * along(edge, other, normal ? other : axis);
    return row;
  }

  /// Difference along the edge, of neighbours or at its ends one-sided.
  Eigen::VectorXd along(const std::array<int, 2>& edge, int axis, int component) const {
    std::array<int, 2> before = edge, after = edge;
    before[std::size_t(axis)] = std::max(0, edge[std::size_t(axis)] - 1);
    after[std::size_t(axis)] = std::min(last_, edge[std::size_t(axis)] + 1);
    const double apart = s_.spacing * (after[std::size_t(axis)] - before[std::size_t(axis)]);
    return ((*this)(after, component) - (*this)(before, component)) / apart;
  }

  const Solid& s_;
  const Conditions& c_;
  bool tangential_;
  int last_;  // index of the last node along either axis
  Moduli moduli_;
};

}  // namespace

Eigen::VectorXd with_mirror_nodes(const Solid& s, const Conditions& c, bool tangential) {
  const int counts = int(std::lround(std::sqrt(s.body.real))), reach = int(s.horizon);
  Solid larger = s;  // its real nodes have all their families: the body and one horizon about it
  larger.body = box_body({counts + 2 * reach, counts + 2 * reach}, reach);
  const Mirrors mirrors(s, c, tangential, counts - 1);
  Eigen::MatrixXd U(2 * larger.body.count(), 2 * s.body.real + 1);
  for (int k = 0; k < larger.body.count(); ++k)
    for (int a = 0; a < 2; ++a) {
      const plate::LatticeBody::Index place = larger.body.nodes[std::size_t(k)] - reach;
      U.row(2 * k + a) = mirrors({place[0], place[1]}, a);
    }
  const Actions all = actions(larger, plate::FluxRule::crossing_point);
  const Eigen::MatrixXd theta = all.dilatation * U;
  const Eigen::MatrixXd forces = all.of_values * U + all.of_dilatation.leftCols(larger.body.real) * theta;
  Eigen::MatrixXd K(2 * s.body.real, 2 * s.body.real + 1);
  for (int k = 0; k < s.body.real; ++k) {
    const plate::LatticeBody::Index place = s.body.nodes[std::size_t(k)] + plate::LatticeBody::Index(reach, reach, 0);
    K.middleRows<2>(2 * k) = forces.middleRows<2>(2 * larger.body.node(place));
  }
  return K.leftCols(2 * s.body.real).partialPivLu().solve(loads(s, c) - K.rightCols<1>());
}

namespace {

/// Rows that give u_x, u_y, u_xx, u_xy, u_yy at a node from the values at the node and its family: those of the second
/// order operator, orthogonal to all other terms of Taylor's expansion under the weights of the family.
Eigen::MatrixXd derivatives(const Solid& s, int i) {
  const auto bonds = bonds_of(s, i);
  Eigen::MatrixXd terms(5, count(bonds)), weighted(5, count(bonds));
  for (Eigen::Index b = 0; b < count(bonds); ++b) {
    const auto& bond = bonds[std::size_t(b)];
    const Eigen::Vector2d x = bond.length * bond.direction;
    terms.col(b) << x[0], x[1], x[0] * x[0] / 2, x[0] * x[1], x[1] * x[1] / 2;
    weighted.col(b) = bond.influence * bond.volume * terms.col(b);
  }
  const Eigen::MatrixXd g = (weighted * terms.transpose()).fullPivLu().solve(weighted);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(5, s.body.real);
  for (Eigen::Index b = 0; b < count(bonds); ++b) rows.col(bonds[std::size_t(b)].to) = g.col(b);
  rows.col(i) -= g.rowwise().sum();
  return rows;
}

/// The local law at a node: rows over all unknowns.
class LocalLaw {
public:
  LocalLaw(const Solid& s, int i) : moduli_(moduli(s.material)), derivatives_(derivatives(s, i)) {}

  Eigen::RowVectorXd stress(int a, int b) const {
    const auto [lambda, mu] = moduli_;
    if (a != b) return mu * (of(0, 1) + of(1, 0));
    return (lambda + 2 * mu) * of(a, a) + lambda * of(1 - a, 1 - a);
  }
  /// Divergence of stress.
  Eigen::RowVectorXd force(int a) const {
    const auto [lambda, mu] = moduli_;
    const int b = 1 - a;
    return (lambda + 2 * mu) * row(2 + 2 * a, a) + mu * row(2 + 2 * b, a) + (lambda + mu) * row(3, b);
  }

private:
  Eigen::RowVectorXd of(int component, int axis) const { return row(axis, component); }
  Eigen::RowVectorXd row(int derivative, int component) const {
    Eigen::RowVectorXd all = Eigen::RowVectorXd::Zero(2 * derivatives_.cols());
    for (Eigen::Index k = 0; k < derivatives_.cols(); ++k) all[2 * k + component] = derivatives_(derivative, k);
    return all;
  }

  Moduli moduli_;
  Eigen::MatrixXd derivatives_;
};

}  // namespace

Eigen::VectorXd with_differential_operator(const Solid& s, const Conditions& c, const Field& solution,
                                           bool stress_at_nodes) {
  const int n = s.body.real, last = int(std::lround(std::sqrt(n))) - 1;
  Eigen::MatrixXd K = uncorrected_stiffness(s);
  Eigen::VectorXd f = loads(s, c);
  for (int i = 0; i < n; ++i) {
    const auto& place = s.body.nodes[std::size_t(i)];
    if (std::min({place[0], place[1], last - place[0], last - place[1]}) >= 2 * int(s.horizon)) continue;
    const LocalLaw law(s, i);
    for (int a = 0; a < 2; ++a) {
      int face = -1;
      for (const int axis : {1 - a, a})
        for (const int side : {-1, 1})
          if (const int found = s.body.surface_node(i, axis, side); found >= 0) face = found;
      if (face < 0) {
        K.row(2 * i + a) = -law.force(a);
        f[2 * i + a] = c.load(s.at(i))[a];
        continue;
      }
      const auto& node = s.body.surface[std::size_t(face)];
      const bool held = c.held(node, a);
      const Eigen::Vector3d normal = node.side * Eigen::Vector3d::Unit(node.axis);
      if (held)
        K.row(2 * i + a) = Eigen::RowVectorXd::Unit(2 * n, 2 * i + a);
      else
        K.row(2 * i + a) = node.side * law.stress(a, node.axis);
      f[2 * i + a] =
          held ? solution(s.at(i))[a] : c.traction(stress_at_nodes ? s.at(i) : s.at_surface(face), normal)[a];
    }
  }
  return K.partialPivLu().solve(f);
}

}  // namespace boundary_bodies
