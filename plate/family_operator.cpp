#include "plate/family_operator.hpp"

#include <experimental/simd>

namespace plate {
namespace {

constexpr std::uint32_t longest_run = 128;

/// As many points at once as the machine's vectors hold.
namespace simd = std::experimental;
using Lanes = simd::native_simd<double>;
constexpr std::size_t lanes = Lanes::size();

template <typename Value>
Value load(const Eigen::ArrayXd& values, std::size_t k) {
  if constexpr (std::is_same_v<Value, double>)
    return values[static_cast<Eigen::Index>(k)];
  else
    return Value(values.data() + k, simd::element_aligned);
}

template <typename Value>
void store(Eigen::ArrayXd& values, std::size_t k, const Value& value) {
  if constexpr (std::is_same_v<Value, double>)
    values[static_cast<Eigen::Index>(k)] = value;
  else
    value.copy_to(values.data() + k, simd::element_aligned);
}

/// The matrix of absolute values of a bond: |m|, and sums in place of differences.
template <typename Value>
Value curvature_sum(const BondShape& bond, const Kinematics<Value>& k, const Kinematics<Value>& j) {
  return bond.mx * (j.theta_x + k.theta_x) + bond.my * (j.theta_y + k.theta_y);
}

template <typename Value>
Value shear_sum(const BondShape& bond, const Kinematics<Value>& k, const Kinematics<Value>& j) {
  return j.w + k.w + bond.length / 2 * curvature_sum(bond, k, j);
}

/// Calls many(k) for as many points at a time as there are lanes, one(k) in shorter runs. The last lanes of a run may
/// overlap those before: the same values are computed twice.
template <typename Many, typename One>
void for_each(const geometry::FamilyRuns& runs, const Many& many, const One& one) {
#pragma omp for schedule(static)
  for (std::size_t r = 0; r < runs.runs.size(); ++r) {
    const auto& run = runs.runs[r];
    const std::size_t first = run.first_point, end = first + run.length;
    if (run.length < lanes)
      for (std::size_t k = first; k < end; ++k) one(k, run.pattern);
    else
      for (std::size_t k = first; k < end; k += lanes) many(std::min(k, end - lanes), run.pattern);
  }
}

}  // namespace

FamilyOperator::FamilyOperator(geometry::Families families, std::vector<BondShape> shapes,
                               const std::vector<double>& areas, const std::vector<PointParameters>& parameters)
    : families_(std::move(families)), runs_(geometry::family_runs(families_, longest_run)), shapes_(std::move(shapes)) {
  const auto count = static_cast<Eigen::Index>(areas.size());
  for (auto* values : {&area_, &a_, &b_, &d_, &half_shear_, &w_, &theta_x_, &theta_y_, &q_}) values->setZero(count);
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < count; ++k) {
    const PointParameters& p = parameters[static_cast<std::size_t>(k)];
    area_[k] = areas[static_cast<std::size_t>(k)];
    a_[k] = p.a, b_[k] = p.b, d_[k] = p.d, half_shear_[k] = p.C / 2;
  }
}

template <typename Value>
Kinematics<Value> FamilyOperator::kinematics(std::size_t k) const {
  return {load<Value>(w_, k), load<Value>(theta_x_, k), load<Value>(theta_y_, k)};
}

template <bool absolute, typename Value>
void FamilyOperator::dilatations(std::size_t k, std::uint32_t pattern, const std::vector<BondShape>& shapes) const {
  const Kinematics<Value> own = kinematics<Value>(k);
  Value sum = 0;
  for (auto b = runs_.pattern_first[pattern]; b < runs_.pattern_first[pattern + 1]; ++b) {
    const BondShape& bond = shapes[runs_.bonds[b].vector_id];
    const std::size_t j = k + static_cast<std::size_t>(static_cast<std::ptrdiff_t>(runs_.bonds[b].step));
    const Kinematics<Value> other = kinematics<Value>(j);
    const Value difference = absolute ? curvature_sum(bond, own, other) : curvature_difference(bond, own, other);
    sum += bond.weight * load<Value>(area_, j) * difference;
  }
  const Value a = load<Value>(a_, k), d = load<Value>(d_, k);
  if constexpr (absolute) {
    using std::abs;
    store<Value>(q_, k, 2 * abs(a) * d * d * sum);
  } else {
    store<Value>(q_, k, 2 * a * d * d * sum);
  }
}

