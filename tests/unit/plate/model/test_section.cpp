#include "plate/model/section.hpp"
#include "tests/catch.hpp"

using plate::LocalSection;
using plate::Section;

TEST_CASE("bending stiffness is the moment of the stresses of a unit curvature") {
  const Section s{200e9, 0.3, 0.1, 5.0 / 6, 7850};
  // sigma_xx = E/(1-nu^2) z with the strain across prevented; Simpson's rule is exact for z sigma
  const auto moment = [&](double z) { return z * s.young / (1 - s.poisson * s.poisson) * z; };
  const double half = s.thickness / 2;
  const double integral = s.thickness / 6 * (moment(-half) + 4 * moment(0) + moment(half));
  CHECK(s.bending_stiffness() == Approx(integral).epsilon(1e-14));            // measured: 4e-16
  CHECK(s.bending_stiffness() == Approx(18315018.315018315).epsilon(1e-14));  // measured: 4e-16
}

TEST_CASE("shear stiffness: k G h") {
  const Section steel{200e9, 0.3, 0.1, 5.0 / 6, 7850};
  CHECK(steel.shear_stiffness() == Approx(6410256410.256411).epsilon(1e-14));  // measured: 1e-16
  // S / D = 6 k (1 - nu) / h^2
  const Section other{70, 0.21, 3, 0.8, 0};
  CHECK(other.shear_stiffness() / other.bending_stiffness() == Approx(6 * 0.8 * 0.79 / 9).epsilon(1e-14));  // 0
  CHECK(Section{}.shear_correction == Approx(5.0 / 6));
}

namespace {

plate::Ply ply(double angle, double thickness, double E1 = 140) {
  plate::Ply result;
  static_cast<plate::Orthotropy&>(result) = {E1, 10, 0.3, 5, 4, 3, angle};
  result.thickness = thickness;
  return result;
}

Section of_plies(std::vector<plate::Ply> plies) {
  Section s{0, 0, 0, 5.0 / 6, 2};
  for (const auto& one : plies) s.thickness += one.thickness;
  s.plies = std::move(plies);
  return s;
}

bool same(const LocalSection& a, const LocalSection& b, double tolerance) {
  return a.bending.isApprox(b.bending, tolerance) && a.shear.isApprox(b.shear, tolerance) &&
         a.top.isApprox(b.top, tolerance) && std::abs(a.mass - b.mass) <= tolerance * a.mass &&
         std::abs(a.rotary - b.rotary) <= tolerance * a.rotary;
}

}  // namespace

TEST_CASE("section: an orthotropic material with isotropic numbers is isotropic, at any angle") {
  const Section plain{1000, 0.3, 0.1, 5.0 / 6, 2};
  for (const double angle : {0.0, 30.0, 77.0}) {
    Section s = plain;
    s.orthotropic = {1000, 1000, 0.3, 1000 / 2.6, 1000 / 2.6, 1000 / 2.6, angle};
    CHECK(same(s, plain, 1e-14));  // measured: 2e-16
    CHECK(s.layer() == Approx(plain.layer()).epsilon(1e-13));
    CHECK(s.bending_stiffness() == Approx(plain.bending_stiffness()).epsilon(1e-13));
    CHECK(s.shear_stiffness() == Approx(plain.shear_stiffness()).epsilon(1e-13));
  }
}

