#include "plate/formulation/mechanisms.hpp"

#include <random>

#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using geometry::CrackPath;
using geometry::End;

namespace {

const Support clamped_left{SupportKind::clamped, {"left"}, {}};
const Support hard_left{SupportKind::simply_supported_hard, {"left"}, {}};

/// 12 x 9 points.
small_plate::Model cracked(const std::vector<CrackPath>& cracks, const Support& support = clamped_left) {
  return small_plate::model(geometry::rectangle(0, 0, 1.2, 0.9), {support}, small_plate::spaced(0.1), cracks);
}

Mechanisms mechanisms_of(const small_plate::Model& m, const Forces& load) {
  return mechanisms(m.boundary, m.plate.families(), pieces(m.boundary, m.plate.families()), load);
}

/// Takes a plate into its plane.
small_plate::Model in_plane(const std::vector<CrackPath>& cracks, const Support& support = clamped_left) {
  return small_plate::model(geometry::rectangle(0, 0, 1.2, 0.9), {support}, small_plate::spaced(0.1), cracks,
                            PlateLaw::membrane);
}

Mechanisms mechanisms_in_plane(const small_plate::Model& m, const Forces& load) {
  const auto found = pieces(m.boundary, m.plate.families(), PlateLaw::membrane);
  return mechanisms(m.boundary, m.plate.families(), found, load, PlateLaw::membrane);
}

Forces pressure(const small_plate::Model& m) {
  Forces load = Forces::Zero(3, m.points());
  load.row(0).head(Eigen::Index(m.boundary.cloud.plate_points)).setOnes();
  return load;
}

/// Eigenvalues of P^T K P that are zero, with a unit diagonal.
Eigen::Index zero_modes(const small_plate::Model& m) {
  const Eigen::MatrixXd P = small_plate::prolongation(m.boundary.constraints, 3 * m.points());
  const Eigen::MatrixXd K = dense::folded(small_plate::stiffness(m.plate), P);
  const Eigen::VectorXd scale = K.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1; });
  const Eigen::VectorXd values = dense::eigenvalues(dense::scaled(K, scale));
  CHECK(values[0] > -1e-13);
  return (values.array() < 1e-12).count();
}

}  // namespace

TEST_CASE("a whole plate has no mechanism, with any crack that leaves two rows") {
  for (const auto& cracks : {std::vector<CrackPath>{},
                             {{{{6, -1}, {6, 7}}, End::mouth, End::tip}},
                             {{{{3, 3}, {8, 3}}, End::tip, End::tip}, {{{3, 5}, {8, 5}}, End::tip, End::tip}},
                             {{{{2.5, 2.5}, {6.5, 6.5}}, End::tip, End::tip}}}) {
    const auto m = cracked(cracks);
    const auto found = mechanisms_of(m, pressure(m));
    CHECK(found.parts == 1);
    CHECK(found.twisting == 0);
    CHECK(found.motions == 0);
    CHECK_FALSE(found.driven);
    CHECK_FALSE(found.twisted);
    CHECK(zero_modes(m) == 0);
  }
}

TEST_CASE("beyond a ligament of one row the plate turns") {
  const auto m = cracked({{{{6, -1}, {6, 8.4}}, End::mouth, End::tip}});
  const auto found = mechanisms_of(m, pressure(m));
  CHECK(found.parts == 2);  // each end of the row belongs to its side
  CHECK(found.twisting == 0);
  CHECK(found.motions == 1);
  CHECK(zero_modes(m) == 1);
  REQUIRE(found.driven);
  CHECK(found.driven->points == 6 * 9);
  CHECK((found.driven->position - geometry::Point(0.65, 0.05)).norm() < 1e-12);
  CHECK(found.driven->ligament.y() == Approx(0.85));
  // a load that is in balance about the ligament turns nothing
  Forces balanced = Forces::Zero(3, m.points());
  balanced(0, 8 * 12 + 8) = 1;  // on the line of the row
  CHECK(mechanisms_of(m, balanced).motions == 1);
  CHECK_FALSE(mechanisms_of(m, balanced).driven);
}

