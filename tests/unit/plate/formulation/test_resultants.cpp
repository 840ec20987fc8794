#include "plate/bonds/results.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using small_plate::section;

namespace {

small_plate::Model perforated() {
  auto outline = geometry::rectangle(-0.3, 0.2, 0.9, 1.2);
  outline.holes.push_back(geometry::Circle{{0.2, 0.7}, 0.13, "hole"});
  return small_plate::model(outline, {}, small_plate::spaced(0.1));
}

template <typename Field>
Resultants resultants_of(const small_plate::Model& m, const Field& field) {
  State state(3, m.points());
  for (Eigen::Index k = 0; k < state.cols(); ++k) state.col(k) = field(m.boundary.cloud.positions[std::size_t(k)]);
  const auto& b = m.boundary;
  return resultants(state, m.plate.families(), m.plate.shapes(), b.cloud.areas, b.cloud.plate_points, section);
}

}  // namespace

TEST_CASE("thin plate with constant curvatures and twist: exact moments, no shear, at edges and corners too") {
  const auto m = perforated();
  // w = -(a x^2 + b y^2) / 2 - c x y; strains z (a, b, 2 c) with theta_y = -w,x and theta_x = w,y
  const double a = 0.3, b = -0.7, c = 0.45;
  const auto r = resultants_of(m, [&](const geometry::Point& p) {
    return Eigen::Vector3d(-(a * p.x() * p.x() + b * p.y() * p.y()) / 2 - c * p.x() * p.y(), -b * p.y() - c * p.x(),
                           a * p.x() + c * p.y());
  });
  // sigma = E / (1 - nu^2) (eps + nu eps'), tau = G gamma, M = integral of sigma z = sigma(z = 1) h^3 / 12
  const double E = section.young, nu = section.poisson, h = section.thickness, third = h * h * h / 12;
  const Eigen::Vector3d stress(E / (1 - nu * nu) * (a + nu * b), E / (1 - nu * nu) * (b + nu * a), E / (1 + nu) * c);
  REQUIRE(r.moments.cols() > 100);
  CHECK((r.moments.colwise() - stress * third).cwiseAbs().maxCoeff() < 1e-12);  // measured: 8e-16
  CHECK(r.shear.cwiseAbs().maxCoeff() < 1e-11);                                 // measured: 4e-14, k G h = 80
  // von Mises of the principal stresses at h / 2
  const double mean = (stress[0] + stress[1]) / 2, radius = std::hypot((stress[0] - stress[1]) / 2, stress[2]);
  const double s1 = (mean + radius) * h / 2, s2 = (mean - radius) * h / 2;
  const double equivalent = std::sqrt(((s1 - s2) * (s1 - s2) + s1 * s1 + s2 * s2) / 2);
  CHECK((r.von_mises.array() - equivalent).abs().maxCoeff() < 1e-11);  // measured: 6e-14
}

TEST_CASE("von Mises of stresses whose squares are beyond double precision") {
  auto r = resultants_of(1);
  Eigen::Matrix2d theta = Eigen::Matrix2d::Zero();
  for (const double size : {1e-200, 1.0, 1e200}) {
    theta << 0, -size, size, 0;  // bent alike along x and y: the stress is the same in all directions, and von Mises it
    set(r, 0, section, theta, Eigen::Vector2d::Zero());
    const double stress = section.young / (1 - section.poisson) * size * section.thickness / 2;
    CHECK(r.von_mises[0] == Approx(stress).epsilon(1e-12));
  }
}

TEST_CASE(
    "principal stresses: of a state that is turned, by every angle, and opposite faces change their order and sign") {
  constexpr double degrees = 180 / 3.14159265358979323846;
  for (const double s1 : {5.0, 0.0, -1.0})
    for (const double s2 : {-1.5, -4.0})
      for (double angle = -89; angle <= 90; angle += 17.9) {
        const double c = std::cos(angle / degrees), s = std::sin(angle / degrees);
        const Eigen::Vector3d stress(s1 * c * c + s2 * s * s, s1 * s * s + s2 * c * c, (s1 - s2) * c * s);
        const auto found = principal(stress), below = principal(-stress);
        CAPTURE(s1, s2, angle);
        CHECK(found.largest == Approx(s1).margin(1e-12));
        CHECK(found.smallest == Approx(s2).margin(1e-12));
        CHECK(found.angle == Approx(angle).margin(1e-9));
        CHECK(below.largest == Approx(-s2).margin(1e-12));
        CHECK(std::abs(std::remainder(below.angle - angle, 180)) == Approx(90).margin(1e-9));
      }
  CHECK(principal({0, -1, 0}).angle == Approx(0).margin(1e-12));
  CHECK(principal({-1, 0, 0}).angle == Approx(90));
}