template <bool absolute, typename Value>
void FamilyOperator::gather(std::size_t k, std::uint32_t pattern, const std::vector<BondShape>& shapes,
                            Forces& forces) const {
  const Kinematics<Value> own = kinematics<Value>(k);
  const Value area = load<Value>(area_, k), q = load<Value>(q_, k), b_own = load<Value>(b_, k),
              shear_own = load<Value>(half_shear_, k);
  Value force = 0, couple_x = 0, couple_y = 0;
  for (auto b = runs_.pattern_first[pattern]; b < runs_.pattern_first[pattern + 1]; ++b) {
    const BondShape& bond = shapes[runs_.bonds[b].vector_id];
    const std::size_t j = k + static_cast<std::size_t>(static_cast<std::ptrdiff_t>(runs_.bonds[b].step));
    const Kinematics<Value> other = kinematics<Value>(j);
    const Value curvature = absolute ? curvature_sum(bond, own, other) : curvature_difference(bond, own, other);
    const Value shear = absolute ? shear_sum(bond, own, other) : shear_difference(bond, own, other);
    const BondForce<Value> f = bond_force<Value>(bond, area * load<Value>(area_, j) * bond.weight,
                                                 q + load<Value>(q_, j), b_own + load<Value>(b_, j),
                                                 shear_own + load<Value>(half_shear_, j), curvature, shear);
    force += f.force;
    couple_x += bond.mx * f.couple;
    couple_y += bond.my * f.couple;
  }
  double* const out = forces.data() + 3 * k;
  if constexpr (std::is_same_v<Value, double>)
    out[0] = force, out[1] = couple_x, out[2] = couple_y;
  else
    for (std::size_t i = 0; i < lanes; ++i) out[3 * i] = force[i], out[3 * i + 1] = couple_x[i], out[3 * i + 2] = couple_y[i];
}

template <bool absolute>
void FamilyOperator::product(const State& state, Forces& forces) const {
  const auto count = static_cast<Eigen::Index>(points());
  forces.resize(3, count);
  std::vector<BondShape> shapes = shapes_;
  if constexpr (absolute)
    for (auto& bond : shapes) bond.mx = std::abs(bond.mx), bond.my = std::abs(bond.my);
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (Eigen::Index k = 0; k < count; ++k)
      w_[k] = state(0, k), theta_x_[k] = state(1, k), theta_y_[k] = state(2, k);
    for_each(
        runs_, [&](std::size_t k, std::uint32_t pattern) { dilatations<absolute, Lanes>(k, pattern, shapes); },
        [&](std::size_t k, std::uint32_t pattern) { dilatations<absolute, double>(k, pattern, shapes); });
    for_each(
        runs_, [&](std::size_t k, std::uint32_t pattern) { gather<absolute, Lanes>(k, pattern, shapes, forces); },
        [&](std::size_t k, std::uint32_t pattern) { gather<absolute, double>(k, pattern, shapes, forces); });
  }
}

void FamilyOperator::internal_force(const State& state, Forces& forces) const { product<false>(state, forces); }

void FamilyOperator::absolute_product(const State& state, Forces& forces) const { product<true>(state, forces); }

Forces FamilyOperator::diagonal() const {
  Forces result(3, static_cast<Eigen::Index>(points()));
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    double force = 0;
    Eigen::Array2d couple(0, 0), gradient(0, 0);
    for (auto b = families_.first[std::size_t(k)]; b < families_.first[std::size_t(k) + 1]; ++b) {
      const BondShape& bond = shapes_[families_.vector_id[b]];
      const auto j = static_cast<Eigen::Index>(families_.neighbour[b]);
      const Eigen::Array2d m(bond.mx, bond.my);
      const double pair = area_[k] * area_[j] * bond.weight, C = half_shear_[k] + half_shear_[j];
      const double through_neighbour = d_[j] * bond.weight * area_[k];
      force += pair * C;
      couple += m * m * (pair * (2 * (b_[k] + b_[j]) + C * bond.length * bond.length / 4) +
                         2 * a_[j] * area_[j] * through_neighbour * through_neighbour);
      gradient += m * (d_[k] * bond.weight * area_[j]);
    }
    couple += gradient * gradient * (2 * a_[k] * area_[k]);
    result.col(k) << force, couple.x(), couple.y();
  }
  return result;
}

Eigen::VectorXd FamilyOperator::energies(const State& state) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(points()));
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < result.size(); ++k) {
    const Kinematics<> own{state(0, k), state(1, k), state(2, k)};
    double dilatation = 0, sum = 0;
    for (auto b = families_.first[std::size_t(k)]; b < families_.first[std::size_t(k) + 1]; ++b) {
      const BondShape& bond = shapes_[families_.vector_id[b]];
      const auto j = static_cast<Eigen::Index>(families_.neighbour[b]);
      const Kinematics<> other{state(0, j), state(1, j), state(2, j)};
      const double curvature = curvature_difference(bond, own, other), shear = shear_difference(bond, own, other);
      dilatation += d_[k] * bond.weight * area_[j] * curvature;
      sum += bond_energy(bond, area_[j], b_[k], 2 * half_shear_[k], curvature, shear);
    }
    result[k] = area_[k] * (a_[k] * dilatation * dilatation + sum);
  }
  return result;
}

}  // namespace plate