TEST_CASE("points of a row between two cracks turn about it") {
  const std::vector<CrackPath> cracks{{{{2, 4}, {10, 4}}, End::tip, End::tip}, {{{2, 5}, {10, 5}}, End::tip, End::tip}};
  const auto m = cracked(cracks);
  const auto found = mechanisms_of(m, pressure(m));
  CHECK(found.motions == 0);
  CHECK(found.parts == 2);
  CHECK(found.twisting > 0);
  CHECK(Eigen::Index(found.twisting) == zero_modes(m));
  CHECK_FALSE(found.driven);
  CHECK_FALSE(found.twisted);
  Forces couple = Forces::Zero(3, m.points());
  couple(1, 4 * 12 + 6) = 1;  // about the row
  REQUIRE(mechanisms_of(m, couple).twisted);
  CHECK((mechanisms_of(m, couple).twisted->position - geometry::Point(0.65, 0.45)).norm() < 1e-12);
}

TEST_CASE("points whose turn about their bonds is tied move with the plate and have no zero mode") {
  const std::vector<CrackPath> across{{{{2, 4}, {10, 4}}, End::tip, End::tip}, {{{2, 5}, {10, 5}}, End::tip, End::tip}};
  const std::vector<CrackPath> oblique{{{{2, 1.5}, {8, 7.5}}, End::tip, End::tip},
                                       {{{1.5, 2}, {7.5, 8}}, End::tip, End::tip}};
  for (const auto& cracks : {across, oblique}) {
    auto m = cracked(cracks);
    REQUIRE(mechanisms_of(m, pressure(m)).twisting > 0);
    REQUIRE(zero_modes(m) > 0);
    const auto held = m.boundary.constraints.held().size();
    tie_twists(m.boundary, m.plate.families());
    CHECK(m.boundary.constraints.held().size() == held + mechanisms_of(m, pressure(m)).twisting);
    CHECK(zero_modes(m) == 0);
  }
}

TEST_CASE("a point whose turn is tied turns with the plate as a rigid body") {
  const std::vector<CrackPath> oblique{{{{2, 1.5}, {8, 7.5}}, End::tip, End::tip},
                                       {{{1.5, 2}, {7.5, 8}}, End::tip, End::tip}};
  auto m = small_plate::model(geometry::rectangle(0, 0, 1.2, 0.9), {}, small_plate::spaced(0.1), oblique);
  tie_twists(m.boundary, m.plate.families());
  REQUIRE(!m.boundary.constraints.held().empty());
  State u(3, m.points());
  for (Eigen::Index k = 0; k < u.cols(); ++k) {
    const auto& x = m.boundary.cloud.positions[std::size_t(k)];
    u.col(k) << 1 + 2 * x.x() - 3 * x.y(), -3, -2;  // psi = (-theta_y, theta_x) = (2, -3)
  }
  State imposed = u;
  m.boundary.constraints.impose(imposed);
  CHECK((imposed - u).cwiseAbs().maxCoeff() < 1e-12);  // measured: 1e-15
}

TEST_CASE("a bridge of one row is a hinge: a pressure is in balance about it in the middle, and not elsewhere") {
  for (const double y : {0.4, 0.3}) {  // a little narrower than a row, so that no oblique bond touches a corner
    geometry::Outline dumbbell{{{{0, 0},
                                 {0.4, 0},
                                 {0.4, y + 0.01},
                                 {0.8, y + 0.01},
                                 {0.8, 0},
                                 {1.2, 0},
                                 {1.2, 0.9},
                                 {0.8, 0.9},
                                 {0.8, y + 0.09},
                                 {0.4, y + 0.09},
                                 {0.4, 0.9},
                                 {0, 0.9}},
                                {}},
                               {}};
    dumbbell.outer.edge_names.assign(11, "rest");
    dumbbell.outer.edge_names.push_back("left");
    const auto m = small_plate::model(dumbbell, {clamped_left}, small_plate::spaced(0.1));
    const auto found = mechanisms_of(m, pressure(m));
    CAPTURE(y);
    CHECK(found.motions == 1);
    CHECK(zero_modes(m) == Eigen::Index(found.twisting) + 1);
    CHECK(found.driven.has_value() == (y < 0.4));
  }
}

TEST_CASE("a support that leaves a motion of the piece leaves none of a hinge") {
  const auto m = cracked({}, hard_left);
  CHECK(mechanisms_of(m, pressure(m)).motions == 0);
  CHECK(zero_modes(m) == 1);
}

