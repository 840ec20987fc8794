#include "plate/solve/coupled_plate.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/complementarity.hpp"
#include "plate/solve/plate_in_contact.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/stretching.hpp"

namespace plate {

PointMatrix stacked_matrix(const PointMatrix& plate, const PointMatrix& plane, const PointMatrix& coupling) {
  const auto points = std::uint32_t(plate.points());
  PointMatrix result;
  const auto take = [&](std::uint32_t row, const Eigen::Matrix3d& block) {
    result.row.push_back(row), result.block.push_back(block);
  };
  struct Above {
    std::uint32_t row;
    std::size_t block;
  };
  std::vector<std::vector<Above>> above(points);  // by columns, ascending
  for (std::uint32_t k = 0; k < points; ++k)
    for (auto b = coupling.first[k]; b < coupling.first[k + 1]; ++b)
      if (coupling.row[b] != k) above[coupling.row[b]].push_back({k, b});
  for (std::uint32_t k = 0; k < points; ++k) {
    for (auto b = plate.first[k]; b < plate.first[k + 1]; ++b) take(plate.row[b], plate.block[b]);
    for (const auto& [row, b] : above[k]) take(points + row, coupling.block[b].transpose());
    for (auto b = coupling.first[k]; b < coupling.first[k + 1]; ++b) take(points + coupling.row[b], coupling.block[b]);
    result.first.push_back(result.row.size());
  }
  for (std::uint32_t k = 0; k < points; ++k) {
    for (auto b = plane.first[k]; b < plane.first[k + 1]; ++b) take(points + plane.row[b], plane.block[b]);
    result.first.push_back(result.row.size());
  }
  return result;
}

PointMatrix Formulation::coupling() const {
  throw std::logic_error("a coupling was asked of a formulation that does not offer it");
}

MassOffsets Formulation::mass_offsets() const {
  throw std::logic_error("mass off the middle plane was asked of a formulation that does not offer it");
}

PointMatrix Formulation::with_coupling_forces(PointMatrix, const State&, const State&) const {
  throw std::logic_error("forces of a coupling were asked of a formulation that does not offer it");
}

PointMatrix Stretching::stiffness_of_forces(const Eigen::Matrix3Xd&) const {
  throw std::logic_error("given membrane forces were asked of a formulation that does not offer them");
}

namespace {

/// Stiffness of stacked states.
class StackedPlate : public Operator {
public:
  StackedPlate(const Operator& plate, const Operator& membrane, const PointMatrix& coupling)
      : plate_(plate), membrane_(membrane), coupling_(coupling) {}

  std::size_t points() const override { return 2 * plate_.points(); }
  void internal_force(const State& state, Forces& forces) const override {
    const State bending = of_plate(state), in_plane = of_plane(state);
    Forces on_bending, on_membrane;
    plate_.internal_force(bending, on_bending), membrane_.internal_force(in_plane, on_membrane);
    forces = stacked(on_bending - product(coupling_, in_plane), on_membrane - product(coupling_, bending));
  }
  void absolute_product(const State& state, Forces& forces) const override {
    PointMatrix sizes = coupling_;
    for (auto& block : sizes.block) block = block.cwiseAbs().eval();
    const State bending = of_plate(state), in_plane = of_plane(state);
    Forces on_bending, on_membrane;
    plate_.absolute_product(bending, on_bending), membrane_.absolute_product(in_plane, on_membrane);
    forces = stacked(on_bending + product(sizes, in_plane), on_membrane + product(sizes, bending));
  }
  Forces diagonal() const override { return stacked(plate_.diagonal(), membrane_.diagonal()); }

private:
  const Operator &plate_, &membrane_;
  const PointMatrix& coupling_;
};

/// Coupling of a plate; a matrix without blocks where its section does not couple.
PointMatrix coupling_or_none(const Formulation& plate) {
  if (plate.problem().coupled()) return plate.coupling();
  PointMatrix result;
  result.first.assign(plate.points() + 1, 0);
  return result;
}

}  // namespace

std::unique_ptr<const Operator> CoupledPlate::stiffness(const Operator& plate, const Operator& membrane,
                                                        const PointMatrix& coupling) {
  return std::make_unique<const StackedPlate>(plate, membrane, coupling);
}

/// A plate and its plane with given contact of the soil, and what gaps at supports that only push and forces between
/// faces of cracks do to the forces of those supports and the openings of those faces.
class CoupledPlate::Linear {
public:
  Linear(const CoupledPlate& of, const ContactState& touching);

