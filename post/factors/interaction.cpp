#include "post/factors/interaction.hpp"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numbers>

#include "plate/model/space.hpp"

namespace post {

using Complex = std::complex<double>;

LeadingFields::LeadingFields(const TipSection& at, const geometry::Point& ahead) {
  axes_ << ahead.x(), -ahead.y(), ahead.y(), ahead.x();
  const plate::LocalSection local(at.section);
  const auto a = turned_compliance(local.bending, ahead);
  const auto [sum, product] = upper_roots(a);
  // equal roots have another form; a small difference changes the fields by its square
  constexpr double least = 1e-4;
  Complex half = std::sqrt(sum * sum / 4.0 - product);
  if (std::abs(half) < least) half = least;
  roots_ = {sum / 2.0 + half, sum / 2.0 - half};
  const Complex share = std::sqrt(2.0) / (roots_[0] - roots_[1]);
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Complex m = roots_[std::size_t(i)], other = roots_[std::size_t(1 - i)];
    const Complex p = a(0, 0) * m * m + a(0, 1) - a(0, 2) * m, q = a(0, 1) * m + a(1, 1) / m - a(1, 2);
    const double sign = i == 0 ? -1 : 1;
    u_(0, i) = sign * share * other * p, v_(0, i) = sign * share * other * q;
    u_(1, i) = sign * share * p, v_(1, i) = sign * share * q;
  }
  const Eigen::Matrix2d S = axes_.transpose() * local.shear * axes_;
  const double determinant = std::sqrt(S.determinant());
  root_of_shear_ = Complex(-S(0, 1), determinant) / S(1, 1);
  deflection_ = std::sqrt(2.0) / determinant;
}

std::array<Eigen::Matrix2d, 2> LeadingFields::rotations(const plate::Polar& at) const {
  std::array<Eigen::Matrix2d, 2> result{Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
  for (std::size_t i = 0; i < 2; ++i) {
    const Complex slope = 0.5 / std::sqrt(at.r * (std::cos(at.angle) + roots_[i] * std::sin(at.angle)));
    for (Eigen::Index mode = 0; mode < 2; ++mode) {
      const Complex u = u_(mode, Eigen::Index(i)) * slope, v = v_(mode, Eigen::Index(i)) * slope;
      Eigen::Matrix2d own;
      own << u.real(), (roots_[i] * u).real(), v.real(), (roots_[i] * v).real();
      result[std::size_t(mode)] -= own;
    }
  }
  for (auto& one : result) one = axes_ * one * axes_.transpose();
  return result;
}

Eigen::Vector2d LeadingFields::deflection(const plate::Polar& at) const {
  const Complex slope =
      0.5 * deflection_ / std::sqrt(at.r * (std::cos(at.angle) + root_of_shear_ * std::sin(at.angle)));
  return axes_ * Eigen::Vector2d(slope.imag(), (root_of_shear_ * slope).imag());
}

namespace {

using geometry::Point;

/// Coefficients of an integral at a point: by the gradients of psi, the shear angles and psi.
struct Taken {
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
  Point shear{0, 0}, psi{0, 0};
};

using Rows = std::map<std::uint32_t, Eigen::Matrix3d>;  // per point: integrals (rows) by w, theta_x, theta_y

/// M_ab psi'_a,x' q,b + M'_ab psi_a,x' q,b - M : kappa' q,x' - q Q . psi',x' of a field psi' without deflection.
Taken of_rotations(const Eigen::Matrix2d& own, const plate::LocalSection& section, const Eigen::Matrix2d& S,
                   const Point& ahead, double q, const Point& slope) {
  const Point forward = own * ahead;
  const Eigen::Vector3d kappa(own(0, 0), own(1, 1), own(0, 1) + own(1, 0)), M = section.bending * kappa;
  Eigen::Matrix2d moments;
  moments << M[0], M[2], M[2], M[1];
  const double along = slope.dot(ahead);
  const Eigen::Vector3d strain(forward.x() * slope.x() - along * kappa[0], forward.y() * slope.y() - along * kappa[1],
                               forward.x() * slope.y() + forward.y() * slope.x() - along * kappa[2]);
  const Eigen::Vector3d by = section.bending * strain;
  Taken result;
  result.gradient << by[0], by[2], by[2], by[1];
  result.gradient += moments * slope * ahead.transpose();
  result.shear = -q * S * forward;
  return result;
}

/// Q_b w',x' q,b + Q'_b w,x' q,b - Q . grad w' q,x' + q Q' . psi,x' of a field w' without rotations.
Taken of_deflection(const Point& own, const Eigen::Matrix2d& S, const Point& ahead, double q, const Point& slope) {
  const Point force = S * own;
  Taken result;
  result.psi = force.dot(slope) * ahead;
  result.shear = own.dot(ahead) * S * slope - slope.dot(ahead) * force + result.psi;
  result.gradient = q * force * ahead.transpose();
  return result;
}

/// Adds to row `row` the differences that the plate takes its gradients from; psi = (-theta_y, theta_x).
void scatter(const TipView& plate, std::uint32_t k, const Taken& taken, double area, Eigen::Index row, Rows& rows) {
  const auto add = [&](std::uint32_t j, double w, const Point& psi) {
    auto& own = rows.try_emplace(j, Eigen::Matrix3d::Zero()).first->second;
    own.row(row) += area * Eigen::RowVector3d(w, psi.y(), -psi.x());
  };
  const auto shares = plate.gradient_shares(k);
  add(k, 0, taken.psi);
  for (std::size_t n = 0; n < shares.bonds.size(); ++n) {
    const auto& bond = shares.bonds[n];
    const Point share = shares.share.col(Eigen::Index(n)), x = plate.families.vectors()[bond.vector_id];
    const Point turn = taken.gradient * share, lever = taken.shear.dot(share) / 2 * x;
    add(bond.neighbour, taken.shear.dot(share), turn - lever);
    add(k, -taken.shear.dot(share), -turn - lever);
  }
}

SeriesFit over(const TipView& plate, const TipFrame& frame, const TipSection& at, const Ring& ring) {
  const LeadingFields fields(at, frame.ahead);
  const plate::LocalSection section(at.section);
  Rows rows;
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const auto place = plate::polar(frame, plate.positions[k], plate.spacing);
    constexpr double nothing = 1e-3;  // spacings: the tip itself, where leading fields have no value
    if (place.r > 2 * ring.outer || place.r < nothing * plate.spacing) continue;
    const Point slope = plate.extension_slope(k, frame, ring);
    const double q = ring.extension(place.r);
    if (q == 0 && slope == Point(0, 0)) continue;
    const auto S = plate.shear_stiffness(k);
    const auto rotations = fields.rotations(place);
    for (Eigen::Index mode = 0; mode < 2; ++mode)
      scatter(plate, k, of_rotations(rotations[std::size_t(mode)], section, S, frame.ahead, q, slope), plate.areas[k],
              mode, rows);
    if (at.section.law == plate::PlateLaw::bending)
      scatter(plate, k, of_deflection(fields.deflection(place), S, frame.ahead, q, slope), plate.areas[k], 2, rows);
  }
  const Eigen::Matrix3d factors = at.stiffness() / std::numbers::pi;
  SeriesFit result{
      {ring.inner, ring.outer, 0}, {}, Eigen::Matrix3Xd(3, plate::unknowns_per_point * Eigen::Index(rows.size()))};
  for (const auto& [k, own] : rows) {
    result.row.middleCols(plate::index_by_points(Eigen::Index(result.points.size()), 0), plate::unknowns_per_point) =
        factors * own;
    result.points.push_back(k);
  }
  return result;
}

}  // namespace

