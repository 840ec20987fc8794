#include "plate/solve/crack_contact.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/complementarity.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/large_deflections.hpp"

namespace plate {
namespace {

/// The largest displacement in the plane; of bending that of the fibre at z = 1. Of a distributed plate that of points
/// in the plate, which the plate and its plane share.
double largest_motion(const Formulation& plate, const State& state) {
  if (!plate.distributed()) return state.bottomRows(2).colwise().norm().maxCoeff();
  double result = 0;
  for (std::size_t k = 0; k < plate.cloud().plate_points; ++k)
    if (plate.boundary().owns(k)) result = std::max(result, state.col(Eigen::Index(k)).tail(2).norm());
  return largest_of(plate, result);
}

/// Lever of the forces at the faces of the plate about its middle plane: half the thickness, where two thicknesses meet
/// half the smaller one [length]. Infinite on ranks that own no point of the pair.
double lever_of(const FacePair& pair, const PointSections& sections) {
  double result = INFINITY;
  for (const auto* side : {&pair.left, &pair.right})
    for (const auto& share : *side) result = std::min(result, sections[share.point].thickness);
  return result / 2;
}

}  // namespace

Eigen::MatrixXd sum_of_ranks(const Formulation& plate, const Eigen::MatrixXd& own) {
  if (!plate.distributed()) return own;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(own.rows(), own.cols());
  for (const auto& text : texts_of_all(plate, text_of(std::vector<double>(own.data(), own.data() + own.size()))))
    result += Eigen::Map<const Eigen::MatrixXd>(values_of<double>(text).data(), own.rows(), own.cols());
  return result;
}

double lift_compliance(Eigen::MatrixXd& compliance) {
  constexpr double none = 1e-10;
  const double result = none * compliance.diagonal().maxCoeff();
  compliance.diagonal().array() += result;
  return result;
}

std::vector<FacePair> Formulation::face_pairs() const {
  return {};
}

double TouchingFaces::least_opening() const {
  double result = INFINITY;
  for (const auto& one : faces) result = std::min({result, one.opening_top, one.opening_bottom});
  return result;
}

double TouchingFaces::largest_force() const {
  double result = 0;
  for (const auto& one : faces) result = std::max({result, one.force_top, one.force_bottom});
  return result;
}

const FaceContact* TouchingFaces::next_to(const geometry::Point& tip) const {
  const auto nearest =
      std::ranges::min_element(faces, {}, [&](const FaceContact& one) { return (one.position - tip).squaredNorm(); });
  return nearest == faces.end() ? nullptr : &*nearest;
}

double TouchingFaces::length() const {
  double result = 0;
  for (const auto& one : faces) result += one.length;
  return result;
}

double TouchingFaces::closed_share() const {
  double closed = 0;
  for (const auto& one : faces)
    if (one.force_top > 0 || one.force_bottom > 0) closed += one.length;
  return faces.empty() ? 0 : closed / length();
}

FaceRows::FaceRows(const Formulation& plate)
    : plate_(plate), pairs_(plate.face_pairs()), arms_(Eigen::Index(pairs_.size())) {
  for (Eigen::Index i = 0; i < arms_.size(); ++i) arms_[i] = -lever_of(pairs_[std::size_t(i)], plate.sections());
  plate.communicator().largest({arms_.data(), pairs_.size()});
  arms_ = -arms_;
}

Eigen::MatrixXd FaceRows::compliance(std::size_t points, const Solutions& solutions) const {
  constexpr std::size_t at_once = 32;  // as many states are held
  const auto count = pairs_.size();
  Eigen::MatrixXd result(count, count);
  for (std::size_t first = 0; first < count; first += at_once) {
    std::vector<Forces> loads;
    for (auto i = first; i < std::min(count, first + at_once); ++i)
      pairs_[i].press(1, loads.emplace_back(zero_forces(points)));
    const auto states = solutions(loads);
    for (std::size_t i = 0; i < states.size(); ++i)
      for (std::size_t j = 0; j < count; ++j)
        result(Eigen::Index(j), Eigen::Index(first + i)) = pairs_[j].opening(states[i]);
  }
  result = sum_of_ranks(plate_, result);
  return (result + result.transpose()) / 2;
}

Eigen::MatrixXd FaceRows::columns(std::span<const Eigen::Index> some, std::size_t points,
                                  const Solutions& solutions) const {
  constexpr std::size_t at_once = 32;  // as many states are held
  const auto rows = 2 * arms_.size();
  Eigen::MatrixXd result(rows, Eigen::Index(some.size()));
  for (std::size_t first = 0; first < some.size(); first += at_once) {
    std::vector<Forces> loads;
    for (auto i = first; i < std::min(some.size(), first + at_once); ++i) {
      Forces on_bending = zero_forces(points), on_plane = zero_forces(points);
      press(Eigen::VectorXd::Unit(rows, some[i]), on_bending, on_plane);
      loads.push_back(stacked(on_bending, on_plane));
    }
    const auto states = solutions(loads);
    for (std::size_t i = 0; i < states.size(); ++i)
      result.col(Eigen::Index(first + i)) = openings(of_plate(states[i]), of_plane(states[i]));
  }
  return result;
}

Eigen::VectorXd FaceRows::openings(const State& bending, const State& membrane) const {
  const auto count = arms_.size();
  Eigen::MatrixXd found(count, 2);  // of both states
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& pair = pairs_[std::size_t(i)];
    found(i, 0) = pair.opening(bending), found(i, 1) = pair.opening(membrane);
  }
  found = sum_of_ranks(plate_, found);
  Eigen::VectorXd result(2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double slope = arms_[i] * found(i, 0), middle = found(i, 1);
    result[i] = middle + slope, result[count + i] = middle - slope;
  }
  return result;
}