  /// Gaps and forces of which none is negative, nor are these forces of supports and openings, and one of both is zero.
  Contacts contacts(const Eigen::VectorXd& reactions, const Eigen::VectorXd& openings) const;

  PlateInContact plate;
  std::unique_ptr<const Operator> stiffness;
  AssembledPlate factor;

private:
  void add_gaps(const CoupledPlate& of);
  Eigen::VectorXd solved(const Eigen::VectorXd& c) const;

  Eigen::Index gaps_;       // number of these
  Eigen::MatrixXd matrix_;  // of gaps, then of faces, with ones at most on its diagonal
  Eigen::VectorXd scale_;   // which makes them so
};

CoupledPlate::Linear::Linear(const CoupledPlate& of, const ContactState& touching)
    : plate(of.plate_, of.plate_.boundary().elastic_supports, touching),
      stiffness(CoupledPlate::stiffness(plate, of.membrane_, of.coupling_)),
      factor(*stiffness, of.constraints_,
             stacked_matrix(with_contact_at(touching, of.plate_.boundary().elastic_supports, of.plate_.stiffness()),
                            of.membrane_.stiffness(), of.coupling_),
             of.plate_.distributed() ? &of.plate_.boundary() : nullptr),
      gaps_(of.pushed_ ? Eigen::Index(of.pushed_->size()) : 0) {
  const auto faces = of.rows_ ? 2 * of.rows_->arms().size() : 0;
  matrix_.setZero(gaps_ + faces, gaps_ + faces);
  if (of.rows_) {
    std::vector<Eigen::Index> all(std::size_t(faces), 0);
    std::iota(all.begin(), all.end(), 0);
    const auto found =
        of.rows_->columns(all, of.plate_.points(), [&](const auto& loads) { return factor.solve(loads); });
    Eigen::MatrixXd compliance = (found + found.transpose()) / 2;
    lift_compliance(compliance);
    matrix_.bottomRightCorner(faces, faces) = compliance;
  }
  if (gaps_ > 0) add_gaps(of);
  scale_ = matrix_.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1.0; });
  if (gaps_ > 0)  // by the largest: those of points that lift without resistance are rounding
    scale_.head(gaps_).setConstant(1 / std::sqrt(std::max(matrix_.diagonal().head(gaps_).maxCoeff(), 1e-300)));
  matrix_ = (scale_.asDiagonal() * matrix_ * scale_.asDiagonal()).eval();
}

/// Unit gaps move the faces by what unit forces on these take from the supports (Betti).
void CoupledPlate::Linear::add_gaps(const CoupledPlate& of) {
  constexpr Eigen::Index at_once = 32;  // as many states are held
  const auto faces = matrix_.rows() - gaps_;
  for (Eigen::Index first = 0; first < gaps_; first += at_once) {
    const auto count = std::min(gaps_ - first, at_once);
    std::vector<Forces> pulls{std::size_t(count)};
    std::vector<State> lifts;
    for (Eigen::Index i = 0; i < count; ++i) {
      const State lift = of.pushed_->lift(std::size_t(first + i));
      lifts.push_back(stacked(lift, zero_like(lift)));
      stiffness->internal_force(lifts.back(), pulls[std::size_t(i)]);
    }
    auto states = factor.solve(pulls);
    for (Eigen::Index i = 0; i < count; ++i) {
      auto& state = states[std::size_t(i)];
      state += lifts[std::size_t(i)];
      stiffness->internal_force(state, pulls[std::size_t(i)]);
      matrix_.col(first + i).head(gaps_) = of.pushed_->reactions(of_plate(pulls[std::size_t(i)]));
      if (faces > 0) matrix_.col(first + i).tail(faces) = of.rows_->openings(of_plate(state), of_plane(state));
    }
  }
  const Eigen::MatrixXd of_gaps = matrix_.topLeftCorner(gaps_, gaps_);
  matrix_.topLeftCorner(gaps_, gaps_) = (of_gaps + of_gaps.transpose()) / 2;
  matrix_.topRightCorner(gaps_, faces) = -matrix_.bottomLeftCorner(faces, gaps_).transpose();
}