TEST_CASE("faces: membrane forces add to the stress of both, with the sign of the face") {
  auto bending = resultants_of(2), membrane = resultants_of(2);
  auto in_plane = section;
  in_plane.law = PlateLaw::membrane;
  const double h = section.thickness;
  Eigen::Matrix3Xd M(3, 2), N(3, 2);
  M << 0.3, -0.1, 0.2, 0.4, -0.5, 0.6;
  N << 7, -3, 2, 5, -4, 1;
  for (Eigen::Index k = 0; k < 2; ++k) set_moments(bending, k, M.col(k), section), membrane.moments.col(k) = N.col(k);
  CHECK(bending.top.isApprox(6 / (h * h) * M, 1e-12));
  CHECK(bending.at_bottom().isApprox(-bending.top, 1e-12));
  add_membrane_forces(bending, section, membrane, in_plane);
  CHECK(bending.top.isApprox(N / h + 6 / (h * h) * M, 1e-12));
  CHECK(bending.at_bottom().isApprox(N / h - 6 / (h * h) * M, 1e-12));
  for (Eigen::Index k = 0; k < 2; ++k) {
    double larger = 0;
    for (const Eigen::Vector3d& s : {Eigen::Vector3d(bending.top.col(k)), Eigen::Vector3d(bending.bottom.col(k))})
      larger = std::max(larger, std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]));
    CHECK(bending.von_mises[k] == Approx(larger).epsilon(1e-12));
  }
}

TEST_CASE("constant shear angles: exact shear forces and no moments") {
  const auto m = perforated();
  // gamma_xz = w,x + theta_y = 0.2 + 0.3, gamma_yz = w,y - theta_x = -0.1 - 0.4
  const auto r = resultants_of(
      m, [](const geometry::Point& p) { return Eigen::Vector3d(5 + 0.2 * p.x() - 0.1 * p.y(), 0.4, 0.3); });
  const double G = section.young / 2.6;
  const Eigen::Vector2d expected = 5.0 / 6 * G * section.thickness * Eigen::Vector2d(0.5, -0.5);
  CHECK((r.shear.colwise() - expected).cwiseAbs().maxCoeff() < 1e-11);  // measured: 3e-13
  CHECK(r.moments.cwiseAbs().maxCoeff() < 1e-12);                       // measured: 0
  CHECK(r.von_mises.cwiseAbs().maxCoeff() < 1e-10);                     // measured: 0
}

TEST_CASE("fictitious points take part but get no resultants") {
  const auto m = small_plate::model(geometry::rectangle(0, 0, 0.8, 0.6), {{SupportKind::symmetry, {"left"}, {}}},
                                    small_plate::spaced(0.1));
  const auto r =
      resultants_of(m, [](const geometry::Point& p) { return Eigen::Vector3d(-p.x() * p.x() / 2, 0, p.x()); });
  REQUIRE(m.points() > 48);
  CHECK(r.moments.cols() == 48);
  CHECK(r.shear.cols() == 48);
  CHECK(r.von_mises.size() == 48);
  CHECK((r.moments.row(1) - section.poisson * r.moments.row(0)).cwiseAbs().maxCoeff() < 1e-12);  // measured: 6e-17
}

TEST_CASE("points with one bond or none: finite") {
  const auto line = small_plate::model(geometry::rectangle(0, 0, 0.3, 0.1), {}, small_plate::spaced(0.1));
  REQUIRE(line.points() == 3);
  const auto bend = [](const geometry::Point& p) { return Eigen::Vector3d(-p.x() * p.x() / 2, 0, p.x()); };
  const auto r = resultants_of(line, bend);
  CHECK(r.moments.row(0).minCoeff() == Approx(section.bending_stiffness()));
  CHECK(r.moments.row(0).maxCoeff() == Approx(section.bending_stiffness()));
  const auto alone =
      resultants_of(small_plate::model(geometry::rectangle(0, 0, 0.1, 0.1), {}, small_plate::spaced(0.1)), bend);
  REQUIRE(alone.moments.cols() == 1);
  CHECK(alone.moments.norm() == 0);
}
