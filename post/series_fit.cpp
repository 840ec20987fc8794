#include "post/series_fit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

namespace post {
namespace {

using geometry::Point;

/// Points nearer to the line of the crack are left out [spacings]: with bonds the lattice, not the line, tells which side
/// they are on; in the Galerkin plate they lie on the faces, where rounding would tell, and are the least accurate.
constexpr double doubtful_of_bonds = 0.3, doubtful_of_faces = 0.05;

std::vector<std::uint32_t> points_within(const BondedPlate& plate, const TipFrame& frame, const FitRange& range) {
  const double doubtful = (plate.galerkin ? doubtful_of_faces : doubtful_of_bonds) * plate.spacing;
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const Point x = frame.local(plate.positions[k]);
    const double r = x.norm();
    if (r < range.inner || r > range.outer) continue;
    if (x.x() < 0 && std::abs(x.y()) < doubtful) continue;
    result.push_back(k);
  }
  return result;
}

}  // namespace

SeriesFit::SeriesFit(const BondedPlate& plate, const geometry::Tip& tip, const FitRange& range) {
  const TipFrame frame(tip);
  points_ = points_within(plate, frame, range);
  const TipSeries series(plate.section, range.outer, range.order);
  const auto count = Eigen::Index(points_.size());
  constexpr double least_surplus = 1.5;  // equations per unknown
  if (3 * double(count) < least_surplus * double(series.size()))
    throw std::invalid_argument("too few points about the tip for a fit of its fields");
  Eigen::MatrixXd fields(3 * count, series.size());
  Eigen::VectorXd weight(count);
#pragma omp parallel for schedule(static)
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = points_[std::size_t(i)];
    const Eigen::Matrix3Xd values = series(polar(frame, plate.positions[k], plate.spacing));
    weight[i] = std::sqrt(plate.areas[k]);
    fields.row(3 * i) = weight[i] / range.outer * values.row(0);
    fields.middleRows(3 * i + 1, 2) = weight[i] * values.bottomRows(2);
  }
  const Eigen::VectorXd scale = fields.colwise().norm().cwiseInverse();
  fields = fields * scale.asDiagonal();
  // K = F R^-1 Q^T: the rows are Q of R^-T F^T
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(fields);
  const Eigen::MatrixXd wanted = (series.factors() * scale.asDiagonal()).transpose();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3 * count, 3);
  rows.topRows(series.size()) = qr.matrixQR().topRows(series.size()).triangularView<Eigen::Upper>().transpose().solve(wanted);
  rows.applyOnTheLeft(qr.householderQ());

  row_.resize(3, 3 * count);
  const Point left = frame.left();
  for (Eigen::Index i = 0; i < count; ++i) {
    // of w, psi_x', psi_y' to w, theta_x, theta_y: psi = (-theta_y, theta_x)
    Eigen::Matrix3d turn;
    turn << 1 / range.outer, 0, 0, 0, frame.ahead.y(), -frame.ahead.x(), 0, left.y(), -left.x();
    row_.middleCols(3 * i, 3) = weight[i] * rows.middleRows(3 * i, 3).transpose() * turn;
  }
}

Eigen::Vector3d SeriesFit::operator()(const NearField& field) const {
  Eigen::Vector3d K = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto u = field(points_[i]);
    K += row_.middleCols(3 * Eigen::Index(i), 3) * Eigen::Vector3d(u.w, u.theta_x, u.theta_y);
  }
  return K;
}

int fit_order(const plate::Section& section, double outer) {
  return 6 + int(std::ceil(3 * outer * std::sqrt(12 * section.shear_correction) / section.thickness));
}

std::optional<FitRange> fit_range(const plate::Section& section, double clear, double spacing, bool graded) {
  constexpr double least = 4, usual = 16;       // spacings
  constexpr double resolved = 5, possible = 7;  // widths of the layer beside the faces; beyond, the series has too many fields
  const double layer = section.thickness / std::sqrt(12 * section.shear_correction);
  double outer = std::min(0.6 * clear, resolved * layer);
  if (!graded) outer = std::min(outer, usual * spacing);
  if (outer < least * spacing) outer = std::min(0.9 * clear, least * spacing);
  if (outer < least * spacing || outer > possible * layer) return std::nullopt;
  return FitRange{std::max(2.5 * spacing, graded ? outer / 16 : 0.15 * outer), outer, fit_order(section, outer)};
}

}  // namespace post
