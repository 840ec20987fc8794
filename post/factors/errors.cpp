#include "post/factors/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace post {
namespace {

template <typename Factors>
Eigen::Vector3d vector_of(const Factors& K) {
  return {K.K1, K.K2, K.K3};
}

/// Relative difference in sqrt(G) from another integral, or from the next ring where there is no other. An integral
/// that is not positive contradicts: it counts as one that finds G = 0.
std::optional<double> difference_of_energies(const Srif& srif, const std::vector<Srif>& found) {
  std::optional<double> result;
  const auto compare = [&](double G) {
    result = std::max(result.value_or(0), std::abs(1 - std::sqrt(std::max(G, 0.0) / *srif.G)));
  };
  for (const auto& other : found)
    if (other.G && other.method != srif.method) compare(*other.G);
  if (!result && srif.rings.size() > 1) compare(srif.rings[1].G);
  return result;
}

void set(Srif& srif, const Eigen::Vector3d& errors, double thickness) {
  const Eigen::Vector3d scale(1, 1, thickness);
  const double largest = largest_factor(srif, thickness);
  for (Eigen::Index i = 0; i < 3; ++i) srif.errors[std::size_t(i)] = errors[i];
  if (largest > 0) srif.estimated_error = errors.cwiseProduct(scale).maxCoeff() / largest;
}

class Estimate {
public:
  Estimate(const std::vector<FitSrif>& fits, const TipSection& at, const ErrorShares& shares)
      : fits_(fits), at_(at), shares_(shares), scale_(1, 1, at.section.thickness) {}

  /// `energies`: relative difference in sqrt(G) of the integrals among themselves.
  Eigen::Vector3d by_energy(const Srif& srif, double energies) const {
    const Eigen::Vector3d K = vector_of(srif);
    const double largest = largest_factor(srif, at_.section.thickness);
    Eigen::Vector3d result = unresolved() * largest;
    if (fits_.empty()) {
      // the split is that of the first samples of the opening, and nothing vouches for it: K1 may be anything up to
      // what the whole energy gives, and as much less
      const double whole = std::sqrt(*srif.G / at_.unit_release()[0]);
      const double missing = std::max(0.0, whole - std::abs(K[0]));
      return result + Eigen::Vector3d(2 * energies * whole + 2 * missing, largest, largest).cwiseQuotient(scale_);
    }
    // a fit that is far from the energy tells neither the size nor the mode mix
    const double apart = disagreement(*srif.G), far = std::max(0.0, apart - shares_.doubt),
                 size = shares_.energy * apart + far;
    const double bending = std::hypot(K[0], K[1]);
    result[2] += shares_.mixing * largest / at_.section.thickness + shares_.fits_shear * spread(largest)[2] +
                 size * std::abs(K[2]) + shares_.shear * apart * largest / at_.section.thickness;
    // what K3 takes wrongly of G is missing in K1 and K2, in proportion
    const Eigen::Vector3d unit = at_.unit_release();
    const double taken = (1.6 * energies + size) * *srif.G + unit[2] * std::abs(K[2]) * result[2];
    const double square = 2 * taken / unit[0];  // error of K1^2 + K2^2
    result[2] += own_shear() * std::abs(K[2]);  // which the calibration of K1 and K2 has in it
    if (bending > 0) result.head<2>() += (std::sqrt(bending * bending + square) / bending - 1) * K.head<2>().cwiseAbs();
    result.head<2>() += tied();
    if (bending < 0.1 * largest)
      return result + shares_.fits * Eigen::Vector3d(spread(largest)[0], spread(largest)[1], 0);
    const double turn = shares_.turn + shares_.fits * largest_turn(largest / bending) + far;
    return result + turn * Eigen::Vector3d(std::abs(K[1]), std::abs(K[0]), 0);
  }

