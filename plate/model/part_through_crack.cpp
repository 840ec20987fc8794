#include "plate/model/part_through_crack.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "plate/model/section.hpp"

namespace plate {
namespace {

constexpr double pi = std::numbers::pi;

/// K over sigma sqrt(h), without the factor pi, of a strip in tension and in bending with a crack of a share of its
/// height (Tada, Paris and Irwin, 2.10 and 2.13).
Eigen::Vector2d shapes(double share) {
  const double angle = pi * share / 2, sine = std::sin(angle), cosine = std::cos(angle);
  const double common = std::sqrt(2 / pi * std::tan(angle)) / cosine;
  return {common * (0.752 + 2.02 * share + 0.37 * std::pow(1 - sine, 3)),
          common * (0.923 + 0.199 * std::pow(1 - sine, 4))};
}

}  // namespace

PartThroughCrack::PartThroughCrack(const Section& section, double depth, bool below)
    : share_(depth / section.thickness),
      thickness_(section.thickness),
      modulus_(section.young / (1 - section.poisson * section.poisson)),
      side_(below ? -1 : 1) {}

Eigen::Matrix2d PartThroughCrack::stiffness() const {
  // energy released as the crack deepens: h^2 / E' pi of the integral of (shapes . stresses)^2 over the share
  constexpr int intervals = 512;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int i = 0; i <= intervals; ++i) {  // Simpson's rule
    const Eigen::Vector2d one = shapes(share_ * i / intervals);
    sum += (i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2) * one * one.transpose();
  }
  sum *= pi * share_ / (3 * intervals);
  const Eigen::Vector2d stresses(1 / thickness_, side_ * 6 / (thickness_ * thickness_));  // by N and M
  Eigen::Matrix2d compliance =
      2 * thickness_ * thickness_ / modulus_ * stresses.asDiagonal() * sum * stresses.asDiagonal();
  compliance(0, 0) += nearly_rigid / modulus_;
  compliance(1, 1) += nearly_rigid * 12 / (modulus_ * thickness_ * thickness_);
  return compliance.inverse();
}

double PartThroughCrack::front_factor(const Eigen::Vector2d& resultants) const {
  const Eigen::Vector2d stresses(resultants[0] / thickness_, side_ * 6 * resultants[1] / (thickness_ * thickness_));
  return std::sqrt(thickness_) * shapes(share_).dot(stresses);
}

}  // namespace plate