std::vector<SeriesFit> interaction_integrals(const TipView& plate, const TipFrame& frame, const TipSection& at,
                                             const std::vector<Ring>& rings) {
  std::vector<SeriesFit> result;
  for (const auto& ring : rings) result.push_back(over(plate, frame, at, ring));
  return result;
}

/// M' : kappa_0 q,x' - M_0,ab psi'_a,x' q,b + q M' : kappa_0,x' of the moments M_0 of kappa_0 and fields psi', M'.
Eigen::Vector3d interaction_of_free_curvatures(const TipView& plate, const TipFrame& frame, const TipSection& at,
                                               const Ring& ring, const FreeCurvatures& free) {
  const LeadingFields fields(at, frame.ahead);
  const auto stiffness = plate::LocalSection(at.section).bending;
  Eigen::Vector3d sum(0, 0, 0);
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    constexpr double nothing = 1e-3;  // spacings
    const auto place = plate::polar(frame, plate.positions[k], plate.spacing);
    if (place.r > 2 * ring.outer || place.r < nothing * plate.spacing) continue;
    const Point slope = plate.extension_slope(k, frame, ring);
    const double q = ring.extension(place.r);
    if (q == 0 && slope == Point(0, 0)) continue;
    const Eigen::Vector3d held = stiffness * free.col(k), change = change_ahead(plate, k, frame, free);
    Eigen::Matrix2d moments;
    moments << held[0], held[2], held[2], held[1];
    const auto rotations = fields.rotations(place);
    for (Eigen::Index mode = 0; mode < 2; ++mode) {
      const auto& own = rotations[std::size_t(mode)];
      const Eigen::Vector3d kappa(own(0, 0), own(1, 1), own(0, 1) + own(1, 0));
      sum[mode] += plate.areas[k] * (held.dot(kappa) * slope.dot(frame.ahead) -
                                     (own * frame.ahead).dot(moments * slope) + q * kappa.dot(stiffness * change));
    }
  }
  return at.stiffness() / std::numbers::pi * sum;
}

}  // namespace post
