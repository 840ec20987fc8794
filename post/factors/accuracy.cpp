#include "post/factors/accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace post {
namespace {

using Factors = Eigen::Vector3d;  // K1, K2, K3 h

/// Weights of the indicators of an error, for K1, K2, K3. Calibrated: theory.md, "To a stated accuracy".
constexpr std::array of_integrals{0.1, 0.05, 0.05};  // of the difference of both integrals
constexpr std::array of_change{0.3, 0.3, 0.5};       // of the last change of the result
constexpr std::array of_size{0.0, 0.01, 0.02};       // of K2 and K3 h together, with size^2: the layer beside the faces
constexpr double of_size_in_plane = 0.004;  // of the largest, with size^2, for N1 and N2: the place of the points
constexpr double of_others_change = 0.3, of_step = 0.2;
constexpr double share_of_rounding = 5e-5;  // of the largest factor

/// Factors by both integrals of a tip, which share their mode mix.
struct Pair {
  double size, faces;
  Factors domain, extension;
  double tied;  // K3 h that the fit finds where a shear layer ties both faces: K1 and K2 may be as far off
};

const Srif* find(const std::vector<Srif>& srifs, std::size_t tip, SrifMethod method) {
  const auto found =
      std::ranges::find_if(srifs, [&](const Srif& srif) { return srif.tip == tip && srif.method == method; });
  return found == srifs.end() ? nullptr : &*found;
}

/// Pairs at one time: of the last discretisations in a row that have both integrals, with a fit. Where no energy is
/// released the fit tells the factors. No fit is needed in the plane, which has no shear layer, nor found there under
/// heat that varies.
std::vector<Pair> pairs(const std::vector<AccuracyStep>& path, RowsOfStep rows, std::size_t row, std::size_t tip,
                        double h) {
  std::vector<Pair> result;
  const bool fit_needed = rows != &AccuracyStep::rows_in_plane;
  for (const auto& one : path) {
    const auto& srifs = (one.*rows).at(row);
    const auto *domain = find(srifs, tip, SrifMethod::domain_integral),
               *extension = find(srifs, tip, SrifMethod::virtual_crack_extension),
               *fit = find(srifs, tip, SrifMethod::series_fit);
    if (!domain || !extension || (!fit && fit_needed)) {
      result.clear();
      continue;
    }
    const auto factors = [&](const Srif& integral) {
      const Srif& srif = fit && integral.G && *integral.G <= 0 ? *fit : integral;
      return Factors(srif.K1, srif.K2, h * srif.K3);
    };
    const double tied = !fit || fit->fits.empty() ? 0 : h * std::abs(fit->fits.front().K3 - fit->K3);
    result.push_back({one.size, one.faces, factors(*domain), factors(*extension), tied});
  }
  return result;
}

/// Extrapolates from the last two values, errors going with size^2.
template <typename Value>
Value extrapolated(const Value& before, const Value& last, double size_before, double size) {
  const double ratio = size_before / size;
  return last + (last - before) / (ratio * ratio - 1);
}

Factors mean(const Pair& pair) {
  return (pair.domain + pair.extension) / 2;
}

/// Factors by both integrals at one tip: for every time, those of the last discretisations that have both.
using Course = std::vector<std::vector<Pair>>;

/// The sum over all times of the products of two changes of each factor.
template <typename First, typename Second>
Factors products(const Course& course, const First& first, const Second& second) {
  Factors result = Factors::Zero();
  for (const auto& found : course) result += first(found).cwiseProduct(second(found));
  return result;
}

/// The changes of each factor from discretisation n - 1 to n over those before, as a share of what they are where
/// errors go with size^2; over all times by least squares. `value`: of a Pair.
template <typename Value>
Factors pace(const Course& course, std::size_t n, const Value& value) {
  const auto last = [&](const std::vector<Pair>& found) -> Factors { return value(found[n]) - value(found[n - 1]); };
  const auto before = [&](const std::vector<Pair>& found) -> Factors {
    return value(found[n - 1]) - value(found[n - 2]);
  };
  const auto& sizes = course.front();
  const auto square = [&](std::size_t i) { return sizes[i].size * sizes[i].size; };
  return products(course, last, before).cwiseQuotient(products(course, before, before)) *
         (square(n - 2) - square(n - 1)) / (square(n - 1) - square(n));
}

/// The result after n + 1 discretisations, at one time.
Factors result_of(const std::vector<Pair>& found, std::size_t n) {
  if (n == 0) return mean(found[0]);
  return extrapolated<Factors>(mean(found[n - 1]), mean(found[n]), found[n - 1].size, found[n].size);
}

/// Ratio of the remaining error to the last change for convergence at this pace: 1 where errors go with size^2.
double slowness(double pace) {
  const double ratio = std::min(pace / 2, 0.75);  // of changes, where each step halves size^2
  return ratio > 0.5 ? ratio / (1 - ratio) : 1;
}

struct Refined {
  Factors K, errors;
};

/// Error that the differences of discretisations do not tell: that of the layer beside the faces, in the plane that of
/// the place of the points.
Factors untold(const Pair& last, bool in_plane) {
  const double square = last.size * last.size;
  if (in_plane) return of_size_in_plane * square * last.domain.cwiseAbs().maxCoeff() * Factors(1, 1, 0);
  return square * std::clamp(last.faces / 1.5, 1.0, 4.0) * last.domain.tail<2>().norm() *
         Factors(of_size[0], of_size[1], of_size[2]);
}

/// Refined factors at all times.
std::vector<Refined> refined(const Course& course, bool in_plane) {
  const std::size_t n = course.front().size() - 1;
  const Factors paces = pace(course, n, mean);
  std::vector<Refined> all;
  for (const auto& found : course) {
    const Pair &last = found[n], &before = found[n - 1];
    const Factors result = result_of(found, n), result_before = result_of(found, n - 1);
    const double shrinks = std::pow(last.size / before.size, 2);
    const Factors change =
        (result - result_before).cwiseAbs().cwiseMax(shrinks * (result_before - result_of(found, n - 2)).cwiseAbs());
    const Factors step = mean(last) - mean(before);
    const Factors apart =
        extrapolated<Factors>(before.domain - before.extension, last.domain - last.extension, before.size, last.size);
    const double others = of_others_change * change.maxCoeff(),
                 integrals = (last.domain - last.extension).cwiseAbs().maxCoeff();
    const Factors beside = untold(last, in_plane);
    Factors errors = apart.cwiseAbs() / 2 + of_step * step.cwiseAbs() +
                     Factors::Constant(share_of_rounding * result.cwiseAbs().maxCoeff());
    for (std::size_t i = 0; i < 3; ++i) {
      const auto j = Eigen::Index(i);
      errors[j] +=
          slowness(paces[j]) * of_change[i] * std::max(change[j], others) + of_integrals[i] * integrals + beside[j];
    }
    errors.head<2>().array() += last.tied;
    all.push_back({result, errors});
  }
  return all;
}

/// Raises errors to the root mean square over all times: where the courses of two discretisations cross, their
/// difference tells no error. Adds the share `truncated` of the largest factor at any time.
void level(std::vector<Refined>& course, double truncated) {
  Factors squares = Factors::Zero();
  double largest = 0;
  for (const auto& one : course)
    squares += one.errors.cwiseAbs2(), largest = std::max(largest, one.K.cwiseAbs().maxCoeff());
  const Factors mean = (squares / double(course.size())).cwiseSqrt();
  for (auto& one : course) one.errors = one.errors.cwiseMax(mean).array() + truncated * largest;
}

/// Truncation error of the result, as a share of the largest factor. Discretisations with about as many vectors leave
/// out about the same share, which extrapolation does not enlarge.
double truncation(const std::vector<AccuracyStep>& path, std::size_t tip) {
  const auto of = [&](const AccuracyStep& one) { return tip < one.truncated.size() ? one.truncated[tip] : 0; };
  return std::max(of(path.back()), of(path[path.size() - 2]));
}

/// Course of the factors of a tip; without the times at which some discretisations are too few.
Course course_of(const std::vector<AccuracyStep>& path, RowsOfStep rows, std::size_t tip, double thickness) {
  constexpr std::size_t enough = 3;
  Course result;
  std::size_t least = path.size();
  for (std::size_t row = 0; row < (path.back().*rows).size(); ++row) {
    result.push_back(pairs(path, rows, row, tip, thickness));
    least = std::min(least, result.back().size());
  }
  if (least < enough) return {};
  for (auto& found : result) found.erase(found.begin(), found.end() - std::ptrdiff_t(least));
  return result;
}

}  // namespace

