#include "plate/model/part_through_crack.hpp"

#include <Eigen/LU>
#include <numbers>

#include "plate/model/section.hpp"
#include "tests/catch.hpp"

using namespace plate;

namespace {

Section steel() {
  Section result;
  result.young = 2e11, result.poisson = 0.3, result.thickness = 0.02;
  return result;
}

double energy(double depth, bool below, const Eigen::Vector2d& resultants) {
  return resultants.dot(PartThroughCrack(steel(), depth, below).stiffness().inverse() * resultants) / 2;
}

}  // namespace

TEST_CASE("crack through a part of the thickness: energy is released with the square of K as it deepens") {
  const auto s = steel();
  const double modulus = s.young / (1 - s.poisson * s.poisson), step = 1e-6 * s.thickness;
  for (const Eigen::Vector2d resultants : {Eigen::Vector2d(3e4, 0), {0, 200}, {3e4, -50}})
    for (const double share : {0.1, 0.5, 0.9})
      for (const bool below : {false, true}) {
        const double depth = share * s.thickness;
        const double K = PartThroughCrack(s, depth, below).front_factor(resultants);
        const double released = (energy(depth + step, below, resultants) - energy(depth - step, below, resultants));
        CHECK(released / (2 * step) == Approx(std::numbers::pi * K * K / modulus).epsilon(1e-4));
      }
}

TEST_CASE("crack through a part of the thickness: shallow and absent ones, and either face") {
  const auto s = steel();
  const double h = s.thickness, shallow = 1e-4 * h;
  // an edge crack in a half plane, K sqrt(pi) = 1.1215 sigma sqrt(pi a); within 0.5 %
  CHECK(PartThroughCrack(s, shallow, false).front_factor({h, 0}) == Approx(1.1215 * std::sqrt(shallow)).epsilon(5e-3));
  CHECK(PartThroughCrack(s, shallow, false).front_factor({0, h * h / 6}) ==
        Approx(1.1215 * std::sqrt(shallow)).epsilon(5e-3));
  const Eigen::Matrix2d whole = PartThroughCrack(s, 0, false).stiffness();
  CHECK(whole(0, 1) == 0);
  CHECK(whole(1, 1) == Approx(s.bending_stiffness() / (nearly_rigid * h)).epsilon(1e-12));
  const auto above = PartThroughCrack(s, 0.4 * h, false), below = PartThroughCrack(s, 0.4 * h, true);
  CHECK(above.stiffness()(0, 1) == -below.stiffness()(0, 1));
  CHECK(above.stiffness()(1, 1) == below.stiffness()(1, 1));
  CHECK(above.front_factor({2, 3}) == below.front_factor({2, -3}));
}
