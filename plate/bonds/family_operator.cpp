#include "plate/bonds/family_operator.hpp"

#include <algorithm>
#include "plate/model/halo_exchange.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

constexpr std::uint32_t longest_run = 256;

Kinematics<> kinematics(const State& state, Eigen::Index k) {
  return {state(0, k), state(1, k), state(2, k)};
}

/// theory (2); for the matrix of absolute values, |m| is given and differences become sums.
template <bool absolute>
double curvature(const PatternBond& bond, const Kinematics<>& k, const Kinematics<>& j) {
  if constexpr (absolute)
    return bond.mx * (j.theta_x + k.theta_x) + bond.my * (j.theta_y + k.theta_y);
  else
    return curvature_difference(bond, k, j);
}

template <bool absolute>
double shear(const PatternBond& bond, const Kinematics<>& k, const Kinematics<>& j) {
  if constexpr (absolute)
    return j.w + k.w + bond.length / 2 * curvature<true>(bond, k, j);
  else
    return shear_difference(bond, k, j);
}

}  // namespace

bool OperatedPart::waits(std::uint32_t first, std::uint32_t length, std::span<const PatternBond> bonds) const {
  if (pending.empty()) return false;
  const auto any = [&](std::int64_t from) {
    return std::any_of(pending.begin() + from, pending.begin() + from + length, [](char one) { return one; });
  };
  return any(first) || std::ranges::any_of(bonds, [&](const auto& bond) { return any(first + bond.step); });
}

FamilyOperator::FamilyOperator(geometry::Families families, std::vector<BondShape> shapes,
                               const std::vector<double>& areas, HorizonWeights weights, OperatedPart part)
    : families_(std::move(families)),
      runs_(geometry::family_runs(families_, weights.kind, longest_run, part.block)),
      shapes_(std::move(shapes)),
      weights_(std::move(weights)),
      part_(std::move(part)) {
  const auto count = static_cast<Eigen::Index>(areas.size());
  area_.resize(count), dilatation_stiffness_.resize(count);
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < count; ++k) {
    area_[k] = areas[static_cast<std::size_t>(k)];
    dilatation_stiffness_[k] = 2 * area_[k] * weights_.a[weights_.kind[static_cast<std::size_t>(k)]];
  }
  patterns_.first.push_back(0);
  for (const std::size_t k : runs_.example) {
    for (std::size_t i = 0; i < families_[k].size(); ++i) patterns_.bonds.push_back(bond(k, i));
    patterns_.first.push_back(patterns_.bonds.size());
    patterns_.stiffness.push_back(dilatation_stiffness_[Eigen::Index(k)]);
  }
}

/// The i-th bond of point k.
PatternBond FamilyOperator::bond(std::size_t k, std::size_t i) const {
  const auto [j, id] = families_[k][i];
  const BondWeights &own = weights_.of(k, i), &other = weights_.of(j, families_[j].find(static_cast<std::uint32_t>(k)));
  const double area = area_[Eigen::Index(k)], area_j = area_[Eigen::Index(j)];
  const BondShape& shape = shapes_[id];
  return {shape.mx,
          shape.my,
          shape.length,
          own.D,
          other.D,
          2 * (area * own.B + area_j * other.B),
          2 * (area * own.S + area_j * other.S),
          static_cast<std::int32_t>(std::ptrdiff_t(j) - std::ptrdiff_t(k))};
}

template <bool absolute>
void FamilyOperator::product(const State& state, const Patterns& patterns, const Eigen::ArrayXd& stiffness,
                             Forces& forces) const {
  forces.resize(unknowns_per_point, static_cast<Eigen::Index>(points()));
  Eigen::ArrayXd q(forces.cols());  // by point: 2 A a theta
  const auto for_each_point = [&](const auto& visit) {
#pragma omp for schedule(static)
    for (std::size_t r = 0; r < runs_.runs.size(); ++r) {
      const auto& run = runs_.runs[r];
      const PatternBond* const bonds = patterns.bonds.data();
      for (std::uint32_t i = 0; i < run.length; ++i)
        visit(Eigen::Index(run.first_point + i), bonds + patterns.first[run.pattern],
              bonds + patterns.first[run.pattern + 1]);
    }
  };
#pragma omp parallel
  {
    for_each_point([&](Eigen::Index k, const PatternBond* bond, const PatternBond* end) {
      const auto own = kinematics(state, k);
      double sum = 0;
      for (; bond < end; ++bond) sum += bond->D_kj * curvature<absolute>(*bond, own, kinematics(state, k + bond->step));
      q[k] = stiffness[k] * sum;
    });
    if (part_.exchange) {
#pragma omp master
      part_.exchange->fetch(std::span(q.data(), std::size_t(q.size())));
#pragma omp barrier
    }
    for_each_point([&](Eigen::Index k, const PatternBond* bond, const PatternBond* end) {
      const auto own = kinematics(state, k);
      double force = 0, couple_x = 0, couple_y = 0;
      for (; bond < end; ++bond) {
        const auto other = kinematics(state, k + bond->step);
        const auto f = bond_force<double>(bond->length, bond->D_kj, bond->D_jk, bond->curvature, bond->shear, q[k],
                                          q[k + bond->step], curvature<absolute>(*bond, own, other),
                                          shear<absolute>(*bond, own, other));
        force += f.force;
        couple_x += bond->mx * f.couple;
        couple_y += bond->my * f.couple;
      }
      forces.col(k) << force, couple_x, couple_y;
    });
  }
}