std::vector<std::vector<Srif>> refined(const std::vector<AccuracyStep>& path, double thickness, RowsOfStep of) {
  std::vector<std::vector<Srif>> result;
  if (path.empty() || (path.back().*of).empty()) return result;
  const auto& rows = path.back().*of;
  for (const auto* first : recommended(rows.front())) {
    const std::size_t tip = first->tip;
    const Course course = course_of(path, of, tip, thickness);
    if (course.empty()) continue;
    auto found = refined(course, of == &AccuracyStep::rows_in_plane);
    level(found, truncation(path, tip));
    result.resize(rows.size());
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const auto& [K, errors] = found[row];
      Srif srif;
      srif.tip = tip, srif.position = first->position, srif.method = SrifMethod::refinement;
      srif.samples = course.front().size();
      srif.K1 = K[0], srif.K2 = K[1], srif.K3 = K[2] / thickness;
      srif.errors = {errors[0], errors[1], errors[2] / thickness};
      if (const double largest = largest_factor(srif, thickness); largest > 0)
        srif.estimated_error = errors.maxCoeff() / largest;
      result[row].push_back(std::move(srif));
    }
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

/// Reference value of the errors of each tip: its largest factor, or a hundredth of the largest of all tips or of
/// `nominal` where that is more.
class Scales {
public:
  Scales(const std::vector<std::vector<Srif>>& rows, double thickness, double nominal) : least_(0.01 * nominal) {
    constexpr double least = 0.01;
    for (const auto& row : rows)
      for (const auto& srif : row) {
        largest_.resize(std::max(largest_.size(), srif.tip + 1), 0);
        largest_[srif.tip] = std::max(largest_[srif.tip], largest_factor(srif, thickness));
      }
    for (const double largest : largest_) least_ = std::max(least_, least * largest);
  }
  double operator()(std::size_t tip) const { return std::max(largest_.at(tip), least_); }

private:
  double least_;
  std::vector<double> largest_;
};

double worst_error(const Srif& srif, double thickness) {
  return std::max({*srif.errors[0], *srif.errors[1], thickness * *srif.errors[2]});
}

/// Widens errors to the factors of the same tips after a later discretisation, unless that knows much less of a tip.
void widen_to(const std::vector<std::vector<Srif>>& later, std::vector<std::vector<Srif>>& rows, double thickness) {
  constexpr double much = 2;
  for (std::size_t row = 0; row < rows.size() && row < later.size(); ++row)
    for (auto& srif : rows[row]) {
      const auto other = std::ranges::find(later[row], srif.tip, &Srif::tip);
      if (other == later[row].end() || worst_error(*other, thickness) > much * worst_error(srif, thickness)) continue;
      const Factors apart(srif.K1 - other->K1, srif.K2 - other->K2, srif.K3 - other->K3);
      for (std::size_t i = 0; i < 3; ++i) srif.errors[i] = std::max(*srif.errors[i], std::abs(apart[Eigen::Index(i)]));
      if (const double largest = largest_factor(srif, thickness); largest > 0)
        srif.estimated_error = worst_error(srif, thickness) / largest;
    }
}

}  // namespace

