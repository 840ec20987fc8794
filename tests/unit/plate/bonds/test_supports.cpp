#include "plate/bonds/supports.hpp"

#include <Eigen/Geometry>
#include <numbers>
#include <numeric>
#include <set>

#include "tests/catch.hpp"
#include "tests/unit/plate/held_plate.hpp"

using namespace plate;
using namespace held_plate;
using geometry::Point;

namespace {

/// Tie of a degree of freedom: (leader, factor); nothing where it is free.
std::optional<std::pair<Dof, double>> tie_of(const Boundary& b, const Dof& dof) {
  for (const auto& tie : b.constraints.ties())
    if (tie.follower == dof) return std::pair{tie.leader, tie.factor};
  return std::nullopt;
}

bool is_fixed(const Boundary& b, const Dof& dof) {
  const auto& all = b.constraints.fixed();
  return std::find(all.begin(), all.end(), dof) != all.end();
}

/// The image at `u` follows the point at `original` with these three signs.
void check_image(const Boundary& b, const Point& u, const Point& original, const std::array<double, 3>& signs) {
  const auto image = point_at(b, u), k = point_at(b, original);
  REQUIRE(image);
  REQUIRE(k);
  CHECK_FALSE(b.is_plate(*image));
  for (std::uint32_t c = 0; c < 3; ++c) {
    const auto tie = tie_of(b, dof(*image, c));
    REQUIRE(tie);
    CHECK(tie->first == dof(*k, c));
    CHECK(tie->second == signs[c]);
  }
}

}  // namespace

TEST_CASE("mirror images: one per point within the horizon, squares at the corners") {
  CHECK(held({}).fictitious.empty());
  CHECK(held({{SupportKind::clamped, {"left"}, {}}}).fictitious.size() == 3 * 7);
  CHECK(held({{SupportKind::clamped, {"bottom"}, {}}}).fictitious.size() == 3 * 8);
  CHECK(held({{SupportKind::clamped, {"left", "bottom"}, {}}}).fictitious.size() == 3 * 7 + 3 * 8 + 9);
  CHECK(held({{SupportKind::clamped, {"left", "right"}, {}}}).fictitious.size() == 2 * 3 * 7);
  const auto kind = GENERATE(SupportKind::clamped, SupportKind::simply_supported_hard, SupportKind::symmetry);
  const Boundary b = held({all_round(kind)});
  CHECK(b.fictitious.size() == 2 * (3 * 7 + 3 * 8) + 4 * 9);
  CHECK(b.cloud.size() == 56 + b.fictitious.size());
  CHECK(b.cloud.plate_points == 56);
  CHECK(b.warnings.empty());
  std::set<std::pair<double, double>> places;
  for (std::size_t i = 0; i < b.lattice.size(); ++i) places.insert({b.lattice[i].x(), b.lattice[i].y()});
  CHECK(places.size() == b.lattice.size());  // no two at one place
  CHECK(places.size() == (8 + 6) * (7 + 6));
  for (std::size_t i = 0; i < b.fictitious.size(); ++i) {
    CHECK(b.fictitious[i].exact);
    CHECK_FALSE(b.active[56 + i]);
  }
}

TEST_CASE("signs of the images by kind") {
  const auto on = [](SupportKind kind, const char* edge) { return held({{kind, {edge}, {}}}); };
  const Point left(-1.5, 2.5), of_left(1.5, 2.5), top(3.5, 8.5), of_top(3.5, 5.5);
  check_image(on(SupportKind::clamped, "left"), left, of_left, {-1, -1, -1});
  // hard: w and the rotation along the edge odd; on a vertical edge psi_s = theta_x
  check_image(on(SupportKind::simply_supported_hard, "left"), left, of_left, {-1, -1, 1});
  check_image(on(SupportKind::simply_supported_hard, "top"), top, of_top, {-1, 1, -1});
  // a mirror: the rotation across it odd; on a vertical edge psi_n = -theta_y
  check_image(on(SupportKind::symmetry, "left"), left, of_left, {1, 1, -1});
  check_image(on(SupportKind::symmetry, "top"), top, of_top, {1, -1, 1});
}

TEST_CASE("corners: the image of the image, signs multiplied") {
  const Boundary b = held({{SupportKind::clamped, {"left"}, {}}, {SupportKind::symmetry, {"bottom"}, {}}});
  check_image(b, {-2.5, -0.5}, {2.5, 0.5}, {-1, 1, -1});
  CHECK_FALSE(point_at(b, {8.5, -0.5}));  // the free right edge has no corner square
}