/// Without resistance of the plate a gap is as large as the share that lifts its stiffness makes it.
Eigen::VectorXd CoupledPlate::Linear::solved(const Eigen::VectorXd& c) const {
  constexpr double share = 1e-11, same = 0.01;
  constexpr auto mixed = Complementarity::Shape::mixed;
  if (gaps_ == 0) return Complementarity(matrix_, c).x;
  Eigen::MatrixXd lifted = matrix_;
  lifted.diagonal().head(gaps_).array() += share;
  try {
    const Eigen::VectorXd near = Complementarity(lifted, c, {}, mixed).x;
    std::vector<Eigen::Index> active;
    for (Eigen::Index i = 0; i < near.size(); ++i)
      if (near[i] > 0) active.push_back(i);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(near.size());
    if (active.empty()) return result;
    result(active) = Complementarity(matrix_(active, active), c(active), std::vector<char>(active.size(), 1), mixed).x;
    if ((result - near).norm() < same * near.norm()) return result;
  } catch (const NumericalError&) {
    throw NumericalError(flies_off_supports);
  }
  throw NumericalError(flies_off_supports);
}

CoupledPlate::Contacts CoupledPlate::Linear::contacts(const Eigen::VectorXd& reactions,
                                                      const Eigen::VectorXd& openings) const {
  const auto faces = openings.size();
  Eigen::VectorXd c(matrix_.rows());
  c.head(gaps_) = reactions, c.tail(faces) = openings;
  c = c.cwiseProduct(scale_).eval();
  const Eigen::VectorXd x = solved(c);
  Eigen::VectorXd rest = matrix_ * x + c;
  for (Eigen::Index i = 0; i < rest.size(); ++i)
    if (x[i] > 0) rest[i] = 0;
  return {.gaps = x.head(gaps_).cwiseProduct(scale_.head(gaps_)),
          .openings = rest.tail(faces).cwiseQuotient(scale_.tail(faces)),
          .forces = x.tail(faces).cwiseProduct(scale_.tail(faces))};
}

CoupledPlate::CoupledPlate(const Formulation& plate, const Formulation& membrane)
    : plate_(plate), membrane_(membrane), coupling_(coupling_or_none(plate)) {
  constraints_ =
      stacked(plate.distributed() ? plate.constraints_about() : plate.constraints(), pinned(membrane), plate.points());
  if (plate.problem().faces_touch()) rows_.emplace(plate);
  if (rows_ && rows_->pairs().empty()) rows_.reset();
  if (plate.problem().pushed()) pushed_.emplace(plate);
  everywhere_ = std::make_unique<const Linear>(*this, everywhere(plate.boundary().elastic_supports));
}

CoupledPlate::~CoupledPlate() = default;

const Operator& CoupledPlate::of_both() const {
  return *everywhere_->stiffness;
}

const Preconditioner& CoupledPlate::inverse() const {
  return everywhere_->factor;
}

std::size_t CoupledPlate::factor_bytes() const {
  return everywhere_->factor.bytes();
}

/// The second solution takes out what rounding beside the forces of the lift has left.
StaticSolution CoupledPlate::linear(const Linear& both, const PlateLoads& loads, const StaticOptions& options,
                                    const State& lift) const {
  const Forces load = stacked(loads.across, loads.in_plane);
  if (lift.cols() == 0) return refined(*both.stiffness, constraints_, load, options, both.factor);
  StaticSolution result;
  result.state = stacked(lift, zero_like(lift)), result.converged = true;
  for (int twice = 0; twice < 2 && result.converged; ++twice) {
    Forces left;
    both.stiffness->internal_force(result.state, left);
    const auto more = refined(*both.stiffness, constraints_, left + load, options, both.factor);
    result.state += more.state, result.iterations += more.iterations;
    result.converged = more.converged, result.stop_reason = more.stop_reason;
  }
  const Forces across = loads.across - product(coupling_, of_plane(result.state));
  result.residual = PrescribedDisplacements(plate_, across, lift, &both.plate).residual(of_plate(result.state)).share;
  return result;
}

