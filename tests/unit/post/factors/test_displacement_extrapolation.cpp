#include "post/factors/displacement_extrapolation.hpp"

#include <cmath>
#include <numbers>
#include <variant>

#include "geometry/lattice/cloud.hpp"
#include "tests/catch.hpp"

using namespace post;
using geometry::CrackPath;
using geometry::End;
using geometry::Point;
using geometry::Tip;

namespace {

constexpr double pi = std::numbers::pi;
const plate::Section thick_section{200, 0.3, 12, 5.0 / 6, 0};  // 12 spacings thick, as in the paper's plates

struct Factors {
  double K1, K2, K3;
};

/// The asymptotic field of a tip (Dai 39) in the tip's axes: w, theta_x', theta_y'.
Eigen::Vector3d asymptotic(const Factors& K, double r, double angle) {
  const double E = thick_section.young, nu = thick_section.poisson, h = thick_section.thickness;
  const double root = std::sqrt(r / 2), c = std::cos(angle), ch = std::cos(angle / 2), sh = std::sin(angle / 2);
  const double factor = 12 * (1 + nu) / (E * h * h * h) * root;
  return {24 * (1 + nu) / (5 * E * h) * root * K.K3 * sh,
          factor * (K.K1 * sh * ((nu - 3) / (1 + nu) + c) + K.K2 * ch * ((1 - 3 * nu) / (1 + nu) + c)),
          factor * (K.K1 * ch * ((3 - nu) / (1 + nu) - c) + K.K2 * sh * ((5 + nu) / (1 + nu) + c))};
}

/// A crack of 80 spacings through the middle of a plate of 120, turned by `degrees`.
struct Scene {
  std::vector<Point> positions;
  CrackPath path;
  std::vector<Tip> tips;
};

Scene scene(double degrees, const Point& middle = {60, 60}) {
  const double angle = degrees * pi / 180;
  // whole numbers of cells along the lattice and its diagonals
  const Point along(std::round(40 * std::cos(angle)), std::round(40 * std::sin(angle)));
  Scene s{geometry::lattice(geometry::rectangle(0, 0, 120, 120), 1).positions,
          {{middle - along, middle + along}, End::tip, End::tip},
          {}};
  s.tips = geometry::tips({s.path});
  return s;
}

/// Dai 39 about one tip at all points, in the plate's axes. Points on the crack lie where (e, e^2) moves them.
plate::State field(const Scene& s, const Tip& tip, const Factors& K) {
  const Point ahead = tip.direction, left(-ahead.y(), ahead.x());
  plate::State state(3, Eigen::Index(s.positions.size()));
  for (std::size_t k = 0; k < s.positions.size(); ++k) {
    const Point x = s.positions[k] - tip.position + Point(1e-9, 1e-18);
    const Eigen::Vector3d u = asymptotic(K, x.norm(), std::atan2(x.dot(left), x.dot(ahead)));
    const Point theta = u[1] * ahead + u[2] * left;
    state.col(Eigen::Index(k)) << u[0], theta.x(), theta.y();
  }
  return state;
}

std::variant<DisplacementExtrapolation, std::string> extrapolation(const std::vector<Point>& positions, const Scene& s,
                                                                   const Tip& tip, const SrifOptions& options) {
  return DisplacementExtrapolation::at(positions, s.path, tip, {thick_section, 1, 3},
                                       paper_fit({thick_section, 1, 3}, options));
}

Srif recovered(const Scene& s, const Tip& tip, const Factors& K, const SrifOptions& options) {
  return std::get<DisplacementExtrapolation>(extrapolation(s.positions, s, tip, options))(field(s, tip, K));
}

}  // namespace