TEST_CASE("section: plies by classical lamination") {
  // equal plies are one; the textbook's D11 of 0/90/90/0: Q11 (h^3 - (h/2)^3) / 12 + Q22 (h/2)^3 / 12
  Section one{0, 0, 0.4, 5.0 / 6, 2};
  one.orthotropic = {140, 10, 0.3, 5, 4, 3, 20};
  CHECK(same(of_plies({ply(20, 0.1), ply(20, 0.2), ply(20, 0.1)}), one, 1e-13));
  const LocalSection cross(of_plies({ply(0, 0.1), ply(90, 0.1), ply(90, 0.1), ply(0, 0.1)}));
  const double rest = 1 - 0.09 * 10 / 140, h = 0.4;
  const auto part = [](double x) { return x * x * x / 12; };
  CHECK(cross.bending(0, 0) == Approx((140 * (part(h) - part(h / 2)) + 10 * part(h / 2)) / rest).epsilon(1e-13));
  CHECK(cross.bending(1, 1) == Approx((10 * (part(h) - part(h / 2)) + 140 * part(h / 2)) / rest).epsilon(1e-13));
  CHECK(cross.bending(2, 2) == Approx(5 * part(h)).epsilon(1e-13));
  CHECK(cross.shear(0, 0) == Approx(5.0 / 6 * 0.2 * (4 + 3)).epsilon(1e-13));
  CHECK(cross.top(0, 0) == Approx(140 / rest * h / 2).epsilon(1e-13));  // E1 z of the outer ply
  // a heavy core weighs, but turns little
  auto plies = std::vector{ply(0, 0.1), ply(0, 0.2), ply(0, 0.1)};
  plies[1].density = 20;
  const LocalSection heavy(of_plies(plies));
  CHECK(heavy.mass == Approx(2 * 0.2 + 20 * 0.2));
  CHECK(heavy.rotary == Approx(2 * (part(0.4) - part(0.2)) + 20 * part(0.2)));
}

TEST_CASE("section: plies that are not symmetric couple forces and curvatures") {
  const double rest = 1 - 0.09 * 10 / 140;
  const auto by = [](Section s, plate::PlateLaw law) {
    s.law = law;
    return LocalSection(s);
  };
  // 0/90: A11 = (Q11 + Q22) h / 2, B11 = (Q22 - Q11) h^2 / 8 = -B22, and none of Q12 and Q66
  const auto cross = of_plies({ply(0, 0.1), ply(90, 0.1)});
  const auto A = by(cross, plate::PlateLaw::membrane).bending, B = by(cross, plate::PlateLaw::coupling).bending;
  CHECK(A(0, 0) == Approx((140 + 10) * 0.1 / rest).epsilon(1e-13));
  CHECK(A(2, 2) == Approx(5 * 0.2).epsilon(1e-13));
  CHECK(B(0, 0) == Approx((10 - 140) * 0.04 / 8 / rest).epsilon(1e-13));
  CHECK(B(1, 1) == Approx(-B(0, 0)).epsilon(1e-13));
  CHECK(std::abs(B(0, 1)) + std::abs(B(2, 2)) + std::abs(B(0, 2)) < 1e-13 * A(0, 0));
  CHECK(cross.couples());
  CHECK(of_plies({ply(45, 0.1), ply(-45, 0.1)}).couples());
  CHECK_FALSE(of_plies({ply(30, 0.1), ply(90, 0.2), ply(-150, 0.1)}).couples());
  CHECK_FALSE(Section{1000, 0.3, 0.1, 5.0 / 6, 2}.couples());
  CHECK(by({1000, 0.3, 0.1, 5.0 / 6, 2}, plate::PlateLaw::coupling).bending.isZero(0));
  auto heavy = of_plies({ply(0, 0.1), ply(0, 0.1)});
  CHECK_FALSE(heavy.couples());
  heavy.plies[0].density = 20;
  CHECK(heavy.couples());
}

TEST_CASE("section: regions and factors say what it is at a place") {
  Section s{1000, 0.3, 0.1, 5.0 / 6, 2};
  s.regions.push_back({geometry::Circle{{0, 0}, 0.5, ""}, 0.2, {}, {}, {}});
  s.regions.push_back({geometry::Polygon{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {"", "", "", ""}}, {}, 500.0, {}, 7.0});
  CHECK(s.at({-0.1, 0.1}).thickness == 0.2);
  CHECK(s.at({0.1, 0.1}).young == 500);  // the last counts
  CHECK(s.at({0.1, 0.1}).thickness == 0.1);
  CHECK(s.at({0.1, 0.1}).mass() == Approx(0.7));
  CHECK(s.at({-2, 0}).young == 1000);
  CHECK(s.uniform_within({-0.2, -0.1}) == Approx(std::hypot(0.2, 0.1)));
  CHECK(s.uniform_within({2, 0.5}) == Approx(1));
  s.thickness_factor = plate::Formula("1 + x * x");
  CHECK(s.at({-2, 0}).thickness == Approx(0.5));
  CHECK(s.at({-0.1, 0.1}).thickness == 0.2);
  CHECK(s.uniform_within({0, 0}) == 0);
  CHECK(s.at({0, 0}).simple());
  CHECK_FALSE(s.uniform());
}
