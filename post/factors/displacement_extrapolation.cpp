#include "post/factors/displacement_extrapolation.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/tip_view.hpp"
#include "plate/model/dense_algebra.hpp"
#include "plate/model/state.hpp"
#include "post/factors/tip_integrals.hpp"
#include "post/factors/tip_section.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace post {
namespace {

using geometry::Point;

/// A point beside the crack in the tip's axes: r behind the tip, y' to the left.
struct PointByCrack {
  std::uint32_t point;
  double r, y;
  int face;  // +1 upper (y' > 0), -1 lower
};

std::vector<PointByCrack> points_by_crack(const std::vector<Point>& positions, const plate::TipFrame& frame,
                                          double window, double height, double spacing) {
  const Point normal = frame.left();
  std::vector<PointByCrack> found;
  for (std::uint32_t k = 0; k < positions.size(); ++k) {
    const Point x = positions[k] - frame.origin;
    double r = -x.dot(frame.ahead), y = x.dot(normal);
    if (!frame.curve.empty()) {
      if (x.norm() > window + 2 * spacing + height) continue;
      const Point beside = frame.beside(positions[k]);
      r = -beside.x(), y = beside.y();
    }
    if (r > -2 * spacing && r < window + 2 * spacing && std::abs(y) < height)
      found.push_back({k, r, y, plate::face_of(y, normal, spacing)});
  }
  return found;
}

/// Weights that give the value at (r, y) on one face from the points about it.
std::vector<plate::Share> face_value(const std::vector<PointByCrack>& by_crack, int face, double r, double y,
                                     double spacing) {
  std::vector<std::pair<std::uint32_t, Point>> near;
  for (const auto& b : by_crack)
    if (b.face == face && std::hypot(b.r - r, b.y - y) < 1.6 * spacing)
      near.emplace_back(b.point, Point(b.r, b.y) / spacing);
  return plate::interpolation(near, Point(r, y) / spacing);
}

/// The heights of the first rows of points on one face; on a lattice along the crack these are rows of points.
double first_row(const std::vector<PointByCrack>& by_crack, int face, double spacing) {
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (const auto& b : by_crack)
    if (b.face == face && b.r > 0) lowest = std::min(lowest, std::abs(b.y));
  for (const auto& b : by_crack)  // points of one row share one height: then the row itself, else half a spacing
    if (b.face == face && b.r > 0 && std::abs(b.y) < lowest + 0.9 * spacing) highest = std::max(highest, std::abs(b.y));
  return highest - lowest < 1e-6 * spacing ? lowest : spacing / 2;
}

/// Distances behind the tip, one spacing apart: where the points of the first row lie, if they form one.
std::vector<double> distances(const std::vector<PointByCrack>& by_crack, double row, double window, double spacing) {
  double first = std::numeric_limits<double>::infinity();
  for (const auto& b : by_crack)
    if (b.face > 0 && std::abs(std::abs(b.y) - row) < 1e-6 * spacing && b.r > 1e-6 * spacing)
      first = std::min(first, b.r);
  if (first > spacing * (1 + 1e-6)) first = spacing / 2;  // the crack does not follow the lattice
  std::vector<double> r;
  for (double at = first; at <= window * (1 + 1e-9); at += spacing) r.push_back(at);
  return r;
}

/// Distances behind the tip of the points on one face, from 2.5 spacings on: next to the tip their opening is 17 % off.
std::vector<double> face_distances(const std::vector<PointByCrack>& by_crack, double window, double spacing) {
  std::vector<double> r;
  for (const auto& b : by_crack)
    if (b.face > 0 && std::abs(b.y) < 1e-4 * spacing && b.r > 2.5 * spacing * (1 - 1e-9) && b.r <= window * (1 + 1e-9))
      r.push_back(b.r);
  std::sort(r.begin(), r.end());
  return r;
}

struct Line {
  double at_zero, residual;
};

/// Least-squares polynomial through (r, value); its value at r = 0 and the rms misfit.
Line fit(const std::vector<double>& r, const Eigen::VectorXd& value, int degree) {
  Eigen::MatrixXd basis(value.size(), degree + 1);
  for (Eigen::Index i = 0; i < basis.rows(); ++i)
    for (int n = 0; n <= degree; ++n) basis(i, n) = std::pow(r[static_cast<std::size_t>(i)] / r.back(), n);
  const Eigen::VectorXd coefficients = plate::least_norm(basis, value).x;
  return {coefficients[0], (basis * coefficients - value).norm() / std::sqrt(double(value.size()))};
}

/// The value at r = 0 of a straight line through the factors of the same opening with the tip `further` ahead.
double at_tip_further(std::vector<double> r, Eigen::VectorXd K, double further) {
  for (std::size_t i = 0; i < r.size(); ++i) {
    K[Eigen::Index(i)] *= std::sqrt(r[i] / (r[i] + further));
    r[i] += further;
  }
  return fit(r, K, 1).at_zero;
}

}  // namespace

OpeningFit paper_fit(const PlateScale& scale, const SrifOptions& options) {
  return {SrifMethod::displacement_extrapolation,
          options.window.value_or(options.window_horizons * scale.horizon),
          options.skip,
          options.rows,
          1,
          false,
          scale.points_on_faces};
}

OpeningFit series_fit(const PlateScale& scale) {
  const double window = std::max(scale.section.thickness / 2, 8 * scale.spacing);
  if (scale.points_on_faces) return {SrifMethod::opening_series, window, 0, 1, 2, false, true};
  return {SrifMethod::opening_series, window, 1, 2, 2, true};
}

