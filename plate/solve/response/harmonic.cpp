#include "plate/solve/response/harmonic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plate/formulation/constraints.hpp"
#include "plate/model/algebra/dense.hpp"
#include "plate/model/numerical_error.hpp"
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

  std::vector<double> resonances(double from, double to) const {
    std::vector<double> result;
    for (const double square : squares)
      if (const double f = std::sqrt(square) / turn; f >= from && f <= to) result.push_back(f);
    return result;
  }

  /// Coordinates in the vectors at every frequency.
  MatrixXcd answer(const std::vector<double>& frequencies, const Damping& damping) const {
    MatrixXcd amplitudes(squares.size(), Index(frequencies.size()));
    for (Index n = 0; n < amplitudes.cols(); ++n) {
      const double omega = turn * frequencies[std::size_t(n)];
      for (Index i = 0; i < squares.size(); ++i)
        amplitudes(i, n) = shares[i] / std::complex(squares[i] - omega * omega,
                                                    omega * (damping.mass + damping.stiffness * squares[i]));
    }
    return shapes.cast<std::complex<double>>() * amplitudes;
  }
};

std::vector<double> merged(std::vector<double> frequencies, const std::vector<double>& more) {
  frequencies.insert(frequencies.end(), more.begin(), more.end());
  std::ranges::sort(frequencies);
  frequencies.erase(std::unique(frequencies.begin(), frequencies.end()), frequencies.end());
  return frequencies;
}

/// The largest of `parts` over what is there at the same frequency, which counts as a hundredth of the largest of all
/// where it is less: factors may vanish at a frequency.
double largest_share(const Eigen::ArrayXd& parts, const Eigen::ArrayXd& wholes) {
  const double most = wholes.maxCoeff();
  return most > 0 ? (parts / wholes.max(0.01 * most)).maxCoeff() : 0;
}

/// Of the answer, over the mass.
double change_of(const MatrixXcd& now, const MatrixXcd& before) {
  MatrixXcd difference = now;
  difference.topRows(before.rows()) -= before;
  return largest_share(difference.colwise().norm().transpose(), now.colwise().norm().transpose());
}

/// Of every group, by its largest functional.
std::vector<double> changes_of(const std::vector<MatrixXd>& groups, const LanczosSpace& space, const MatrixXcd& now,
                               const MatrixXcd& before) {
  std::vector<double> result;
  for (const auto& group : groups) {
    if (group.rows() == 0) {
      result.push_back(0);
      continue;
    }
    const MatrixXd of_vectors = group * space.vectors();
    const MatrixXcd values = of_vectors * now, earlier = of_vectors.leftCols(before.rows()) * before;
    result.push_back(largest_share((values - earlier).cwiseAbs().colwise().maxCoeff().transpose(),
                                   values.cwiseAbs().colwise().maxCoeff().transpose()));
  }
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
    stop_if_asked("a response by Lanczos vectors");
    const bool exhausted = next >= space.size();
    if (!exhausted && space.size() < before + std::max(more, before / 64 * 8)) {
      space.add_after(next);
      continue;
    }
    const MatrixXd stiffness = space.stiffness();
    const VectorXd shares = space.vectors().transpose() * flat(folded);
    const Modes now(stiffness, shares);
    resonances_ = now.resonances(asked.front(), asked.back());
    frequencies_ = merged(asked, resonances_);
    coordinates_ = now.answer(frequencies_, options.damping);
    change_ = exhausted ? 0 : 1, watched_.assign(options.watched.size(), change_);
    if (before > 0 && !exhausted) {
      const Modes earlier(stiffness.topLeftCorner(before, before), shares.head(before));
      const MatrixXcd then = earlier.answer(frequencies_, options.damping);
      change_ = change_of(coordinates_, then), watched_ = changes_of(options.watched, space, coordinates_, then);
    }
    if (options.progress) options.progress(std::size_t(space.size()), change_);
    double worst = change_;
    for (const double one : watched_) worst = std::max(worst, one);
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
    return State(Eigen::Map<const State>(u.data(), 3, points_));
  };
  const auto column = coordinates_.col(Index(number));
  return {state_of(column.real()), state_of(column.imag())};
}

}  // namespace plate
