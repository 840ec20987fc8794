#include "plate/solve/motion/harmonic.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plate/formulation/constraints.hpp"
#include "plate/model/dense_algebra.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/lanczos_space.hpp"

namespace plate {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double turn = 2 * std::numbers::pi;

/// The modes of the first vectors of a space; shares: of the load.
struct Modes {
  MatrixXd shapes;  // in the vectors, columns
  VectorXd squares, shares;

  Modes(const MatrixXd& stiffness, const VectorXd& load) {
    Eigenpairs eigen = eigenpairs(stiffness);
    if (!eigen.found || !(eigen.values[0] > 0)) throw NumericalError("Lanczos vectors: the stiffness is not positive");
    shapes = std::move(eigen.vectors), squares = std::move(eigen.values), shares = shapes.transpose() * load;
  }

  double drag(Index i, const Damping& damping) const {
    return std::sqrt(squares[i]) * (damping.mass + damping.stiffness * squares[i]);
  }

  /// Resonances from `from` to `to` that fewer vectors have too, and that the load excites [1/time].
  std::vector<double> resonances(double from, double to, const Modes& fewer, const Damping& damping) const {
    constexpr double same = 1e-5, felt = 1e-3;
    std::vector<double> result;
    for (Index i = 0; i < squares.size(); ++i) {
      const double f = std::sqrt(squares[i]) / turn;
      if (!(f >= from && f <= to)) continue;
      const bool known = (fewer.squares.array() / squares[i] - 1).abs().minCoeff() < 2 * same;
      const double own = std::abs(shares[i]) / drag(i, damping);
      if (known && own > felt * amplitudes({f}, damping).norm()) result.push_back(f);
    }
    return result;
  }

  /// Amplitudes of the modes at every frequency.
  MatrixXcd amplitudes(const std::vector<double>& frequencies, const Damping& damping) const {
    MatrixXcd result(squares.size(), Index(frequencies.size()));
    for (Index n = 0; n < result.cols(); ++n) {
      const double omega = turn * frequencies[std::size_t(n)];
      for (Index i = 0; i < squares.size(); ++i)
        result(i, n) = shares[i] / std::complex(squares[i] - omega * omega,
                                                omega * (damping.mass + damping.stiffness * squares[i]));
    }
    return result;
  }

  /// Coordinates in the vectors at every frequency.
  MatrixXcd answer(const std::vector<double>& frequencies, const Damping& damping) const {
    return shapes.cast<std::complex<double>>() * amplitudes(frequencies, damping);
  }
};

std::vector<double> merged(std::vector<double> frequencies, const std::vector<double>& more) {
  frequencies.insert(frequencies.end(), more.begin(), more.end());
  std::ranges::sort(frequencies);
  frequencies.erase(std::unique(frequencies.begin(), frequencies.end()), frequencies.end());
  return frequencies;
}

/// Relative change of the response at every frequency, in the norm of the mass; the largest of them.
double change_of(const MatrixXcd& now, const MatrixXcd& before) {
  MatrixXcd difference = now;
  difference.topRows(before.rows()) -= before;
  const Eigen::ArrayXd size = now.colwise().norm().transpose();
  return (difference.colwise().norm().transpose().array() / size.max(std::numeric_limits<double>::min())).maxCoeff();
}

/// Relative change of every group of a family, measured by the largest functional of the group.
std::vector<double> changes_of(const std::vector<MatrixXd>& family, const LanczosSpace& space, const MatrixXcd& now,
                               const MatrixXcd& before) {
  const Eigen::ArrayXd size = now.colwise().norm().transpose().array().max(std::numeric_limits<double>::min());
  std::vector<Eigen::ArrayXd> values, changes;
  double most = 0;  // for an answer of size 1
  for (const auto& group : family) {
    const Index vectors = space.vectors().cols();  // a tip without factors has neither rows nor columns
    const MatrixXd of_vectors = group.rows() == 0 ? MatrixXd(0, vectors) : MatrixXd(group * space.vectors());
    const MatrixXcd found = of_vectors * now, earlier = of_vectors.leftCols(before.rows()) * before;
    const auto largest = [&](const MatrixXcd& all) -> Eigen::ArrayXd {
      if (all.rows() == 0) return Eigen::ArrayXd::Zero(now.cols());
      return all.cwiseAbs().colwise().maxCoeff().transpose();
    };
    values.push_back(largest(found)), changes.push_back(largest(found - earlier));
    most = std::max(most, (values.back() / size).maxCoeff());
  }
  constexpr double nothing = 0.01;
  std::vector<double> result(family.size(), 0.0);
  for (std::size_t g = 0; g < family.size() && most > 0; ++g)
    result[g] = (changes[g] / values[g].max(nothing * most * size)).maxCoeff();
  return result;
}

}  // namespace

std::vector<double> Sweep::frequencies() const {
  std::vector<double> result{from};
  for (std::size_t i = 1; i < count; ++i) result.push_back(from + (to - from) * double(i) / double(count - 1));
  return result;
}

HarmonicResponse::HarmonicResponse(const Operator& plate, const Constraints& constraints, const Inertia& inertia,
                                   const Forces& load, const Preconditioner& inverse, const HarmonicOptions& options)
    : points_(Index(plate.points())) {
  constexpr Index more = 16;
  const auto asked = options.sweep.frequencies();
  Forces folded = load;
  constraints.fold(folded);
  LanczosSpace space(plate, constraints, inertia, inverse);
  if (!space.add(load)) throw NumericalError("the loads do not move the plate");
  Index before = 0;  // vectors when it was looked at
  for (Index next = 0;; ++next) {
    stop_if_asked("a response by Lanczos vectors", constraints);
    const bool exhausted = next >= space.size();
    if (!exhausted && space.size() < before + std::max(more, before / 64 * 8)) {
      space.add_after(next);
      continue;
    }
    const MatrixXd stiffness = space.stiffness();
    const VectorXd shares = space.vectors().transpose() * flat(folded);
    const Modes now(stiffness, shares);
    const Index fewer = exhausted ? space.size() : std::max<Index>(before, 1);
    const Modes earlier(stiffness.topLeftCorner(fewer, fewer), shares.head(fewer));
    resonances_ = now.resonances(asked.front(), asked.back(), earlier, options.damping);
    frequencies_ = merged(asked, resonances_);
    coordinates_ = now.answer(frequencies_, options.damping);
    const MatrixXcd then = earlier.answer(frequencies_, options.damping);
    change_ = change_of(coordinates_, then);
    double worst = change_;
    watched_.clear();
    for (const auto& family : options.watched) {
      watched_.push_back(changes_of(family, space, coordinates_, then));
      for (const double one : watched_.back()) worst = std::max(worst, one);
    }
    if (options.progress) options.progress(std::size_t(space.size()), change_);
    if (worst <= options.tolerance) break;
    if (std::size_t(space.size()) >= options.max_vectors)
      throw NumericalError(fmt::format(
          "{} Lanczos vectors change the response by {:.2g} still, more than the tolerance: take a larger one, or "
          "lower frequencies",
          space.size(), worst));
    before = space.size();
    space.add_after(next);
  }
  vectors_ = space.vectors();
}

std::pair<State, State> HarmonicResponse::at(std::size_t number) const {
  const auto state_of = [&](const VectorXd& coordinates) {
    const VectorXd u = vectors_ * coordinates;
    return State(Eigen::Map<const State>(u.data(), unknowns_per_point, points_));
  };
  const auto column = coordinates_.col(Index(number));
  return {state_of(column.real()), state_of(column.imag())};
}

}  // namespace plate
