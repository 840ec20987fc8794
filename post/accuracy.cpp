#include "post/accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace post {
namespace {

using Factors = Eigen::Vector3d;  // K1, K2, K3 h

/// What counts of each sign of an error, of K1, K2, K3. Calibrated: theory.md, "To a stated accuracy".
constexpr std::array of_integrals{0.1, 0.05, 0.05};  // of the difference of both integrals
constexpr std::array of_change{0.3, 0.3, 0.5};       // of the last change of the result
constexpr std::array of_size{0.0, 0.01, 0.02};       // of K2 and K3 h together, with size^2: the layer beside the faces
constexpr double of_others_change = 0.3, of_step = 0.2;
constexpr double rounding = 5e-5;                    // of the largest factor

/// Both integrals of a tip, which share their mode mix.
struct Pair {
  double size, faces;
  Factors domain, extension;
};

const Srif* find(const std::vector<Srif>& srifs, std::size_t tip, const char* method) {
  const auto found = std::ranges::find_if(srifs, [&](const Srif& srif) { return srif.tip == tip && srif.method == method; });
  return found == srifs.end() ? nullptr : &*found;
}

/// Of the last discretisations in a row that have both, with a fit. Where no energy is released the fit tells the factors.
std::vector<Pair> pairs(const std::vector<AccuracyStep>& path, std::size_t tip, double h) {
  std::vector<Pair> result;
  for (const auto& one : path) {
    const auto *domain = find(one.srifs, tip, "domain_integral"), *extension = find(one.srifs, tip, "virtual_crack_extension"),
               *fit = find(one.srifs, tip, "series_fit");
    if (!domain || !extension || !fit) {
      result.clear();
      continue;
    }
    const auto factors = [&](const Srif& integral) {
      const Srif& srif = integral.G && *integral.G <= 0 ? *fit : integral;
      return Factors(srif.K1, srif.K2, h * srif.K3);
    };
    result.push_back({one.size, one.faces, factors(*domain), factors(*extension)});
  }
  return result;
}

/// From the last two values, errors going with size^2.
template <typename Value>
Value extrapolated(const Value& before, const Value& last, double size_before, double size) {
  const double ratio = size_before / size;
  return last + (last - before) / (ratio * ratio - 1);
}

Factors mean(const Pair& pair) {
  return (pair.domain + pair.extension) / 2;
}

/// The last change over the one before it, as a share of what it is where errors go with size^2.
double pace(const std::vector<Pair>& found, std::size_t n, double before, double last) {
  const auto square = [&](std::size_t i) { return found[i].size * found[i].size; };
  return last / before * (square(n - 2) - square(n - 1)) / (square(n - 1) - square(n));
}

/// The result after n + 1 discretisations. Errors of K3 are of one order only where its changes say so.
Factors result_of(const std::vector<Pair>& found, std::size_t n) {
  if (n == 0) return mean(found[0]);
  Factors result = extrapolated<Factors>(mean(found[n - 1]), mean(found[n]), found[n - 1].size, found[n].size);
  const auto K3 = [&](std::size_t i) { return found[i].domain[2]; };
  const double share = n > 1 ? pace(found, n, K3(n - 1) - K3(n - 2), K3(n) - K3(n - 1)) : 0;
  const bool of_one_order = share > 0.33 && share < 1.5;
  if (!of_one_order) result[2] = K3(n);
  return result;
}

/// How much larger than the last change the rest of a convergence at this pace may be: 1 where errors go with size^2.
double slowness(double pace) {
  const double ratio = std::min(pace / 2, 0.75);  // of changes, where each step halves size^2
  return ratio > 0.5 ? ratio / (1 - ratio) : 1;
}

Factors errors_of(const std::vector<Pair>& found) {
  const std::size_t n = found.size() - 1;
  const Pair &last = found[n], &before = found[n - 1];
  const Factors result = result_of(found, n), result_before = result_of(found, n - 1);
  const double shrinks = std::pow(last.size / before.size, 2);
  const Factors change = (result - result_before).cwiseAbs().cwiseMax(shrinks * (result_before - result_of(found, n - 2)).cwiseAbs());
  const Factors step = mean(last) - mean(before), step_before = mean(before) - mean(found[n - 2]);
  const Factors apart = extrapolated<Factors>(before.domain - before.extension, last.domain - last.extension, before.size, last.size);
  const double others = of_others_change * change.maxCoeff(), integrals = (last.domain - last.extension).cwiseAbs().maxCoeff();
  const double unresolved = last.size * last.size * std::clamp(last.faces / 1.5, 1.0, 4.0) * last.domain.tail<2>().norm();
  Factors errors = apart.cwiseAbs() / 2 + of_step * step.cwiseAbs() + Factors::Constant(rounding * result.cwiseAbs().maxCoeff());
  for (std::size_t i = 0; i < 3; ++i) {
    const auto j = Eigen::Index(i);
    errors[j] += slowness(pace(found, n, step_before[j], step[j])) * of_change[i] * std::max(change[j], others) + of_integrals[i] * integrals +
                 of_size[i] * unresolved;
  }
  return errors;
}

}  // namespace