TEST_CASE("K of the exact asymptotic field, cracks along the lattice, both tips") {
  const double degrees = GENERATE(0.0, 90.0, 180.0, 270.0);
  const Scene s = scene(degrees);
  REQUIRE(s.tips.size() == 2);
  SrifOptions options;
  for (const Tip& tip : s.tips) {
    CAPTURE(degrees, tip.at_back);
    const Srif found = recovered(s, tip, {2, -3, 0.5}, options);
    CHECK(found.samples == 6);
    // Dai 39 half a spacing off the crack, over two horizons. Measured: K1 -0.5 %, K2 +13.6 %, K3 +5.3 %
    CHECK(found.K1 == Approx(2).epsilon(0.02));
    CHECK(found.K2 == Approx(-3).epsilon(0.16));
    CHECK(found.K3 == Approx(0.5).epsilon(0.08));
    REQUIRE(found.estimated_error);
    CHECK(*found.estimated_error > 0.14);  // K2 is 13.6 % off
    CHECK(*found.estimated_error < 0.25);
    CHECK(found.fit_residual < 0.05);
  }
}

TEST_CASE("the estimated error of the extrapolation covers where between two columns the points end their crack") {
  const Scene s = scene(0);
  const Tip& tip = s.tips[0];
  for (const double behind : {0.0, 0.25, 0.4, 0.45}) {  // of the last column of points
    CAPTURE(behind);
    // the points hold the field of a tip half way between columns; the crack is given as longer or shorter
    Scene given = s;
    (tip.at_back ? given.path.vertices.back() : given.path.vertices.front()) -= behind * tip.direction;
    const Tip moved = geometry::tips({given.path})[tip.at_back ? 1 : 0];
    const auto fit = std::get<DisplacementExtrapolation>(extrapolation(s.positions, given, moved, SrifOptions{}));
    const Srif found = fit(field(s, tip, {2, 0, 0}));
    CHECK(found.K1 > 1.95);
    REQUIRE(found.errors[0]);
    CHECK(std::abs(found.K1 - 2) < *found.errors[0]);
  }
}

TEST_CASE("a wide window, two rows and no samples next to the tip come closer") {
  const double degrees = GENERATE(0.0, 90.0, 180.0);
  const Scene s = scene(degrees);
  SrifOptions options;
  options.window_horizons = 10;
  options.rows = 2;
  options.skip = 4;
  for (const Tip& tip : s.tips) {
    CAPTURE(degrees, tip.at_back);
    const Srif found = recovered(s, tip, {2, -3, 0.5}, options);
    CHECK(found.samples == 26);
    // measured: K1 +0.1 %, K2 -0.6 %, K3 +0.3 %
    CHECK(found.K1 == Approx(2).epsilon(0.01));
    CHECK(found.K2 == Approx(-3).epsilon(0.01));
    CHECK(found.K3 == Approx(0.5).epsilon(0.01));
  }
}

TEST_CASE("K of the exact asymptotic field, a crack along the diagonal through the points and between them") {
  const double degrees = GENERATE(45.0, 135.0);
  const Point middle = GENERATE(Point(60, 60), Point(60.5, 60), Point(60.3, 60.1));
  const Scene s = scene(degrees, middle);
  for (const Tip& tip : s.tips) {
    CAPTURE(degrees, middle.x(), tip.at_back);
    const Srif found = recovered(s, tip, {2, -3, 0.5}, {});
    // points off the crack by up to 0.7 spacings. Measured: K1 -7.4 %, K2 +18 %, K3 +5.9 % at most
    CHECK(found.K1 == Approx(2).epsilon(0.1));
    CHECK(found.K2 == Approx(-3).epsilon(0.22));
    CHECK(found.K3 == Approx(0.5).epsilon(0.1));
  }
}

TEST_CASE("each mode is seen alone") {
  const Scene s = scene(0);
  for (const Tip& tip : s.tips) {
    const Srif one = recovered(s, tip, {1, 0, 0}, {}), two = recovered(s, tip, {0, 1, 0}, {}),
               three = recovered(s, tip, {0, 0, 1}, {});
    CHECK(std::abs(one.K2) + std::abs(one.K3) < 1e-12);  // measured: 0
    // the lever that carries w to the crack finds no w that goes with the rotations of Dai 39
    CHECK(std::abs(two.K1) + std::abs(two.K3) * thick_section.thickness < 0.1);  // measured: 0.025
    CHECK(std::abs(three.K1) + std::abs(three.K2) < 1e-12);                      // measured: 0
    CHECK(one.K1 > 0.9);
    CHECK(two.K2 > 0.9);
    CHECK(three.K3 > 0.9);
  }
}