  Eigen::Vector3d by_fit(const Srif& srif, const std::optional<double>& G) const {
    const Eigen::Vector3d K = vector_of(srif);
    const double largest = largest_factor(srif, at_.section.thickness);
    return unresolved() * largest + shares_.fits * spread(largest) +
           (G ? 1.5 * disagreement(*G) : 0.02) * K.cwiseAbs() +
           Eigen::Vector3d(shares_.turn * std::abs(K[1]) + tied()[0], shares_.turn * std::abs(K[0]) + tied()[1],
                           own_shear() * std::abs(K[2]));
  }

private:
  /// Error of K1 and K2 where a shear layer ties both faces: fits do not know of it, and the K3 that they find, which
  /// is zero, tells how far they are off.
  Eigen::Vector2d tied() const {
    return Eigen::Vector2d::Constant(shares_.tied * at_.section.thickness * std::abs(fits_.front().K3));
  }

  /// Spacing on the faces away from the tip [layers], as far as it counts.
  double faces() const { return std::min(shares_.faces, 4.0); }

  /// Error of K3 in parts of itself: the layer beside the faces is resolved by as many points as there are.
  double own_shear() const { return shares_.own_shear * (1 + faces()); }

  /// Resolution errors, relative to the largest factor: those of the points between the tip and what is next to it, and
  /// of the points in the layer beside the faces, at the tip and away from it.
  Eigen::Vector3d unresolved() const {
    constexpr double in_bending = 0.0008, served = 0.5;  // layers
    Eigen::Vector3d result = Eigen::Vector3d::Constant(shares_.least + in_bending * std::max(0.0, faces() - served));
    result[1] += shares_.sliding;
    result[2] += shares_.layer * std::pow(std::min(shares_.width, 1.5), 3);
    return result.cwiseQuotient(scale_);
  }

  /// Largest difference between the first fit and the others, of each factor; where there is no other, a share of the
  /// largest.
  Eigen::Vector3d spread(double largest) const {
    constexpr double alone = 0.03;
    if (fits_.size() < 2) return Eigen::Vector3d::Constant(alone * largest).cwiseQuotient(scale_);
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    for (const auto& fit : fits_) result = result.cwiseMax((vector_of(fit) - vector_of(fits_.front())).cwiseAbs());
    return result;
  }

  /// Largest turn of (K1, K2) between the first fit and the others [rad]; where there is no other, as for spread().
  double largest_turn(double unit) const {
    constexpr double alone = 0.03;
    if (fits_.size() < 2) return alone * unit;
    double result = 0;
    const Eigen::Vector3d first = vector_of(fits_.front());
    for (const auto& fit : fits_) {
      const Eigen::Vector3d other = vector_of(fit);
      const double lengths = first.head<2>().norm() * other.head<2>().norm();
      if (lengths > 0) result = std::max(result, std::abs(first[0] * other[1] - first[1] * other[0]) / lengths);
    }
    return result;
  }

  double disagreement(double G) const {
    const double fitted = at_.release(vector_of(fits_.front()));
    return std::abs(1 - std::sqrt(fitted / G));
  }

  const std::vector<FitSrif>& fits_;
  const TipSection& at_;
  const ErrorShares& shares_;
  Eigen::Vector3d scale_;
};

}  // namespace

void estimate_errors(std::vector<Srif>& found, const std::vector<FitSrif>& fits, const TipSection& at,
                     const ErrorShares& shares) {
  const Estimate estimate(fits, at, shares);
  const double h = at.section.thickness;
  const Srif* best = nullptr;
  for (auto& srif : found) srif.lost_shear = shares.lost;
  for (auto& srif : found) {
    if (!srif.G) continue;
    if (*srif.G <= 0) {
      // no factors; how large they may be, the sum of energies says
      srif.errors.fill(std::sqrt(-*srif.G / at.unit_release()[0]));
      *srif.errors[2] /= h;
      srif.resolved.fill(*srif.G == 0);
      continue;
    }
    if (!best) best = &srif;
    // one energy release rate alone, without a fit: nothing vouches for it
    const double alone = fits.empty() ? 1 : 0;
    set(srif, estimate.by_energy(srif, difference_of_energies(srif, found).value_or(alone)), h);
  }
  for (auto& srif : found) {
    if (srif.G || largest_factor(srif, h) == 0) continue;
    if (srif.method == SrifMethod::series_fit) {
      set(srif, estimate.by_fit(srif, best ? best->G : std::nullopt), h);
    } else if (best) {
      Eigen::Vector3d errors = 1.5 * (vector_of(srif) - vector_of(*best)).cwiseAbs();
      for (Eigen::Index i = 0; i < 3; ++i) errors[i] = std::max(errors[i], srif.errors[std::size_t(i)].value_or(0));
      set(srif, errors, h);
    }
  }
}

