#include "plate/solve/prescribed_displacements.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"

namespace plate {
namespace {

/// True where an entry of values [3 x points] is of an owned point.
bool owns(const Formulation& plate, std::size_t entry) {
  return plate.boundary().owns(entry % plate.points());
}

/// Norm of forces where there is stiffness, each weighted by the displacement that it causes; the measure of the
/// solvers.
double norm(const Formulation& plate, const Forces& forces, const Forces& diagonal) {
  const auto of_dof = [&](std::size_t i) {
    const double f = forces.data()[i], d = diagonal.data()[i];
    return std::array<double, 1>{d > 0 && owns(plate, i) ? f * f / d : 0};
  };
  return std::sqrt(ordered_sum<1>(plate, std::size_t(forces.size()), of_dof)[0]);
}

/// `factor` of every load.
template <typename Factor>
State sum_of_lifts(const std::vector<TimedLoad>& loads, const Factor& factor) {
  State lift = no_state();
  for (const auto& one : loads) {
    if (!one.lifts()) continue;
    if (lift.cols() == 0) lift = zero_state(one.lift.cols());
    lift += factor(one) * one.lift;
  }
  return lift;
}

}  // namespace

bool has_prescribed_displacements(const Formulation& plate) {
  return std::ranges::any_of(plate.loads(), [](const TimedLoad& load) { return load.lifts(); });
}

State total_lift(const Formulation& plate) {
  return sum_of_lifts(plate.loads(), [](const TimedLoad&) { return 1.0; });
}

State lift_at(const Formulation& plate, double time) {
  return sum_of_lifts(plate.loads(), [time](const TimedLoad& one) { return factor(one.history, time); });
}

State first_lift(const Formulation& plate) {
  return lift_at(plate, 0);
}

Forces unconstrained_mass(const Formulation& plate, double rotary) {
  return mass(plate.sections(), plate.cloud().areas, plate.boundary().active, {}, rotary);
}

bool cancel(const Formulation& plate, const std::vector<Forces>& loads) {
  constexpr double rounding = 1e-12;
  if (loads.size() < 2) return false;
  const auto size = [&](Forces force) {
    plate.constraints().fold(force);
    return std::sqrt(ordered_sum<1>(plate, std::size_t(force.size()), [&](std::size_t i) {
      return std::array<double, 1>{force.data()[i] * force.data()[i]};
    })[0]);
  };
  double largest = 0;
  Forces sum = zero_forces(loads.front().cols());
  for (const auto& load : loads) largest = std::max(largest, size(load)), sum += load;
  return largest > 0 && size(std::move(sum)) <= rounding * largest;
}

Forces acting_load(const Formulation& plate) {
  std::vector<Forces> all;
  for (const auto& load : plate.loads()) all.push_back(load.forces);
  const auto sum = plate.total_load();
  return cancel(plate, all) ? zero_like(sum) : sum;
}

namespace {

/// Three motions of the plate as a rigid body: along w, and turns about the middle of its box that move the ends of the
/// box by about one.
class RigidMotions {
public:
  explicit RigidMotions(const Formulation& plate) : positions_(plate.cloud().positions) {
    const auto [low, high] = geometry::bounding_box(plate.problem().outline);
    middle_ = (low + high) / 2, size_ = (high - low).norm() / 2;
  }

  /// psi = (-theta_y, theta_x) is the slope of w.
  State sum(const Eigen::Vector3d& shares) const {
    const geometry::Point slope(shares[1] / size_, shares[2] / size_);
    State result(unknowns_per_point, Eigen::Index(positions_.size()));
    for (std::size_t k = 0; k < positions_.size(); ++k)
      result.col(Eigen::Index(k)) << shares[0] + slope.dot(positions_[k] - middle_), slope.y(), -slope.x();
    return result;
  }