TEST_CASE("soft support: the first row's deflection is a third of the second's, a ninth at a corner") {
  const Boundary b = held({{SupportKind::simply_supported, {"left", "bottom"}, {}}});
  CHECK(b.fictitious.empty());
  const auto check = [&](const Point& u, const Point& leader, double factor) {
    const auto tie = tie_of(b, dof(*point_at(b, u), 0));
    REQUIRE(tie);
    CHECK(tie->first == dof(*point_at(b, leader), 0));
    CHECK(tie->second == Approx(factor).epsilon(1e-14));  // measured: 0
  };
  check({0.5, 4.5}, {1.5, 4.5}, 1.0 / 3);
  check({4.5, 0.5}, {4.5, 1.5}, 1.0 / 3);
  check({0.5, 0.5}, {1.5, 1.5}, 1.0 / 9);
  CHECK(b.constraints.ties().size() == 8 + 7 - 1);  // w only
  CHECK(b.constraints.fixed().empty());
}

TEST_CASE("soft support on a plate one cell wide holds its points at zero") {
  const Boundary b = held({{SupportKind::simply_supported, {"left"}, {}}}, geometry::rectangle(0, 0, 1, 4));
  CHECK(b.constraints.fixed().size() == 4);
}

TEST_CASE("pins hold their place next to a point, which turns about it, or the point itself") {
  const Boundary b = held({{SupportKind::pinned, {}, {{1.6, 2.2}, {7.5, 6.5}}}});
  CHECK(b.constraints.fixed() == std::vector<Dof>{dof(55, 0)});
  REQUIRE(b.constraints.ties().size() == 2);
  for (const auto& tie : b.constraints.ties()) {  // w = -(0.1, -0.3) . psi, psi = (-theta_y, theta_x)
    CHECK(tie.follower == dof(17, 0));
    CHECK(tie.factor == Approx(tie.leader == dof(17, 1) ? 0.3 : 0.1));
  }
}

TEST_CASE("layers: three cells outside a held edge, with the squares between two") {
  using enum SupportKind;
  CHECK(held({{clamped_layer, {"left"}, {}}}).fictitious.size() == 3 * 7);
  CHECK(held({{clamped_layer, {"left", "top"}, {}}}).fictitious.size() == 3 * 7 + 3 * 8 + 9);
  CHECK(held({{clamped_layer, {"left", "right"}, {}}}).fictitious.size() == 2 * 3 * 7);
  const auto kind = GENERATE(clamped_layer, simply_supported_layer, simply_supported_hard_layer);
  const Boundary b = held({all_round(kind)});
  REQUIRE(b.fictitious.size() == (8 + 6) * (7 + 6) - 8 * 7);
  CHECK(b.constraints.ties().empty());
  const auto fixes = [&](const Point& u) {
    const auto k = point_at(b, u);
    REQUIRE(k);
    CHECK(b.active[*k]);  // stores energy
    CHECK(b.cloud.areas[*k] == 1);
    return std::array<bool, 3>{is_fixed(b, dof(*k, 0)), is_fixed(b, dof(*k, 1)), is_fixed(b, dof(*k, 2))};
  };
  const bool clamp = kind == clamped_layer, hard = kind == simply_supported_hard_layer;
  CHECK(fixes({-2.5, 3.5}) == std::array<bool, 3>{true, clamp || hard, clamp});  // vertical edge: theta_x is tangential
  CHECK(fixes({3.5, 9.5}) == std::array<bool, 3>{true, clamp, clamp || hard});
  CHECK(fixes({-0.5, -0.5}) == std::array<bool, 3>{true, clamp || hard, clamp || hard});
}

TEST_CASE("layers in a re-entrant corner end where the edges do", "") {
  const Boundary b = held({{SupportKind::clamped_layer, {"step", "wall"}, {}}}, angle_shape());
  // 5 x 3 along the step, 3 x 5 along the wall, 3 x 3 of both; more where corner squares are added there too
  CHECK(b.fictitious.size() == 15 + 15 - 9);
}

TEST_CASE("an edge off the lattice is held by outside points that follow the place of their image") {
  const auto outline = geometry::rectangle(0, 0, 8, 6.75);
  const Boundary b = held({{SupportKind::clamped, {"top"}, {}}}, outline);
  CHECK(b.warnings.size() == 1);
  REQUIRE(b.fictitious.size() >= 3 * 8);
  const double line = 6.75 - 0.02;
  for (std::uint32_t i = 56; i < b.lattice.size(); ++i) {
    CHECK(b.lattice[i].y() > 6.75);
    double straight = 0;  // w outside, of w = line - y inside
    for (const auto& tie : b.constraints.ties())
      if (tie.follower == dof(i, 0) && is_deflection(tie.leader))
        straight += tie.factor * (line - b.lattice[tie.leader.point].y());
    CHECK(straight == Approx(line - b.lattice[i].y()).epsilon(1e-12));  // rounding
  }
}