void widen_errors(std::vector<Srif>& sum, const std::vector<std::pair<double, const std::vector<Srif>*>>& parts,
                  double thickness) {
  for (auto& srif : sum) {
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    std::array<double, 2> in_plane{};
    for (const auto& [factor, rows] : parts)
      for (const auto& part : *rows) {
        if (part.tip != srif.tip || part.method != srif.method) continue;
        for (Eigen::Index i = 0; i < 3; ++i)
          squares[i] += std::pow(factor * part.errors[std::size_t(i)].value_or(0), 2);
        for (std::size_t i = 0; i < 2 && part.membrane; ++i)
          in_plane[i] += std::pow(factor * part.membrane->errors[i].value_or(0), 2);
      }
    for (std::size_t i = 0; i < 2 && srif.membrane; ++i)
      if (auto& error = srif.membrane->errors[i]; in_plane[i] > 0)
        error = std::max(error.value_or(0), std::sqrt(in_plane[i]));
    if (squares.isZero(0)) continue;
    Eigen::Vector3d errors = squares.cwiseSqrt();
    for (Eigen::Index i = 0; i < 3; ++i) errors[i] = std::max(errors[i], srif.errors[std::size_t(i)].value_or(0));
    set(srif, errors, thickness);
  }
}

namespace {

/// True where the errors of the factors are estimated, and the factors are more than noise.
bool estimated(const Srif& srif) {
  return srif.errors[0] && !of_opening(srif.method) && (!srif.G || *srif.G > 0);
}

}  // namespace

double largest_of_tips(const std::vector<Srif>& srifs, double thickness) {
  double result = 0;
  for (const auto& srif : srifs)
    if (estimated(srif)) result = std::max(result, largest_factor(srif, thickness));
  return result;
}

void add_errors_of_other_tips(std::vector<Srif>& srifs, double most, double thickness) {
  constexpr double share = 0.0007;
  for (auto& srif : srifs)
    if (const double beyond = most - largest_factor(srif, thickness); beyond > 0 && estimated(srif))
      widen(srif, share * beyond, thickness);
}

void mark_lost(std::vector<Srif>& srifs, double thickness, std::vector<double>& largest) {
  const std::vector<double> before = largest;
  for (const auto& srif : srifs) {
    largest.resize(std::max(largest.size(), srif.tip + 1), 0);
    if (!of_opening(srif.method)) largest[srif.tip] = std::max(largest[srif.tip], largest_with_plane(srif, thickness));
  }
  for (auto& srif : srifs) {
    if (of_opening(srif.method) || srif.accuracy_reached) continue;  // openings are not judged, and those have been
    // an energy that is not positive is no better than another method's factors; beside those of earlier rows it may be
    // none
    const bool none = srif.G && *srif.G <= 0;
    const double scale = !none ? largest[srif.tip] : srif.tip < before.size() ? before[srif.tip] : 0;
    for (std::size_t i = 0; i < 3; ++i)
      srif.resolved[i] =
          srif.errors[i].value_or(0) * (i == 2 ? thickness : 1) <= (i == 2 ? srif.lost_shear : lost) * scale;
    resolve_together(srif, thickness);
  }
}

}  // namespace post