/// Loads with the forces between faces.
PlateLoads CoupledPlate::with_contact(const PlateLoads& loads, const Contacts& contacts) const {
  PlateLoads result{loads.across, loads.in_plane};
  if (rows_) rows_->press(contacts.forces, result.across, result.in_plane);
  return result;
}

/// Lift with the gaps at supports that only push.
State CoupledPlate::with_gaps(const State& lift, const Contacts& contacts) const {
  if (!pushed_) return lift;
  const State gaps = pushed_->lift(contacts.gaps);
  return lift.cols() > 0 ? State(gaps + lift) : gaps;
}

/// Equilibrium with given contact of the soil, in which nothing overlaps on cracks and no support that only pushes
/// pulls.
StaticSolution CoupledPlate::touched(const Linear& both, const PlateLoads& loads, const StaticOptions& options,
                                     const State& lift, Contacts& contacts) const {
  auto free = linear(both, loads, options, lift);
  if (!(rows_ || pushed_) || !free.converged) return free;
  Eigen::VectorXd reactions, openings;
  if (pushed_) {
    Forces forces;
    both.stiffness->internal_force(free.state, forces);
    reactions = pushed_->reactions(of_plate(forces) + loads.across);
  }
  if (rows_) {
    const State bending = of_plate(free.state), in_plane = of_plane(free.state);
    const Eigen::VectorXd found = rows_->openings(bending, in_plane);
    openings = (found.array().abs() > rows_->error_of_openings(bending, in_plane)).select(found, 0);
  }
  contacts = both.contacts(reactions, openings);
  auto result = linear(both, with_contact(loads, contacts), options, with_gaps(lift, contacts));
  result.iterations += free.iterations;
  return result;
}

/// Equilibrium with the contact of the soil that its state has.
StaticSolution CoupledPlate::on_soil(const PlateLoads& loads, const StaticOptions& options, const State& lift,
                                     Contacts& contacts) const {
  const auto& elastic_supports = plate_.boundary().elastic_supports;
  const auto solve = [&](const ContactState& soil, const State* start) {
    if (!start) return touched(*everywhere_, loads, options, lift, contacts);
    return touched(Linear(*this, soil), loads, options, lift, contacts);
  };
  const auto touching = [&](const State& state) { return elastic_supports.touching(of_plate(state)); };
  const auto energy = [&](const State& state) {
    StaticSolution both;
    both.state = state;
    return parts_of(std::move(both)).strain_energy() + potential(plate_, loads.across, of_plate(state)) +
           potential(membrane_, loads.in_plane, of_plane(state));
  };
  auto result = contact_with_soil(plate_, {solve, touching, energy});
  if (!result.converged) return result;
  const Forces across = with_contact(loads, contacts).across - product(coupling_, of_plane(result.state));
  require_contact(plate_, across, with_gaps(lift, contacts), of_plate(result.state));
  return result;
}

CoupledEquilibrium CoupledPlate::parts_of(StaticSolution both) const {
  CoupledEquilibrium result;
  result.of_both = std::move(both);
  result.bending = of_plate(result.of_both.state), result.membrane = of_plane(result.of_both.state);
  result.on_bending = -product(coupling_, result.membrane), result.on_membrane = -product(coupling_, result.bending);
  result.bending_energy = plate_.strain_energy(result.bending);
  result.stretching_energy = membrane_.strain_energy(result.membrane);
  result.coupling_energy =
      -plate_.sum_of_points(result.on_bending.cwiseProduct(result.bending).colwise().sum().transpose());
  return result;
}

CoupledEquilibrium CoupledPlate::equilibrium(const PlateLoads& loads, const StaticOptions& options,
                                             const State& lift) const {
  const auto [rigid, rest] = split_lift(plate_, lift);
  Contacts contacts;
  auto result = parts_of(plate_.problem().unilateral() ? on_soil(loads, options, rest, contacts)
                                                       : touched(*everywhere_, loads, options, rest, contacts));
  if (plate_.problem().faces_touch()) result.touching.emplace();
  if (rows_ && contacts.forces.size() > 0) result.touching->faces = rows_->contacts(contacts.openings, contacts.forces);
  if (pushed_) result.lifted = pushed_->lifted(contacts.gaps);
  if (rigid.cols() > 0) result.strained = result.bending, result.bending += rigid;
  return result;
}

}  // namespace plate
