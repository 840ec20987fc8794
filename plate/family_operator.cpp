#include "plate/family_operator.hpp"

namespace plate {
namespace {

/// |m| and differences turned into sums: the matrix of absolute values of a bond acts like this.
BondShape absolute_shape(const BondShape& bond) {
  return {std::abs(bond.mx), std::abs(bond.my), bond.length, bond.weight};
}

double curvature_sum(const BondShape& bond, const Kinematics& k, const Kinematics& j) {
  return bond.mx * (j.theta_x + k.theta_x) + bond.my * (j.theta_y + k.theta_y);
}

double shear_sum(const BondShape& bond, const Kinematics& k, const Kinematics& j) {
  return j.w + k.w + bond.length / 2 * (bond.mx * (k.theta_x + j.theta_x) + bond.my * (k.theta_y + j.theta_y));
}

}  // namespace

FamilyOperator::FamilyOperator(geometry::Families families, std::vector<BondShape> shapes,
                               const std::vector<double>& areas, const std::vector<PointParameters>& parameters)
    : families_(std::move(families)), shapes_(std::move(shapes)), parameters_(parameters), packed_(areas.size()) {
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < areas.size(); ++k)
    packed_[k] = {{0, 0, 0}, 0, areas[k], parameters[k].b, parameters[k].C / 2};
}

template <bool absolute>
void FamilyOperator::product(const State& state, Forces& forces) const {
  const auto points = families_.points();
  forces.resize(3, static_cast<Eigen::Index>(points));
  std::vector<BondShape> shapes = shapes_;
  if constexpr (absolute)
    for (auto& bond : shapes) bond = absolute_shape(bond);

#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < points; ++k) {
      const auto u = state.col(static_cast<Eigen::Index>(k));
      packed_[k].u = {u[0], u[1], u[2]};
    }
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < points; ++k) {
      const Packed& own = packed_[k];
      double dilatation = 0;
      for (auto b = families_.first[k]; b < families_.first[k + 1]; ++b) {
        const BondShape& bond = shapes[families_.vector_id[b]];
        const Packed& other = packed_[families_.neighbour[b]];
        const double difference =
            absolute ? curvature_sum(bond, own.u, other.u) : curvature_difference(bond, own.u, other.u);
        dilatation += bond.weight * other.area * difference;
      }
      const PointParameters& p = parameters_[k];
      packed_[k].q = 2 * (absolute ? std::abs(p.a) : p.a) * p.d * p.d * dilatation;
    }
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < points; ++k) {
      const Packed& own = packed_[k];
      double force = 0, couple_x = 0, couple_y = 0;
      for (auto b = families_.first[k]; b < families_.first[k + 1]; ++b) {
        const BondShape& bond = shapes[families_.vector_id[b]];
        const Packed& other = packed_[families_.neighbour[b]];
        const double curvature =
            absolute ? curvature_sum(bond, own.u, other.u) : curvature_difference(bond, own.u, other.u);
        const double shear = absolute ? shear_sum(bond, own.u, other.u) : shear_difference(bond, own.u, other.u);
        const BondForce f = bond_force(bond, own.area * other.area * bond.weight, own.q + other.q, own.b + other.b,
                                       own.half_shear + other.half_shear, curvature, shear);
        force += f.force;
        couple_x += bond.mx * f.couple;
        couple_y += bond.my * f.couple;
      }
      forces.col(static_cast<Eigen::Index>(k)) << force, couple_x, couple_y;
    }
  }
}

void FamilyOperator::internal_force(const State& state, Forces& forces) const { product<false>(state, forces); }

void FamilyOperator::absolute_product(const State& state, Forces& forces) const { product<true>(state, forces); }

void FamilyOperator::diagonal(Forces& forces) const {
  forces.resize(3, static_cast<Eigen::Index>(points()));
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < points(); ++k) {
    const Packed& own = packed_[k];
    double force = 0;
    Eigen::Vector2d couple(0, 0), gradient(0, 0);
    for (auto b = families_.first[k]; b < families_.first[k + 1]; ++b) {
      const BondShape& bond = shapes_[families_.vector_id[b]];
      const auto j = families_.neighbour[b];
      const Packed& other = packed_[j];
      const double pair = own.area * other.area * bond.weight, C = own.half_shear + other.half_shear;
      const Eigen::Vector2d m(bond.mx, bond.my), square = m.cwiseProduct(m);
      const double through_neighbour = parameters_[j].d * bond.weight * own.area;
      force += pair * C;
      couple += square * (pair * (2 * (own.b + other.b) + C * bond.length * bond.length / 4) +
                          2 * parameters_[j].a * other.area * through_neighbour * through_neighbour);
      gradient += m * (parameters_[k].d * bond.weight * other.area);
    }
    couple += gradient.cwiseProduct(gradient) * (2 * parameters_[k].a * own.area);
    forces.col(static_cast<Eigen::Index>(k)) << force, couple.x(), couple.y();
  }
}

Eigen::VectorXd FamilyOperator::energies(const State& state) const {
  const auto kinematics = [&](std::size_t k) {
    const auto u = state.col(static_cast<Eigen::Index>(k));
    return Kinematics{u[0], u[1], u[2]};
  };
  Eigen::VectorXd result(static_cast<Eigen::Index>(points()));
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < points(); ++k) {
    const PointParameters& p = parameters_[k];
    double dilatation = 0, sum = 0;
    for (auto b = families_.first[k]; b < families_.first[k + 1]; ++b) {
      const BondShape& bond = shapes_[families_.vector_id[b]];
      const auto j = families_.neighbour[b];
      const double curvature = curvature_difference(bond, kinematics(k), kinematics(j));
      const double shear = shear_difference(bond, kinematics(k), kinematics(j));
      dilatation += p.d * bond.weight * packed_[j].area * curvature;
      sum += bond_energy(bond, packed_[j].area, p.b, p.C, curvature, shear);
    }
    result[static_cast<Eigen::Index>(k)] = packed_[k].area * (p.a * dilatation * dilatation + sum);
  }
  return result;
}

}  // namespace plate