void FamilyOperator::internal_force(const State& state, Forces& forces) const {
  product<false>(state, patterns_, dilatation_stiffness_, forces);
  elastic_supports_.add_force(state, forces);
}

void FamilyOperator::absolute_product(const State& state, Forces& forces) const {
  Patterns absolute = patterns_;
  for (auto& bond : absolute.bonds)
    for (double* value : {&bond.mx, &bond.my, &bond.D_kj, &bond.D_jk}) *value = std::abs(*value);
  product<true>(state, absolute, dilatation_stiffness_.abs(), forces);
  elastic_supports_.add_absolute_product(state, forces);
}

Forces FamilyOperator::diagonal() const {
  Forces result(unknowns_per_point, static_cast<Eigen::Index>(points()));
#pragma omp parallel for schedule(static)
  for (std::size_t r = 0; r < runs_.runs.size(); ++r) {
    const auto& run = runs_.runs[r];
    for (std::size_t k = run.first_point; k < run.first_point + run.length; ++k) {
      double force = 0;
      Eigen::Array2d couple(0, 0), gradient(0, 0);
      for (auto b = patterns_.first[run.pattern]; b < patterns_.first[run.pattern + 1]; ++b) {
        const PatternBond& bond = patterns_.bonds[b];
        const auto j = static_cast<Eigen::Index>(k) + bond.step;
        const Eigen::Array2d m(bond.mx, bond.my);
        force += bond.shear;
        couple += m * m *
                  (bond.curvature + bond.shear * bond.length * bond.length / 4 +
                   dilatation_stiffness_[j] * bond.D_jk * bond.D_jk);
        gradient += m * bond.D_kj;
      }
      couple += gradient * gradient * dilatation_stiffness_[Eigen::Index(k)];
      result.col(Eigen::Index(k)) << force, couple.x(), couple.y();
    }
  }
  elastic_supports_.add_diagonal(result);
  return result;
}

Eigen::VectorXd FamilyOperator::energies(const State& state) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(points()));
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < result.size(); ++k) {
    const Kinematics<> own{state(0, k), state(1, k), state(2, k)};
    double dilatation = 0, sum = 0;
    const auto family = families_[std::size_t(k)];
    for (std::size_t i = 0; i < family.size(); ++i) {
      const BondShape& bond = shapes_[family[i].vector_id];
      const BondWeights& weights = weights_.of(std::size_t(k), i);
      const auto j = static_cast<Eigen::Index>(family[i].neighbour);
      const Kinematics<> other{state(0, j), state(1, j), state(2, j)};
      const double curvature = curvature_difference(bond, own, other);
      dilatation += weights.D * curvature;
      sum += bond_energy(weights.B, weights.S, curvature, shear_difference(bond, own, other));
    }
    result[k] = dilatation_stiffness_[k] / 2 * dilatation * dilatation + area_[k] * sum;
  }
  elastic_supports_.add_energies(state, result);
  return result;
}

Forces force_of_curvature(const geometry::Families& families, const std::vector<BondShape>& shapes,
                          const std::vector<double>& areas, const HorizonWeights& weights,
                          const Eigen::VectorXd& curvature, const PointMap& map) {
  constexpr double rounding = 1e-12;  // of bonds whose couples cancel
  Forces result = zero_forces(areas.size());
  double largest = 0;
  for (Eigen::Index k = 0; k < curvature.size(); ++k) {
    const auto family = families[std::size_t(k)];
    double dilatation = 0;  // of unit curvature
    for (std::size_t i = 0; i < family.size(); ++i)
      dilatation += weights.of(std::size_t(k), i).D * shapes[family[i].vector_id].length;
    const double a = weights.a[weights.kind[std::size_t(k)]];
    for (std::size_t i = 0; i < family.size(); ++i) {
      const BondShape& bond = shapes[family[i].vector_id];
      const BondWeights& own = weights.of(std::size_t(k), i);
      const double couple = -2 * areas[std::size_t(k)] * curvature[k] * (a * dilatation * own.D + own.B * bond.length);
      const Eigen::Vector2d theta(couple * bond.mx, couple * bond.my);
      result.col(Eigen::Index(family[i].neighbour)).tail<2>() += theta;
      result.col(k).tail<2>() -= theta;
      if (map.owns(std::size_t(k))) largest = std::max(largest, std::abs(couple));
    }
  }
  largest = largest_of(map, largest);
  return (result.array().abs() > rounding * largest).select(result, 0);
}

}  // namespace plate