void FaceRows::press(const Eigen::VectorXd& forces, Forces& on_bending, Forces& on_membrane) const {
  constexpr double even = 1e-9, rounding = 1e-12;  // of the forces of a pair; of the largest
  const double most = forces.cwiseAbs().maxCoeff();
  const auto count = arms_.size();
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& pair = pairs_[std::size_t(i)];
    const double top = forces[i], bottom = forces[count + i];
    pair.press(top + bottom, on_membrane);
    const double couple = std::abs(top - bottom), both = std::abs(top) + std::abs(bottom);
    if (couple > even * both && couple > rounding * most) pair.press(arms_[i] * (top - bottom), on_bending);
  }
}

double FaceRows::error_of_openings(const State& bending, const State& membrane) const {
  constexpr double share = 1e-8;  // of the largest motion: errors of equilibria
  return share * (largest_motion(plate_, membrane) + arms_.maxCoeff() * largest_motion(plate_, bending));
}

std::vector<FaceContact> FaceRows::contacts(const Eigen::VectorXd& openings, const Eigen::VectorXd& forces) const {
  const auto count = arms_.size();
  std::vector<FaceContact> result;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& pair = pairs_[std::size_t(i)];
    result.push_back({.position = pair.position,
                      .length = pair.length,
                      .opening_top = openings[i],
                      .opening_bottom = openings[count + i],
                      .force_top = forces[i] / pair.length,
                      .force_bottom = forces[count + i] / pair.length});
  }
  return result;
}

ContactOfFaces::ContactOfFaces(const Formulation& plate, const Formulation& membrane) : plate_(plate), rows_(plate) {
  if (rows_.pairs().empty()) return;
  across_ = plate.constraints_about(), in_plane_ = pinned(membrane);
  const auto factor_of = [](const Formulation& one, const Constraints& constraints) {
    return std::make_unique<AssembledPlate>(one, constraints, one.stiffness(),
                                            one.distributed() ? &one.boundary() : nullptr);
  };
  bent_ = factor_of(plate, across_), flat_ = factor_of(membrane, in_plane_);
  const auto compliance_of = [&](const AssembledPlate& one, std::size_t points) {
    return rows_.compliance(points, [&](const auto& loads) { return one.solve(loads); });
  };
  const Eigen::MatrixXd of_bending = compliance_of(*bent_, plate.points()),
                        of_plane = compliance_of(*flat_, membrane.points());
  const auto& arm = rows_.arms();
  const Eigen::MatrixXd turned = arm.asDiagonal() * of_bending * arm.asDiagonal();
  compliance_.resize(2 * arm.size(), 2 * arm.size());
  compliance_ << of_plane + turned, of_plane - turned, of_plane - turned, of_plane + turned;
  lift_compliance(compliance_);
}

ContactOfFaces::~ContactOfFaces() = default;

std::size_t ContactOfFaces::bytes() const {
  return bent_ ? bent_->bytes() + flat_->bytes() : 0;
}

TouchingFaces ContactOfFaces::operator()(const FreeFaces& free) const {
  if (rows_.pairs().empty()) return {zero_like(free.bending), zero_like(free.membrane), {}};
  Eigen::VectorXd openings = rows_.openings(free.bending, free.membrane);
  const double error = rows_.error_of_openings(free.bending, free.membrane);
  openings = (openings.array().abs() > error).select(openings, 0);
  const Complementarity found(compliance_, openings);

  TouchingFaces result;
  result.factor_bytes = bytes();
  result.faces = rows_.contacts(found.rest, found.x);
  Forces on_bending = zero_like(free.bending), on_plane = zero_like(free.membrane);
  rows_.press(found.x, on_bending, on_plane);
  result.bending = bent_->solve({on_bending}).front();
  plate_.constraints().impose(result.bending);
  result.membrane = flat_->solve({on_plane}).front();
  in_plane_.impose(result.membrane);
  return result;
}

TouchingFaces touching_faces(const Formulation& plate, const Formulation& membrane, const FreeFaces& free) {
  return ContactOfFaces(plate, membrane)(free);
}

}  // namespace plate
