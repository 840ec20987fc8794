#include "post/factors/series_fit.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace post {
namespace {

using geometry::Point;

/// Of a radius: circles go through points of a lattice (5 layers of a plate 5 spacings thick do, at (4.5, 6.5)), which
/// are all in or all out. By rounding alone K2 was 1e-4 of K1 in a symmetric plate.
constexpr double rounding = 1e-9;

/// Points; 16 spacings about a tip hold 800.
constexpr std::size_t enough = 1200;

std::vector<std::uint32_t> points_within(const TipView& plate, const TipFrame& frame, const FitRange& range) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const Point x = frame.local(plate.positions[k]);
    const double r = x.norm();
    if (r < range.inner * (1 - rounding) || r > range.outer * (1 + rounding)) continue;
    if (x.x() < 0 && std::abs(x.y()) < plate.doubtful) continue;
    result.push_back(k);
  }
  // more points than the fields need cost time only
  const std::size_t stride = (result.size() + enough - 1) / enough;
  for (std::size_t i = 0; stride > 1 && i * stride < result.size(); ++i) result[i] = result[i * stride];
  if (stride > 1) result.resize((result.size() + stride - 1) / stride);
  return result;
}

/// The row of a fit of the fields (columns; three rows a point, weighted) to a state: K = F R^-1 Q^T of their QR.
Eigen::MatrixXd rows_of(Eigen::MatrixXd fields, const Eigen::Matrix3Xd& factors) {
  const Eigen::VectorXd scale = fields.colwise().norm().cwiseInverse();
  fields = fields * scale.asDiagonal();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(fields);
  const Eigen::MatrixXd wanted = (factors * scale.asDiagonal()).transpose();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(fields.rows(), 3);
  rows.topRows(fields.cols()) =
      qr.matrixQR().topRows(fields.cols()).triangularView<Eigen::Upper>().transpose().solve(wanted);
  rows.applyOnTheLeft(qr.householderQ());
  return rows;
}

}  // namespace

std::vector<SeriesFit> series_fits(const TipView& plate, const geometry::Tip& tip, const FitRange& range,
                                   const std::vector<double>& shares, bool heated) {
  const TipFrame frame(tip);
  const auto points = points_within(plate, frame, range);
  const plate::Section section = plate.section.at(tip.position);
  const TipSeries series(section, range.outer, range.order, heated);
  std::vector<Polar> places;
  for (const auto k : points) places.push_back(polar(frame, plate.positions[k], plate.spacing));
  const Eigen::MatrixXd fields = series(places);
  // of w / outer, psi_x', psi_y' to w, theta_x, theta_y: psi = (-theta_y, theta_x)
  const Point left = frame.left();
  Eigen::Matrix3d turn;
  turn << 1 / range.outer, 0, 0, 0, frame.ahead.y(), -frame.ahead.x(), 0, left.y(), -left.x();

  std::vector<SeriesFit> result;
  for (const double share : shares) {
    FitRange narrower{range.inner, share * range.outer,
                      share == 1 ? range.order : fit_order(section, share * range.outer)};
    std::vector<Eigen::Index> within, columns;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (places[i].r <= narrower.outer * (1 + rounding)) within.push_back(Eigen::Index(i));
    for (std::size_t n = 0; n < series.orders().size(); ++n)
      if (series.orders()[n] <= narrower.order) columns.push_back(Eigen::Index(n));
    constexpr double least_surplus = 1.5;  // equations per unknown
    if (3 * double(within.size()) < least_surplus * double(columns.size())) break;
    SeriesFit fit{narrower, {}, Eigen::Matrix3Xd(3, 3 * Eigen::Index(within.size()))};
    Eigen::MatrixXd own(3 * Eigen::Index(within.size()), Eigen::Index(columns.size()));
    std::vector<double> weight;
    for (std::size_t i = 0; i < within.size(); ++i) {
      fit.points.push_back(points[std::size_t(within[i])]);
      weight.push_back(std::sqrt(plate.areas[fit.points.back()]));
      const Eigen::Vector3d each = weight.back() * Eigen::Vector3d(1 / range.outer, 1, 1);
      own.middleRows(3 * Eigen::Index(i), 3) =
          each.asDiagonal() * fields.middleRows(3 * within[i], 3)(Eigen::all, columns);
    }
    const Eigen::MatrixXd rows = rows_of(std::move(own), series.factors()(Eigen::all, columns));
    for (std::size_t i = 0; i < within.size(); ++i)
      fit.row.middleCols(3 * Eigen::Index(i), 3) =
          weight[i] * rows.middleRows(3 * Eigen::Index(i), 3).transpose() * turn;
    result.push_back(std::move(fit));
  }
  return result;
}

Eigen::Vector3d SeriesFit::operator()(const NearField& field) const {
  Eigen::Vector3d K = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto u = field(points[i]);
    K += row.middleCols(3 * Eigen::Index(i), 3) * Eigen::Vector3d(u.w, u.theta_x, u.theta_y);
  }
  return K;
}

int fit_order(const plate::Section& section, double outer) {
  return 6 + int(std::ceil(3 * outer * std::sqrt(12 * section.shear_correction) / section.thickness));
}

std::optional<FitRange> fit_range(const plate::Section& section, double clear, double spacing, bool graded) {
  constexpr double least = 4, usual = 16;  // spacings
  constexpr double resolved = 5,
                   possible = 7;  // widths of the layer beside the faces; beyond, the series has too many fields
  const double layer = section.layer();
  // where nu < 0, fields of higher order look like the first one
  const double softness = std::min(1.0, (1 + section.poisson) / (1 - section.poisson));
  double outer = std::min(0.6 * clear, resolved * std::sqrt(softness) * layer);
  // graded points resolve the layer beside the faces only near the tip
  outer = std::min(outer, graded ? std::max(usual * spacing, 2.5 * layer) : usual * spacing);
  if (outer < least * spacing) outer = std::min(0.9 * clear, least * spacing);
  if (outer < least * spacing || outer > possible * layer) return std::nullopt;
  return FitRange{std::max(2.5 * spacing, 0.15 * outer), outer, fit_order(section, outer)};
}

}  // namespace post
