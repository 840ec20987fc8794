#include "plate/solve/crack_contact.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/large_deflections.hpp"

namespace plate {
namespace {

/// The largest displacement in the plane; of bending that of the fibre at z = 1.
double largest_motion(const State& state) {
  return state.bottomRows(2).colwise().norm().maxCoeff();
}

/// Openings of all pairs by unit forces that press each of them apart: symmetric and positive [pairs x pairs].
Eigen::MatrixXd compliance(const std::vector<FacePair>& pairs, const AssembledPlate& plate, std::size_t points) {
  constexpr std::size_t at_once = 32;  // as many states are held
  const auto count = pairs.size();
  Eigen::MatrixXd result(count, count);
  for (std::size_t first = 0; first < count; first += at_once) {
    std::vector<Forces> loads;
    for (auto i = first; i < std::min(count, first + at_once); ++i)
      pairs[i].press(1, loads.emplace_back(zero_forces(points)));
    const auto states = plate.solve(loads);
    for (std::size_t i = 0; i < states.size(); ++i)
      for (std::size_t j = 0; j < count; ++j)
        result(Eigen::Index(j), Eigen::Index(first + i)) = pairs[j].opening(states[i]);
  }
  return (result + result.transpose()) / 2;
}

/// Solution x >= 0 of C x + c >= 0 with x (C x + c) = 0, of a positive C, by block principal pivoting with single
/// pivots where blocks do not end (Judice and Pires 1994).
struct Complementarity {
  Eigen::VectorXd x, rest;  // rest: C x + c
  std::size_t iterations = 0;

  Complementarity(const Eigen::MatrixXd& C, const Eigen::VectorXd& c)
      : x(Eigen::VectorXd::Zero(c.size())), rest(c), pressed_(std::size_t(c.size()), 0) {
    constexpr int tries = 5;
    const std::size_t most = 100 * pressed_.size() + 100;
    std::size_t fewest = pressed_.size() + 1;
    for (int left = tries;; ++iterations) {
      const auto wrong = wrong_ones(C.diagonal(), c);
      if (wrong.empty()) return;
      if (iterations == most)
        throw NumericalError(
            "contact of crack faces: the search for what touches does not end: take a finer spacing, or remove "
            "`contact`");
      if (wrong.size() < fewest)
        fewest = wrong.size(), left = tries;
      else
        --left;
      if (left > 0)
        for (const auto i : wrong) pressed_[i] = !pressed_[i];
      else
        pressed_[wrong.back()] = !pressed_[wrong.back()];
      solve(C, c);
    }
  }

private:
  /// Finds those that are pulled, or overlap without being pressed.
  std::vector<std::size_t> wrong_ones(const Eigen::VectorXd& compliances, const Eigen::VectorXd& c) const {
    constexpr double rounding = 1e-10;
    const double length = rounding * c.cwiseAbs().maxCoeff();
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < pressed_.size(); ++i) {
      const auto k = Eigen::Index(i);
      if (pressed_[i] ? x[k] * compliances[k] < -length : rest[k] < -length) result.push_back(i);
    }
    return result;
  }

  void solve(const Eigen::MatrixXd& C, const Eigen::VectorXd& c) {
    std::vector<Eigen::Index> active;
    for (std::size_t i = 0; i < pressed_.size(); ++i)
      if (pressed_[i]) active.push_back(Eigen::Index(i));
    x.setZero();
    if (!active.empty()) {
      const Eigen::MatrixXd of_active = C(active, active);
      const Eigen::LLT<Eigen::MatrixXd> factor(of_active);
      if (factor.info() != Eigen::Success)
        throw NumericalError(
            "contact of crack faces: openings do not follow from the forces on them: take a finer spacing, or remove "
            "`contact`");
      const Eigen::VectorXd forces = factor.solve(-c(active));
      x(active) = forces;
    }
    rest = C * x + c;
    for (const auto i : active) rest[i] = 0;
  }

  std::vector<char> pressed_;
};

}  // namespace

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

double lever_of(const FacePair& pair, const PointSections& sections) {
  return std::min(sections[pair.left].thickness, sections[pair.right].thickness) / 2;
}

TouchingFaces touching_faces(const Formulation& plate, const Formulation& membrane, const FreeFaces& free) {
  const auto pairs = plate.face_pairs();
  const auto count = Eigen::Index(pairs.size());
  if (count == 0) return {zero_like(free.bending), zero_like(free.membrane), {}};
  const auto in_plane = pinned(membrane);
  const AssembledPlate bent(plate, plate.constraints(), plate.stiffness());
  const AssembledPlate flat(membrane, in_plane, membrane.stiffness());
  const auto of_bending = compliance(pairs, bent, plate.points());
  const auto of_plane = compliance(pairs, flat, plate.points());

  Eigen::VectorXd arm(count), openings(2 * count);  // top first
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& pair = pairs[std::size_t(i)];
    arm[i] = lever_of(pair, plate.sections());
    const double slope = arm[i] * pair.opening(free.bending), middle = pair.opening(free.membrane);
    openings[i] = middle + slope, openings[count + i] = middle - slope;
  }
  const Eigen::MatrixXd turned = arm.asDiagonal() * of_bending * arm.asDiagonal();
  Eigen::MatrixXd both(2 * count, 2 * count);
  both << of_plane + turned, of_plane - turned, of_plane - turned, of_plane + turned;
  // what supports hold has no compliance: faces that cannot turn, or cannot move, share a force evenly
  constexpr double no_compliance = 1e-10;
  both.diagonal().array() += no_compliance * both.diagonal().maxCoeff();
  constexpr double no_opening = 1e-8;  // of the largest motion: errors of the free equilibria
  const double motion = largest_motion(free.membrane) + arm.maxCoeff() * largest_motion(free.bending);
  openings = (openings.array().abs() > no_opening * motion).select(openings, 0);
  const Complementarity found(both, openings);

  TouchingFaces result;
  result.factor_bytes = bent.bytes() + flat.bytes();
  constexpr double rounding = 1e-9;  // faces that are pressed evenly do not bend the plate
  const double most = found.x.maxCoeff();
  Forces on_bending = zero_forces(plate.points()), on_plane = zero_forces(plate.points());
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& pair = pairs[std::size_t(i)];
    const double top = found.x[i], bottom = found.x[count + i];
    pair.press(top + bottom, on_plane);
    if (std::abs(top - bottom) > rounding * most) pair.press(arm[i] * (top - bottom), on_bending);
    result.faces.push_back({.position = plate.cloud().positions[pair.left],
                            .length = pair.length,
                            .opening_top = found.rest[i],
                            .opening_bottom = found.rest[count + i],
                            .force_top = top / pair.length,
                            .force_bottom = bottom / pair.length});
  }
  result.bending = bent.solve({on_bending}).front();
  plate.constraints().impose(result.bending);
  result.membrane = flat.solve({on_plane}).front();
  in_plane.impose(result.membrane);
  return result;
}

}  // namespace plate