std::vector<Srif> refined(const std::vector<AccuracyStep>& path, double thickness) {
  std::vector<Srif> result;
  if (path.empty()) return result;
  for (const auto& of_last : path.back().srifs) {
    if (!result.empty() && result.back().tip == of_last.tip) continue;
    const auto found = pairs(path, of_last.tip, thickness);
    if (found.size() < 3) continue;
    Srif srif;
    srif.tip = of_last.tip, srif.position = of_last.position, srif.method = "refinement";
    srif.samples = found.size();
    const Factors K = result_of(found, found.size() - 1), errors = errors_of(found);
    srif.K1 = K[0], srif.K2 = K[1], srif.K3 = K[2] / thickness;
    srif.errors = {errors[0], errors[1], errors[2] / thickness};
    const double largest = largest_factor(srif, thickness);
    if (largest > 0) srif.estimated_error = errors.maxCoeff() / largest;
    result.push_back(std::move(srif));
  }
  return result;
}

void refer_to(const Srif& refined, Srif& srif, double thickness) {
  const Factors differences(srif.K1 - refined.K1, srif.K2 - refined.K2, srif.K3 - refined.K3);
  const double largest = largest_factor(refined, thickness);
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    srif.errors[i] = std::abs(differences[Eigen::Index(i)]) + *refined.errors[i];
    worst = std::max(worst, *srif.errors[i] * (i == 2 ? thickness : 1));
  }
  if (largest > 0) srif.estimated_error = worst / largest;
}

namespace {

/// What an error counts against.
double scale_of(const Srif& srif, const std::vector<Srif>& all, double thickness, double nominal) {
  constexpr double least = 0.01;
  double largest = nominal;
  for (const auto& other : all) largest = std::max(largest, largest_factor(other, thickness));
  return std::max(largest_factor(srif, thickness), least * largest);
}

}  // namespace

std::optional<double> largest_error(const std::vector<Srif>& refined, std::size_t tips, double thickness, double nominal) {
  if (refined.size() < tips) return std::nullopt;
  double result = 0;
  for (const auto& srif : refined)
    if (const double scale = scale_of(srif, refined, thickness, nominal); scale > 0)
      result = std::max({result, *srif.errors[0] / scale, *srif.errors[1] / scale, thickness * *srif.errors[2] / scale});
  return result;
}

void judge(std::vector<Srif>& refined, double thickness, double nominal) {
  constexpr double lost = 0.1;
  for (auto& srif : refined) {
    const double scale = scale_of(srif, refined, thickness, nominal);
    srif.accuracy_reached = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double error = *srif.errors[i] * (i == 2 ? thickness : 1);
      srif.resolved[i] = error <= lost * scale;
      if (scale > 0) srif.accuracy_reached = std::max(*srif.accuracy_reached, error / scale);
    }
  }
}

}  // namespace post
