#include "post/factors/near_field/leading_fields.hpp"

#include <Eigen/LU>
#include <cmath>

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

}  // namespace post