TEST_CASE("beyond a clamped side constant curvature and constant shear go on as they are") {
  // along the inner normal from the line, at distance d: w = kappa d^2 / 2 + gamma d, psi_n = kappa d
  const double kappa = 0.3, gamma = 0.7;
  struct Named {
    const char* side;
    Point from, inward;
  };
  // the second outline puts the right edge within a cell: images are not mirror images there
  const auto outline = GENERATE(geometry::rectangle(0, 0, 8, 7), geometry::rectangle(0, 0, 7.8, 7));
  const double width = geometry::bounding_box(outline).second.x();
  const double right = width < 8 ? width - 0.02 : width;  // such images are taken about a line 0.02 spacings further in
  for (const Named& n : {Named{"left", {0, 0}, {1, 0}}, Named{"right", {right, 0}, {-1, 0}},
                         Named{"bottom", {0, 0}, {0, 1}}, Named{"top", {0, 7}, {0, -1}}}) {
    INFO(n.side);
    const Boundary b = held({{SupportKind::clamped, {n.side}, {}}}, outline);
    const auto exact = [&](const Point& x) {
      const double d = (x - n.from).dot(n.inward);
      const Point psi = kappa * d * n.inward;  // psi = (-theta_y, theta_x)
      return Eigen::Vector3d(kappa * d * d / 2 + gamma * d, psi.y(), -psi.x());
    };
    State u(3, Eigen::Index(b.cloud.size()));
    for (std::size_t k = 0; k < b.cloud.size(); ++k)
      u.col(Eigen::Index(k)) = b.is_plate(std::uint32_t(k)) ? exact(b.cloud.positions[k]) : Eigen::Vector3d(9, 9, 9);
    b.constraints.impose(u);
    REQUIRE(b.cloud.size() > b.cloud.plate_points);
    double error = 0;
    for (std::size_t k = b.cloud.plate_points; k < b.cloud.size(); ++k)
      error = std::max(error, (u.col(Eigen::Index(k)) - exact(b.cloud.positions[k])).cwiseAbs().maxCoeff());
    CHECK(error < 1e-12);  // rounding, also where the leader is not the mirror image
  }
}

TEST_CASE("images beyond a clamped side in any direction go on with constant curvature and constant shear") {
  const double degrees = GENERATE(3, 17, 45, 71);
  const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
  geometry::Outline outline;
  for (const auto& x : {Point(-8, -7), Point(8, -7), Point(8, 7), Point(-8, 7)})
    outline.outer.vertices.push_back(turn * x);
  outline.outer.edge_names = {"bottom", "right", "top", "left"};
  auto cloud = geometry::lattice(outline, 1);
  const auto in_cells = geometry::to_lattice(outline, cloud.units);
  const Boundary b =
      plate::boundary(std::move(cloud), in_cells, {{SupportKind::clamped, {"bottom"}, {}}}, small_plate::spaced(1));
  const Side& side = b.sides[0];
  const Point inward = turn * Point(0, 1), along = turn * Point(1, 0);
  const double kappa = 0.3, gamma = 0.7;
  const auto exact = [&](const Point& x) {
    const double d = side.inside(b.cloud.units.to_lattice(x)) - 0.02;
    const Point psi = kappa * d * inward;
    return Eigen::Vector3d(kappa * d * d / 2 + gamma * d, psi.y(), -psi.x());
  };
  State u(3, Eigen::Index(b.cloud.size()));
  for (std::size_t k = 0; k < b.cloud.size(); ++k)
    u.col(Eigen::Index(k)) = b.is_plate(std::uint32_t(k)) ? exact(b.cloud.positions[k]) : Eigen::Vector3d(9, 9, 9);
  b.constraints.impose(u);
  double error = 0;
  int images = 0;
  for (std::size_t k = b.cloud.plate_points; k < b.cloud.size(); ++k) {
    const double s = along.dot(b.cloud.positions[k]);
    if (std::abs(s) > 5) continue;  // beside corners images follow one point
    ++images;
    error = std::max(error, (u.col(Eigen::Index(k)) - exact(b.cloud.positions[k])).cwiseAbs().maxCoeff());
  }
  CHECK(images > 20);
  CHECK(error < 1e-9);  // shares of less do not count
}
