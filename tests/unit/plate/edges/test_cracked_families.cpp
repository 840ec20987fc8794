#include "plate/edges/lattice_bonds.hpp"

#include "plate/edges/surface_plate.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;
using geometry::Point;

namespace {

const Section cracked_section{200, 0.25, 0.3};

/// 12 x 10 points with a crack between the fifth and the sixth row.
SurfacePlate cracked(SurfaceCorrection correction, const geometry::Polyline& crack = {{4, 5}, {8, 5}}) {
  Discretization d;
  d.spacing = 0.5, d.surface_correction = correction;
  auto p = surface_plate(cracked_section, d, {0, 0}, {6, 5});
  p.cuts = CrackedFamilies(p.body, p.bonds, FamilyRule(cracked_section, d),
                           {{crack, geometry::End::tip, geometry::End::tip}});
  return p;
}

int node(const SurfacePlate& p, int x, int y) {
  return p.body.node({x, y, 0});
}

}  // namespace

TEST_CASE("cut families: those with a bond through the crack, by both ends, all others are full") {
  const auto p = cracked(SurfaceCorrection::position_aware);
  for (int k = 0; k < p.body.count(); ++k) {
    bool cut = false;
    for (std::size_t i = 0; i < p.bonds.bonds.size(); ++i) {
      const auto away = p.bonds.bonds[i].away;
      const int j = p.body.node(p.body.nodes[std::size_t(k)] + away);
      if (j < 0) continue;
      // by hand: from one side of y = 5 to the other at 4 < x < 8, but for bonds that only touch a tip
      const Point a = p.body.position(k).head<2>() + Eigen::Vector2d(0.5, 0.5);
      const double t = away[1] == 0 ? -1 : (5 - a.y()) / away[1], x = a.x() + t * away[0];
      const bool through = t > 0 && t < 1 && x > 4 + 1e-9 && x < 8 - 1e-9;
      cut = cut || through;
      CHECK(p.cuts.broken(k, i) == through);
      CHECK(p.cuts.broken(k, i) == p.cuts.broken(j, p.bonds.opposite(i)));
    }
    CHECK((p.cuts.of(k) != nullptr) == cut);
  }
  CHECK(CrackedFamilies().of(3) == nullptr);
  CHECK(!CrackedFamilies().broken(3, 0));
}

TEST_CASE("cut families: position-aware weights store the energy of constant curvature and shear") {
  const auto p = cracked(SurfaceCorrection::position_aware);
  const int k = node(p, 6, 3);
  REQUIRE(p.cuts.of(k));
  double bending = 0, shear = 0, dilatation = 0, couple = 0;
  for (std::size_t i = 0; i < p.bonds.bonds.size(); ++i) {
    const auto& bond = p.bonds.bonds[i];
    const auto& half = (*p.cuts.of(k))[i];
    const double s = bond.length * bond.my * bond.my, gamma = bond.length * bond.my;  // of psi = (x, 0), w = x
    bending += half.curvature * s * s, shear += half.shear * gamma * gamma;
    dilatation += half.D * s, couple += half.dilatation_couple * s;
  }
  const double area = p.bonds.spacing * p.bonds.spacing;
  CHECK((bending + couple * dilatation) / area == Approx(cracked_section.bending_stiffness()).epsilon(1e-12));
  CHECK(shear / area == Approx(cracked_section.shear_stiffness()).epsilon(1e-12));
}

TEST_CASE("cut families: a bond is the same from both ends, and that of full families is the lattice's") {
  const auto p = cracked(SurfaceCorrection::arbitrary_horizon);
  const int cut = node(p, 6, 3);
  REQUIRE(p.cuts.of(cut));
  for (std::size_t i = 0; i < p.bonds.bonds.size(); ++i) {
    const int j = node(p, 6 + p.bonds.bonds[i].away[0], 3 + p.bonds.bonds[i].away[1]);
    if (p.cuts.broken(cut, i)) continue;
    const auto there = acting(p.bonds, p.cuts, cut, j, i), back = acting(p.bonds, p.cuts, j, cut, p.bonds.opposite(i));
    CHECK(there.curvature == Approx(back.curvature).epsilon(1e-14));
    CHECK(there.shear == Approx(back.shear).epsilon(1e-14));
    CHECK(there.own_couple == back.other_couple);
    const auto full = acting(p.bonds, {}, cut, j, i);
    CHECK(full.shear == Approx(p.bonds.bonds[i].shear).epsilon(1e-14));
    CHECK(there.shear > full.shear);  // fewer bonds carry the same
  }
}

TEST_CASE("cut families: rigid motions cause no force in a plate with a crack") {
  for (const auto correction : {SurfaceCorrection::arbitrary_horizon, SurfaceCorrection::position_aware}) {
    const auto p = cracked(correction, {{4, 4.2}, {7.3, 5.9}});
    Eigen::VectorXd u(p.unknowns());
    for (int i = 0; i < p.unknowns() / 3; ++i) {
      const Point x = i < p.body.real ? p.at(i) : p.at_surface(i - p.body.real);
      u.segment<3>(3 * i) << 1 + 2 * x.x() - x.y(), -1, -2;
    }
    CHECK((stiffness(p) * u).cwiseAbs().maxCoeff() < 1e-12 * cracked_section.young);  // measured: 1.4e-15
  }
}
