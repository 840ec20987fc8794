#include "plate/galerkin/supports.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

namespace {

/// A square of side 1 of which a corner is cut off obliquely.
const geometry::Outline outline{
    {{{0, 0}, {1, 0}, {1, 0.5}, {0.6, 1}, {0, 1}}, {"south", "east", "slope", "north", "west"}}, {}};
const auto cells = gp::cells(outline, 0.1, {{{0, 0.5}, {0.5, 0.5}}});

/// What of a random state is left at the points of an edge, but for its ends: w, psi_n, psi_s at most.
Eigen::Vector3d left_at(const std::string& edge, SupportKind kind) {
  const std::vector<double> areas(cells.positions.size(), 0.01);
  const auto boundary = galerkin_boundary(cells, areas, outline, {{kind, {edge}, {}}});
  State u = gp::random_state(cells.positions.size(), 5);
  boundary.constraints.impose(u);
  Eigen::Vector3d most = Eigen::Vector3d::Zero();
  for (const auto& border : cells.borders) {
    if (border.edge < 0 || cells.names[std::size_t(border.edge)] != edge) continue;
    const geometry::Point along = (cells.positions[border.to] - cells.positions[border.from]).normalized();
    for (const auto k : {border.from, border.to}) {
      const auto i = Eigen::Index(k);
      const geometry::Point psi(-u(2, i), u(1, i));
      most = most.cwiseMax(
          Eigen::Vector3d(u(0, i), psi.dot(geometry::Point(along.y(), -along.x())), psi.dot(along)).cwiseAbs());
    }
  }
  return most;
}

}  // namespace

TEST_CASE("Galerkin supports: each kind holds what it says along and across its edge, oblique ones too") {
  using enum SupportKind;
  for (const char* edge : {"south", "east", "slope"}) {
    INFO(edge);
    const auto held = [&](SupportKind kind) {
      const auto left = left_at(edge, kind);
      return std::array{left[0] < 1e-14, left[1] < 1e-14, left[2] < 1e-14};
    };
    CHECK(held(clamped) == std::array{true, true, true});
    CHECK(held(simply_supported) == std::array{true, false, false});
    CHECK(held(simply_supported_hard) == std::array{true, false, true});
    CHECK(held(symmetry) == std::array{false, true, false});
    CHECK(held(free) == std::array{false, false, false});
  }
}

TEST_CASE("Galerkin supports: a mouth is held on both sides of the crack, and so is a pin on its faces") {
  using enum SupportKind;
  const std::vector<double> areas(cells.positions.size(), 0.01);
  const auto boundary = galerkin_boundary(cells, areas, outline, {{clamped, {"west"}, {}}, {pinned, {}, {{0.3, 0.5}}}});
  std::size_t mouths = 0, faces = 0;
  for (std::uint32_t k = 0; k < cells.positions.size(); ++k) {
    const auto& x = cells.positions[k];
    if ((x - geometry::Point(0, 0.5)).norm() < 1e-9) mouths += boundary.constraints.held(dof(k, 0));
    if ((x - geometry::Point(0.3, 0.5)).norm() < 1e-9) faces += boundary.constraints.held(dof(k, 0));
    if (x.x() > 1e-9 && (x - geometry::Point(0.3, 0.5)).norm() > 1e-9)
      CHECK_FALSE(boundary.constraints.held(dof(k, 0)));
  }
  CHECK(mouths == 2);
  CHECK(faces == 2);
  REQUIRE(boundary.holders.size() == 2);
  for (const auto& hold : boundary.holds) CHECK(boundary.constraints.held(dof(hold.point, hold.rotations ? 1 : 0)));
}

TEST_CASE("Galerkin supports: a small hole that is simply supported is free to turn about its edge, and only so") {
  using enum SupportKind;
  // with nine pieces: both rotations held, deflections of a plate on such a hole were 35 % too small
  for (const double radius : {0.03, 0.1, 0.17, 0.3}) {  // 8, 8, 11, 19 pieces
    auto plate = geometry::rectangle(0, 0, 1.2, 0.8);
    plate.holes.push_back(geometry::Circle{{0.63, 0.42}, radius, "hole"});
    const auto holed = gp::cells(plate, 0.1);
    const std::vector<double> areas(holed.positions.size(), 0.01);
    for (const auto kind : {simply_supported_hard, symmetry, clamped}) {
      const auto boundary = galerkin_boundary(holed, areas, plate, {{kind, {"hole"}, {}}});
      State u = gp::random_state(holed.positions.size(), 8);
      boundary.constraints.impose(u);
      double along = 0, across = 0;
      for (std::size_t k = 0; k < holed.positions.size(); ++k) {
        const geometry::Point out = holed.positions[k] - geometry::Point(0.63, 0.42);
        if (std::abs(out.norm() - radius) > 1e-9) continue;
        const auto i = Eigen::Index(k);
        const geometry::Point psi(-u(2, i), u(1, i)), n = out.normalized();
        along = std::max(along, std::abs(psi.dot(geometry::Point(-n.y(), n.x()))));
        across = std::max(across, std::abs(psi.dot(n)));
      }
      CAPTURE(radius, int(kind), along, across);
      CHECK((along > 0.05) == (kind == symmetry));
      CHECK((across > 0.05) == (kind == simply_supported_hard));
    }
  }
}

TEST_CASE("Galerkin supports: a corner of two edges that settle alike is moved once") {
  using enum SupportKind;
  const std::vector<double> areas(cells.positions.size(), 0.01);
  const std::vector<SupportMotion> motions{{0, {.value = 0.01}}, {1, {.support = 1, .value = 0.01}}};
  for (const auto first : {clamped, simply_supported, simply_supported_hard})
    for (const auto second : {clamped, simply_supported, simply_supported_hard}) {
      const auto boundary =
          galerkin_boundary(cells, areas, outline, {{first, {"west"}, {}}, {second, {"south"}, {}}}, motions);
      const auto points = cells.positions.size();
      const State lift = boundary.constraints.lift(0, points) + boundary.constraints.lift(1, points);
      CHECK(lift.row(0).maxCoeff() == 0.01);
      CHECK(lift.row(0).minCoeff() == 0);
      CHECK(lift.bottomRows(2).isZero(1e-15));
    }
}