TEST_CASE("two hinges on different lines hold") {
  const std::vector<CrackPath> cracks{{{{6, 0.6}, {6, 8.4}}, End::tip, End::tip}};
  const auto m = cracked(cracks);
  const auto found = mechanisms_of(m, pressure(m));
  CHECK(found.parts == 2);
  CHECK(found.motions == 0);
  CHECK(zero_modes(m) == 0);
}

TEST_CASE("pieces, hinges and twists together are the zero modes of the stiffness, for cracks at random") {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> coordinate(0, 32);  // quarters of a spacing: through points, between them, oblique
  std::size_t with_hinge = 0, with_twist = 0;
  for (int plates = 0; plates < 20; ++plates) {
    std::vector<CrackPath> cracks;
    for (int i = 0; i < 8; ++i) {
      const geometry::Point from(coordinate(random) / 4.0, coordinate(random) / 4.0);
      const geometry::Point to(coordinate(random) / 4.0, coordinate(random) / 4.0);
      if (from != to) cracks.push_back({{from, to}, End::tip, End::tip});
    }
    const auto m =
        small_plate::model(geometry::rectangle(0, 0, 0.8, 0.8), {clamped_left}, small_plate::spaced(0.1), cracks);
    const auto found = mechanisms_of(m, pressure(m));
    REQUIRE(found.searched);
    Eigen::Index expected = found.motions + Eigen::Index(found.twisting);
    for (const auto& piece : pieces(m.boundary, m.plate.families())) expected += piece.free_modes;
    with_hinge += found.motions > 0;
    with_twist += found.twisting > 0;
    CAPTURE(plates, found.motions, found.twisting, found.parts);
    CHECK(zero_modes(m) == expected);
  }
  CAPTURE(with_hinge, with_twist);
  CHECK((with_hinge > 1 && with_twist > 5));
}

TEST_CASE("in the plane a ligament of one row is a hinge that lets the plate turn and slide") {
  for (const auto& [cracks, motions] :
       std::vector<std::pair<std::vector<CrackPath>, int>>{{{}, 0},
                                                           {{{{{2.5, 2.5}, {6.5, 6.5}}, End::tip, End::tip}}, 0},
                                                           {{{{{6, -1}, {6, 7}}, End::mouth, End::tip}}, 0},
                                                           {{{{{6, -1}, {6, 8.4}}, End::mouth, End::tip}}, 2}}) {
    CAPTURE(cracks.size(), motions);
    const auto m = in_plane(cracks);
    Forces pull = Forces::Zero(3, m.points());
    pull(2, 8 * 12 + 11) = 1;  // along the row
    const auto found = mechanisms_in_plane(m, pull);
    CHECK(found.motions == motions);
    CHECK(zero_modes(m) == motions);
    CHECK_FALSE(found.driven);
    pull.setZero(), pull(1, 8 * 12 + 11) = 1;  // across it
    CHECK(mechanisms_in_plane(m, pull).driven.has_value() == (motions > 0));
  }
}

TEST_CASE("in the plane points between two cracks move across their row, and follow the plate when tied") {
  auto m = in_plane({{{{2, 4}, {10, 4}}, End::tip, End::tip}, {{{2, 5}, {10, 5}}, End::tip, End::tip}});
  Forces along = Forces::Zero(3, m.points()), across = along;
  along(2, 4 * 12 + 6) = 1, across(1, 4 * 12 + 6) = 1;
  const auto found = mechanisms_in_plane(m, along);
  REQUIRE(found.twisting > 0);
  CHECK(Eigen::Index(found.twisting) == zero_modes(m));
  CHECK_FALSE(found.twisted);
  CHECK(mechanisms_in_plane(m, across).twisted);
  tie_twists(m.boundary, m.plate.families());
  CHECK(zero_modes(m) == 0);
}

TEST_CASE("in the plane supports hold what they hold of u and v") {
  const Support both{SupportKind::clamped, {"left"}, {}}, normal{SupportKind::symmetry, {"left"}, {}},
      tangential{SupportKind::simply_supported_hard, {"left"}, {}};
  for (const auto& [support, free] : std::vector<std::pair<Support, int>>{{both, 0}, {normal, 1}, {tangential, 2}}) {
    const auto m = in_plane({}, support);
    CHECK(pieces(m.boundary, m.plate.families(), PlateLaw::membrane).front().free_modes == free);
    CHECK(zero_modes(m) == free);
  }
}