std::optional<double> largest_error(const std::vector<std::vector<Srif>>& refined, std::size_t tips, double thickness,
                                    double nominal) {
  if ((refined.empty() ? 0 : refined.front().size()) < tips) return std::nullopt;
  const Scales scales(refined, thickness, nominal);
  double result = 0;
  for (const auto& row : refined)
    for (const auto& srif : row)
      if (const double scale = scales(srif.tip); scale > 0)
        result = std::max(result, worst_error(srif, thickness) / scale);
  return result;
}

BestFactors best_of(std::vector<std::vector<std::vector<Srif>>> refined, std::size_t tips, double thickness,
                    double nominal) {
  BestFactors result;
  for (std::size_t n = refined.size(); n-- > 0;) {
    auto rows = refined[n];
    for (std::size_t later = n + 1; later < refined.size(); ++later) widen_to(refined[later], rows, thickness);
    const auto error = largest_error(rows, tips, thickness, nominal);
    if (n + 1 == refined.size() || (error && (!result.error || *error < *result.error)))
      result = {std::move(rows), error};
  }
  return result;
}

void judge(std::vector<std::vector<Srif>>& refined, double thickness, double nominal) {
  const Scales scales(refined, thickness, nominal);
  for (auto& row : refined)
    for (auto& srif : row) {
      const double scale = scales(srif.tip);
      srif.accuracy_reached = scale > 0 ? worst_error(srif, thickness) / scale : 0;
      for (std::size_t i = 0; i < 3; ++i) srif.resolved[i] = *srif.errors[i] * (i == 2 ? thickness : 1) <= lost * scale;
    }
}

}  // namespace post
