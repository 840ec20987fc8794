#include "plate/bonds/horizon_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "tests/catch.hpp"

using namespace plate;

namespace {

/// I4 / (3 I22) of the full family: 1 where the lattice bends the same in all directions.
double anisotropy(const Discretization& d) {
  double fourth = 0, mixed = 0;
  for (const auto& xi : full_family(d)) {
    const double angle = std::atan2(xi.y(), xi.x()), square = xi.squaredNorm();
    const double weight = influence(d.influence, xi.norm(), d.horizon()) * square * volume_share(d, xi);
    fourth += weight * std::pow(std::cos(angle), 4);
    mixed += weight * std::pow(std::sin(2 * angle) / 2, 2);
  }
  return fourth / (3 * mixed);
}

Discretization with(double ratio, VolumeCorrection correction, Influence kind = Influence::inverse) {
  Discretization d;
  d.spacing = 0.04;
  d.horizon_ratio = ratio;
  d.volume_correction = correction;
  d.influence = kind;
  return d;
}

}  // namespace

TEST_CASE("influence: horizon over length, or 1") {
  CHECK(influence(Influence::inverse, 0.5, 2) == 4);
  CHECK(influence(Influence::constant, 0.5, 2) == 1);
}

TEST_CASE("full family: all lattice vectors within the horizon, each with its opposite") {
  CHECK(full_family(with(3.015, VolumeCorrection::none)).size() == 28);
  CHECK(full_family(with(3, VolumeCorrection::none)).size() == 28);  // the rim belongs to it
  CHECK(full_family(with(1, VolumeCorrection::none)).size() == 4);
  CHECK(full_family(with(5, VolumeCorrection::none)).size() == 80);
  const auto vectors = full_family(with(4.2, VolumeCorrection::none));
  REQUIRE_FALSE(vectors.empty());
  for (const auto& xi : vectors) {
    CHECK(xi.norm() <= 4.2 * 0.04 * (1 + 1e-9));
    CHECK(std::count(vectors.begin(), vectors.end(), Eigen::Vector2d(-xi)) == 1);
  }
}

TEST_CASE("volume share: linear over one spacing at the rim") {
  const auto linear = with(3, VolumeCorrection::linear), none = with(3, VolumeCorrection::none);
  const auto at = [](double length) -> Eigen::Vector2d { return Eigen::Vector2d(0.6, 0.8) * length * 0.04; };
  CHECK(volume_share(linear, at(2.4)) == 1);
  CHECK(volume_share(linear, at(2.75)) == Approx(0.75));
  CHECK(volume_share(linear, at(3)) == Approx(0.5));
  CHECK(volume_share(linear, at(3.01)) == 0);
  CHECK(volume_share(none, at(3)) == 1);
  CHECK(volume_share(none, at(3.01)) == 0);
}

TEST_CASE("volume share: fitted to the lattice, bending is the same in all directions") {
  const auto kind = GENERATE(Influence::inverse, Influence::constant);
  const double ratio = GENERATE(3.015, 4.0, 5.0, 6.0);
  CAPTURE(ratio);
  CHECK(std::abs(anisotropy(with(ratio, VolumeCorrection::lattice_fitted, kind)) - 1) < 1e-12);  // measured: 1e-15
  // it does something: the linear correction is off by 0.7 % to 8 %
  CHECK(std::abs(anisotropy(with(ratio, VolumeCorrection::linear, kind)) - 1) > 5e-3);
}

TEST_CASE("volume share: the linear correction's anisotropy") {
  // a separate program's values (Dai's influence function)
  CHECK(anisotropy(with(3.015, VolumeCorrection::linear)) == Approx(0.99321).epsilon(1e-5));  // measured: 5e-8
  CHECK(anisotropy(with(5, VolumeCorrection::linear)) == Approx(0.944).epsilon(1e-3));        // measured: 3e-4
}

TEST_CASE("volume share: fitting changes the outermost points on the axes alone") {
  const auto fitted = with(3.015, VolumeCorrection::lattice_fitted), linear = with(3.015, VolumeCorrection::linear);
  int changed = 0;
  for (const auto& xi : full_family(fitted)) {
    const bool axis_tip = std::abs(xi.norm() - 0.12) < 1e-9 && std::abs(xi.x() * xi.y()) < 1e-9;
    CHECK((volume_share(fitted, xi) != volume_share(linear, xi)) == axis_tip);
    CHECK(volume_share(fitted, xi) > 0);
    changed += axis_tip;
  }
  CHECK(changed == 4);
}