OpeningFit narrow_fit(const PlateScale& scale) {
  if (scale.points_on_faces) return {SrifMethod::opening, 5.1 * scale.spacing, 0, 1, 0, false, true};
  return {SrifMethod::opening, 3.1 * scale.spacing, 0, 1, 0, true};
}

DisplacementExtrapolation::DisplacementExtrapolation(const geometry::Tip& tip, const PlateScale& scale,
                                                     const OpeningFit& how)
    : tip_(tip),
      scale_(scale),
      how_(how),
      stiffness_(TipSection(scale.section.at(tip.position), tip.direction).stiffness() / std::sqrt(8.0)) {}

std::variant<DisplacementExtrapolation, std::string> DisplacementExtrapolation::at(const std::vector<Point>& positions,
                                                                                   const geometry::CrackPath& path,
                                                                                   const geometry::Tip& tip,
                                                                                   const PlateScale& scale,
                                                                                   const OpeningFit& how) {
  DisplacementExtrapolation result(tip, scale, how);
  const auto& v = path.vertices;
  const auto frame = frame_of(path, tip, scale.spacing, scale.section.isotropic());
  const double straight = tip.at_back ? (v.back() - v[v.size() - 2]).norm() : (v.front() - v[1]).norm();
  const double unbent = frame.curve.empty() ? straight : unbent_length(frame, scale.spacing);
  const double window = std::min(how.window, unbent);
  const auto by_crack = points_by_crack(positions, frame, window, (how.rows + 1.5) * scale.spacing, scale.spacing);
  const double upper = how.points_on_faces ? 0 : first_row(by_crack, 1, scale.spacing);
  const double lower = how.points_on_faces ? 0 : first_row(by_crack, -1, scale.spacing);

  const auto r_of_samples = how.points_on_faces ? face_distances(by_crack, window, scale.spacing)
                                                : distances(by_crack, upper, window, scale.spacing);
  const bool between = how.tip_between_columns && !r_of_samples.empty() && r_of_samples[0] < scale.spacing * (1 - 1e-6);
  const double shift = between ? scale.spacing / 2 - r_of_samples[0] : 0;
  int skipped = 0;
  for (const double r : r_of_samples) {
    if (skipped++ < how.skip) continue;
    const double turned = frame.curvature * r;
    Sample sample{r + shift, std::cos(turned) * frame.ahead - std::sin(turned) * frame.left(), {}, {}};
    for (const int face : {1, -1})
      for (int row = 0; row < how.rows; ++row) {
        // with two rows: 3/2 of the first less 1/2 of the second, for rows 1/2 and 3/2 spacings off the crack
        const double first = face > 0 ? upper : lower, second = first + scale.spacing;
        const double share = how.rows == 1 ? 1 : row == 0 ? second / scale.spacing : -first / scale.spacing;
        const double y = face * (row == 0 ? first : second);
        const auto values = face_value(by_crack, face, r, y, scale.spacing);
        if (values.empty()) return "no points beside the crack behind the tip";
        for (const auto& [point, weight] : values) {
          sample.jump.push_back({point, face * share * weight});
          sample.lever.push_back({point, face * share * weight * y});
        }
      }
    result.samples_.push_back(std::move(sample));
  }
  const std::size_t found = result.samples_.size(), least = std::size_t(how.degree) + 1;
  if (found < least)
    return "the window holds " + std::to_string(found) + " of " + std::to_string(least) +
           " samples needed: refine, widen it or skip fewer";
  return result;
}

Srif DisplacementExtrapolation::operator()(const plate::State& state) const {
  Eigen::MatrixX3d K(static_cast<Eigen::Index>(samples_.size()), 3);
  std::vector<double> r;
  for (const Sample& sample : samples_) {
    const Point ahead = sample.ahead, left(-ahead.y(), ahead.x());
    Eigen::Vector3d jump = Eigen::Vector3d::Zero();
    for (const plate::Share& share : sample.jump) jump += share.weight * state.col(share.point);
    const Point rotation(jump[1], jump[2]);
    double deflection = jump[0];
    for (const plate::Share& share : sample.lever)
      deflection -= share.weight * (state(1, share.point) * ahead.x() + state(2, share.point) * ahead.y());
    K.row(static_cast<Eigen::Index>(r.size())) =
        (stiffness_ * Eigen::Vector3d(-rotation.dot(ahead), rotation.dot(left), deflection)).transpose() /
        std::sqrt(sample.r);
    r.push_back(sample.r);
  }

  Srif result;
  result.position = tip_.position;
  result.method = how_.method;
  result.samples = samples_.size();
  double* const value[] = {&result.K1, &result.K2, &result.K3};
  double spread[3], misfit[3];
  for (int mode = 0; mode < 3; ++mode) {
    const Line line = fit(r, K.col(mode), how_.degree);
    *value[mode] = line.at_zero;
    misfit[mode] = line.residual;
    spread[mode] =
        samples_.size() > 2 ? std::abs(fit(r, K.col(mode), how_.degree == 1 ? 2 : 1).at_zero - line.at_zero) : 0;
    if (!how_.points_on_faces && !how_.tip_between_columns)
      spread[mode] += std::abs(at_tip_further(r, K.col(mode), unknown_place(r.front())) - line.at_zero);
  }
  // K3 counts against moments by the thickness
  const double h = scale_.section.thickness, largest = largest_factor(result, h);
  if (largest > 0) {
    result.fit_residual = std::max({misfit[0], misfit[1], misfit[2] * h}) / largest;
    for (std::size_t mode = 0; mode < 3 && samples_.size() > 2; ++mode) result.errors[mode] = spread[mode];
    if (samples_.size() > 2) result.estimated_error = std::max({spread[0], spread[1], spread[2] * h}) / largest;
  }
  return result;
}

}  // namespace post