  double size() const { return size_; }

private:
  const std::vector<geometry::Point>& positions_;
  geometry::Point middle_{0, 0};
  double size_ = 1;
};

/// The sum of `bodies` next to `lift`, rotations weighted by `size`.
Eigen::Vector3d nearest_sum(const Formulation& plate, const std::array<State, 3>& bodies, const State& lift,
                            double size) {
  const auto terms = ordered_sum<9>(plate, std::size_t(lift.cols()), [&](std::size_t i) -> std::array<double, 9> {
    if (!plate.boundary().owns(i)) return {};
    const auto k = Eigen::Index(i);
    const auto at = [&](const State& state) {
      return PointValues(state(0, k), size * state(1, k), size * state(2, k));
    };
    const auto a = at(bodies[0]), b = at(bodies[1]), c = at(bodies[2]), l = at(lift);
    return {a.dot(a), a.dot(b), a.dot(c), b.dot(b), b.dot(c), c.dot(c), a.dot(l), b.dot(l), c.dot(l)};
  });
  Eigen::Matrix3d products;
  products << terms[0], terms[1], terms[2], terms[1], terms[3], terms[4], terms[2], terms[4], terms[5];
  return products.completeOrthogonalDecomposition().solve(Eigen::Vector3d(terms[6], terms[7], terms[8]));
}

}  // namespace

LiftParts split_lift(const Formulation& plate, const State& lift) {
  constexpr double rounding = 1e-12;
  if (lift.cols() == 0 || plate.problem().elastically_supported()) return {no_state(), lift};
  const RigidMotions motions(plate);
  std::array<State, 3> bodies;  // what they move of what is held, beside what that follows
  for (Eigen::Index i = 0; i < 3; ++i) {
    auto& body = bodies[std::size_t(i)] = motions.sum(Eigen::Vector3d::Unit(i));
    State carried = body;
    plate.constraints().impose(carried);
    body -= carried;
  }
  Eigen::Vector3d shares = Eigen::Vector3d::Zero();
  LiftParts result{no_state(), lift};
  for (int twice = 0; twice < 2; ++twice) {  // the second time takes out what rounding left
    const Eigen::Vector3d more = nearest_sum(plate, bodies, result.rest, motions.size());
    for (std::size_t i = 0; i < 3; ++i) result.rest -= more[Eigen::Index(i)] * bodies[i];
    shares += more;
  }
  const auto largest = [&](const State& state) {
    return largest_of(plate, std::max(state.row(0).cwiseAbs().maxCoeff(),
                                      motions.size() * state.bottomRows(2).cwiseAbs().maxCoeff()));
  };
  if (largest(result.rest) <= rounding * largest(lift)) result.rest.setZero();
  result.rigid = motions.sum(shares);
  return result;
}

LoadParts split_load(const Formulation& plate, const Forces& load) {
  constexpr double rounding = 1e-12;
  const auto& supports = plate.boundary().elastic_supports;
  const auto& constraints = plate.constraints();
  const LoadParts none{no_state(), load};
  if (largest_of(plate, constraints.held().empty() ? 0 : 1) > 0 || !plate.offers(Feature::symmetry)) return none;
  const RigidMotions motions(plate);
  std::array<State, 3> bodies;
  std::array<Forces, 3> pressed;
  for (std::size_t i = 0; i < 3; ++i) {
    bodies[i] = motions.sum(Eigen::Vector3d::Unit(Eigen::Index(i)));
    State moved = bodies[i];
    constraints.impose(moved);
    if (largest_of(plate, (moved - bodies[i]).cwiseAbs().maxCoeff()) > rounding) return none;
    supports.add_force(bodies[i], pressed[i] = zero_like(load));
  }
  const auto work = [&](const Forces& forces) -> Eigen::Vector3d {
    const auto terms = ordered_sum<3>(plate, plate.points(), [&](std::size_t k) -> std::array<double, 3> {
      if (!plate.boundary().owns(k)) return {};
      const auto at = [&](const State& body) { return body.col(Eigen::Index(k)).dot(forces.col(Eigen::Index(k))); };
      return {at(bodies[0]), at(bodies[1]), at(bodies[2])};
    });
    return {terms[0], terms[1], terms[2]};
  };
  Eigen::Matrix3d stiffness;
  for (Eigen::Index i = 0; i < 3; ++i) stiffness.col(i) = -work(pressed[std::size_t(i)]);
  const Eigen::LDLT<Eigen::Matrix3d> inverse((stiffness + stiffness.transpose()) / 2);
  if (inverse.info() != Eigen::Success || !(inverse.rcond() > rounding) || !inverse.isPositive()) return none;
  LoadParts result{no_state(), load};
  Eigen::Vector3d shares = Eigen::Vector3d::Zero();
  for (int twice = 0; twice < 2; ++twice) {  // the second time takes out what rounding left
    const Eigen::Vector3d more = inverse.solve(work(result.rest));
    for (std::size_t i = 0; i < 3; ++i) result.rest += more[Eigen::Index(i)] * pressed[i];
    shares += more;
  }
  const auto largest = [&](const Forces& forces) { return largest_of(plate, forces.cwiseAbs().maxCoeff()); };
  if (largest(result.rest) <= rounding * largest(load)) result.rest.setZero();
  result.rigid = motions.sum(shares);
  return result;
}

PrescribedDisplacements::PrescribedDisplacements(const Formulation& plate, const Forces& load, const State& lift,
                                                 const Operator* stiffness)
    : plate_(plate), stiffness_(stiffness ? *stiffness : plate), load_(load), lift_(lift) {}

Forces PrescribedDisplacements::force(const State& state) const {
  Forces result;
  stiffness_.internal_force(state, result);
  return result + load_;
}

PrescribedDisplacements::Residual PrescribedDisplacements::residual(const State& state) const {
  constexpr double rounding = 1e-13;
  const auto& constraints = plate_.constraints();
  const Forces diagonal = plate_.diagonal(), whole = force(state);
  Forces folded = diagonal;
  constraints.fold_diagonal(folded);
  Forces reaction = zero_like(whole);
  for (const auto dof : constraints.held()) at_dof(reaction, dof) = at_dof(whole, dof);
  Residual result{whole};
  constraints.fold(result.force);
  Forces at_first = pull();
  constraints.fold(at_first);
  const double left = norm(plate_, result.force, folded);
  const double size = std::max(norm(plate_, load_, diagonal), norm(plate_, reaction, diagonal));
  if (left > rounding * norm(plate_, at_first, folded)) result.share = left / size;
  return result;
}

double PrescribedDisplacements::work(const State& state) const {
  if (lift_.cols() == 0) return 0;
  const Forces whole = force(state);
  const auto of_dof = [&](std::size_t i) {
    return std::array<double, 1>{owns(plate_, i) ? whole.data()[i] * lift_.data()[i] : 0};
  };
  return -ordered_sum<1>(plate_, std::size_t(whole.size()), of_dof)[0] / 2;
}

}  // namespace plate
