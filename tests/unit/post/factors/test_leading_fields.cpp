#include "post/factors/interaction.hpp"

#include <numbers>

#include "tests/catch.hpp"

using namespace post;
using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

plate::Section turned_section(double angle, bool isotropic = false) {
  plate::Section s{1000, 0.3, 0.1, 5.0 / 6, 0};
  if (isotropic)
    s.orthotropic = {1000, 1000, 0.3, 1000 / 2.6, 1000 / 2.6, 1000 / 2.6, angle};
  else
    s.orthotropic = {140, 10, 0.3, 5, 30, 12, angle};
  return s;
}

/// M_yy and M_xy in the tip's axes, tension at z > 0 positive.
Vector2d moments(const plate::Section& s, const Vector2d& ahead, const Matrix2d& psi) {
  const plate::LocalSection local(s);
  const Eigen::Vector3d m = -local.bending * Eigen::Vector3d(psi(0, 0), psi(1, 1), psi(0, 1) + psi(1, 0));
  Matrix2d M;
  M << m[0], m[2], m[2], m[1];
  const Vector2d left(-ahead.y(), ahead.x());
  return {left.dot(M * left), ahead.dot(M * left)};
}

}  // namespace

TEST_CASE("leading fields: unit factors straight ahead, free faces, at any angle to the axes") {
  for (const bool isotropic : {false, true})
    for (const double angle : {0.0, 35.0, 80.0})
      for (const double turn : {0.0, 0.7}) {
        const auto s = turned_section(angle, isotropic);
        const Vector2d ahead(std::cos(turn), std::sin(turn)), left(-ahead.y(), ahead.x());
        const LeadingFields fields(TipSection(s, ahead), ahead);
        const double r = 0.3, root = std::sqrt(2 * r), small = isotropic ? 1e-6 : 1e-10;
        const plate::LocalSection local(s);
        for (int mode = 0; mode < 2; ++mode) {
          const Vector2d before = moments(s, ahead, fields.rotations({r, 0})[std::size_t(mode)]) * root;
          CHECK((before - Vector2d::Unit(mode)).norm() < small);
          for (const double face : {std::numbers::pi, -std::numbers::pi})
            CHECK(moments(s, ahead, fields.rotations({r, face})[std::size_t(mode)]).norm() * root < small);
        }
        CHECK(left.dot(local.shear * fields.deflection({r, 0})) * root == Approx(1).epsilon(1e-12));
        for (const double face : {std::numbers::pi, -std::numbers::pi})
          CHECK(std::abs(left.dot(local.shear * fields.deflection({r, face}))) * root < 1e-10);
      }
}