TEST_CASE("a jump that grows with the square root exactly gives K exactly") {
  // Dai 40 at all points of each side: K(r) is constant
  const Scene s = scene(0);
  const Tip& tip = s.tips.at(1);
  const double E = thick_section.young, h = thick_section.thickness, nu = thick_section.poisson;
  plate::State state(3, Eigen::Index(s.positions.size()));
  for (std::size_t k = 0; k < s.positions.size(); ++k) {
    const Point x = s.positions[k] - tip.position;
    const double root = std::sqrt(2 * std::max(-x.x(), 0.0)), face = x.y() > 0 ? 0.5 : -0.5;
    state.col(Eigen::Index(k)) << face * 24 * (1 + nu) / (5 * E * h) * root * 7,
        -face * 48 / (E * h * h * h) * root * 2, face * 48 / (E * h * h * h) * root * -3;
  }
  SrifOptions options;
  options.rows = GENERATE(1, 2);
  const Srif found = std::get<DisplacementExtrapolation>(extrapolation(s.positions, s, tip, options))(state);
  CHECK(found.K1 == Approx(2).epsilon(1e-12));   // measured: 4e-16
  CHECK(found.K2 == Approx(-3).epsilon(1e-12));  // measured: 1e-16
  CHECK(found.K3 == Approx(7).epsilon(1e-12));   // measured: 8e-16
  CHECK(found.fit_residual < 1e-12);             // measured: 4e-16
}

TEST_CASE("a window with one sample, or no points beside the crack, gives no extrapolation but the reason") {
  const Scene s = scene(0);
  const auto reason = [&](const std::vector<Point>& positions, const SrifOptions& options) {
    return std::get<std::string>(extrapolation(positions, s, s.tips[0], options));
  };
  SrifOptions narrow;
  narrow.window = 0.7;
  CHECK_THAT(reason(s.positions, narrow), Catch::Contains("the window holds 1 of 2 samples"));
  SrifOptions skipping;
  skipping.skip = 5;
  CHECK_THAT(reason(s.positions, skipping), Catch::Contains("the window holds 1 of 2 samples"));
  CHECK_FALSE(reason({{500, 500}}, {}).empty());
}

TEST_CASE("the window ends where the crack's last straight piece does") {
  Scene s = scene(0);
  s.path.vertices.insert(s.path.vertices.begin() + 1, Point(24, 60));
  CHECK(recovered(s, s.tips[0], {1, 0, 0}, {}).samples == 4);
  CHECK(recovered(s, s.tips[1], {1, 0, 0}, {}).samples == 6);
}

TEST_CASE("normalisation: F = K / (M sqrt a), or with M = p (W/2)^2, shear times the thickness") {
  Srif srif;
  srif.K1 = 6, srif.K2 = -3, srif.K3 = 5;
  SrifOptions options;
  normalize(srif, options, 0.4);
  CHECK_FALSE(srif.F1);
  options.normalize = Normalization{std::nullopt, std::nullopt, 3.0};
  normalize(srif, options, 0.4);
  CHECK_FALSE(srif.F1);  // no half length
  options.half_length = 4;
  normalize(srif, options, 0.4);
  CHECK(*srif.F1 == Approx(1));
  CHECK(*srif.F2 == Approx(-0.5));
  CHECK(*srif.F3 == Approx(1.0 / 3));
  options.normalize = Normalization{0.5, 2.0, std::nullopt};
  normalize(srif, options, 0.4);
  CHECK(*srif.F1 == Approx(6));
}
