#include "cases/papers/bodies/solid.hpp"

namespace boundary_bodies {

namespace {

using plate::SparseStiffness;
using plate::WeightRows;
using Triplets = std::vector<Eigen::Triplet<double>>;

Material material(int dimension, double bulk, double shear) {
  return {double(dimension), dimension * bulk - (dimension + 2) * shear, dimension * (dimension + 2.0) * shear};
}

struct Bond {
  Eigen::Vector3d direction;
  double length;     // [length]
  double influence;  // times the fraction of the cell
};

Bond bond_of(const Solid& s, const Neighbour& n) {
  const Eigen::Vector3d x = n.away.matrix().cast<double>();
  return {x.normalized(), s.spacing * x.norm(), s.influence(x.norm() / s.horizon) * n.fraction};
}

/// Sums over the families among the first `nodes` nodes; rows of surface nodes where there is a rule for them.
Actions assembled(const Solid& s, const Eigen::VectorXd& m, int nodes, std::optional<plate::FluxRule> rule) {
  const int D = s.dimension();
  const auto& b = s.body;
  const double c_theta = s.material.c_theta, k_theta = s.material.k_theta, k_e = s.material.k_e;
  Triplets theta, values, dilatation;
  for (int i = 0; i < nodes; ++i)
    for (const auto& neighbour : s.family) {
      const int j = b.node(b.nodes[std::size_t(i)] + neighbour.away);
      if (j < 0 || j >= nodes) continue;
      const Bond bond = bond_of(s, neighbour);  // not taken apart: clang 16 leaves closures no names of parts
      const auto& direction = bond.direction;
      const double length = bond.length, influence = bond.influence;
      const double pull = influence * s.volume() * s.volume();
      const auto add = [&](int row, double share) {  // share of the bond's force along its direction
        for (int a = 0; a < D; ++a) {
          const double f = share * pull * direction[a];
          for (int c = 0; c < D; ++c) {
            const double stretch = f * k_e * (1 / m[i] + 1 / m[j]) * direction[c];
            values.emplace_back(D * row + a, D * j + c, stretch);
            values.emplace_back(D * row + a, D * i + c, -stretch);
          }
          dilatation.emplace_back(D * row + a, i, f * k_theta * length / m[i]);
          dilatation.emplace_back(D * row + a, j, f * k_theta * length / m[j]);
        }
      };
      if (i < b.real) {
        for (int c = 0; c < D; ++c) {
          const double weight = c_theta / m[i] * influence * s.volume() * length * direction[c];
          theta.emplace_back(i, D * j + c, weight);
          theta.emplace_back(i, D * i + c, -weight);
        }
        add(i, -1);
      }
      if (rule)
        for (const auto& crossing : crossings(b, i, j, *rule)) add(b.real + crossing.surface, crossing.share);
    }
  const Eigen::Index rows = D * (b.real + (rule ? Eigen::Index(b.surface.size()) : 0));
  Actions result{WeightRows(b.real, D * nodes), SparseStiffness(rows, D * nodes), SparseStiffness(rows, nodes)};
  result.dilatation.setFromTriplets(theta.begin(), theta.end());
  result.of_values.setFromTriplets(values.begin(), values.end());
  result.of_dilatation.setFromTriplets(dilatation.begin(), dilatation.end());
  return result;
}

double full_weighted_volume(const Solid& s) {
  double m = 0;
  for (const auto& neighbour : s.family) {
    const auto bond = bond_of(s, neighbour);
    m += bond.influence * bond.length * bond.length * s.volume();
  }
  return m;
}

}  // namespace

Material bar_material(double young, double poisson) {
  return {1 - 2 * poisson, poisson * young / ((1 - 2 * poisson) * (1 + poisson)), young / (1 + poisson)};
}

Material plane_strain_material(double young, double poisson) {
  return material(2, young / (2 * (1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson)));
}

Material plane_stress_material(double young, double poisson) {
  return material(2, young / (2 * (1 - poisson)), young / (2 * (1 + poisson)));
}

Material space_material(double young, double poisson) {
  return material(3, young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson)));
}

double gauss(double ratio) {
  return std::exp(-ratio * ratio);
}

double inverse(double ratio) {
  return 1 / ratio;
}

Eigen::Vector3d Solid::place(const Eigen::Vector3d& position) const {
  Eigen::Vector3d x = position;
  x.head(dimension()).array() += 0.5;
  return spacing * x;
}

Actions actions(const Solid& s, plate::FluxRule rule) {
  return assembled(s, Eigen::VectorXd::Constant(s.body.count(), full_weighted_volume(s)), s.body.count(), rule);
}

SparseStiffness stiffness(const Solid& s, plate::Centre centre, int order, plate::FluxRule rule) {
  const Actions a = actions(s, rule);
  const WeightRows expanded = plate::for_each_unknown(plate::extrapolation(s.body, centre, order), s.dimension());
  const WeightRows theta = a.dilatation * expanded;
  const SparseStiffness dilatations = plate::extrapolation(s.body, plate::Centre::real_node, order - 1) * theta;
  return a.of_values * SparseStiffness(expanded) + a.of_dilatation * dilatations;
}

Eigen::VectorXd actions_of(const Solid& s, const Field& field, plate::FluxRule rule) {
  const int D = s.dimension();
  const double m = full_weighted_volume(s);
  Eigen::VectorXd U(D * s.body.count()), theta = Eigen::VectorXd::Zero(s.body.count());
  for (int k = 0; k < s.body.count(); ++k) {
    const Eigen::Vector3d u = field(s.at(k));
    U.segment(D * k, D) = u.head(D);
    for (const auto& neighbour : s.family) {
      const auto bond = bond_of(s, neighbour);
      const Eigen::Vector3d difference = field(s.at(k) + bond.length * bond.direction) - u;
      theta[k] += s.material.c_theta / m * bond.influence * s.volume() * bond.length *
                  difference.head(D).dot(bond.direction.head(D));
    }
  }
  const Actions a = actions(s, rule);
  return a.of_values * U + a.of_dilatation * theta;
}

SparseStiffness uncorrected_stiffness(const Solid& s) {
  Eigen::VectorXd m = Eigen::VectorXd::Zero(s.body.real);
  for (int i = 0; i < s.body.real; ++i)
    for (const auto& neighbour : s.family) {
      const int j = s.body.node(s.body.nodes[std::size_t(i)] + neighbour.away);
      if (j < 0 || j >= s.body.real) continue;
      const auto bond = bond_of(s, neighbour);
      m[i] += bond.influence * bond.length * bond.length * s.volume();
    }
  const Actions a = assembled(s, m, s.body.real, {});
  return a.of_values + SparseStiffness(a.of_dilatation * SparseStiffness(a.dilatation));
}

Eigen::VectorXd at_unknowns(const Solid& s, const Field& field) {
  const int D = s.dimension(), surface = int(s.body.surface.size());
  Eigen::VectorXd u(D * (s.body.real + surface));
  for (int k = 0; k < s.body.real; ++k) u.segment(D * k, D) = field(s.at(k)).head(D);
  for (int f = 0; f < surface; ++f) u.segment(D * (s.body.real + f), D) = field(s.at_surface(f)).head(D);
  return u;
}

}  // namespace boundary_bodies
