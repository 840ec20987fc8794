#include "fracture/growth/quasi_static_bonds.hpp"

#include <sstream>

#include "plate/bonds/rows/lattice_operator.hpp"
#include "plate/solve/archive.hpp"
#include "tests/catch.hpp"
#include "tests/unit/fracture/distributed_run.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace fracture;
namespace vp = verified_plate;

namespace {

/// A square of 20 x 20 points, clamped all round, with a crack in its middle.
struct ClampedSquare {
  cases::Case c;
  std::unique_ptr<plate::Formulation> start;

  ClampedSquare() {
    c = vp::square(0.1);
    c.cracks = {{{-0.3, 0}, {0.3, 0}}};
    c.supports = {vp::held_all_round(plate::SupportKind::clamped)};
    auto& growth = c.growth.emplace();
    growth.criterion = Growth::Criterion::bond_energy;
    growth.fracture_energy = 1, growth.apparent_toughness = 1;
    growth.control = Growth::Control::equilibrium;
    start = vp::assembled(c);
  }
  QuasiStaticBonds bonds() const { return {*c.growth, *start, {}, {1e-9, 10000, {}}}; }
  plate::Forces load() const { return start->total_load(); }
};

Equilibrium at(std::size_t advance, double factor, double critical) {
  return {advance, factor, 0, critical, true, false, {}};
}

/// Strain energy by the forces.
double energy(const plate::Operator& plate, const plate::State& u) {
  plate::Forces force;
  plate.internal_force(u, force);
  return -force.cwiseProduct(u).sum() / 2;
}

}  // namespace

TEST_CASE(
    "quasi-static bonds: at the critical load the bonds that are chosen are at their limit, and mirror images too") {
  const ClampedSquare s;
  auto bonds = s.bonds();
  const auto loaded = bonds.solve();
  CHECK(loaded.split.empty());
  CHECK(loaded.displacement == Approx(2 * energy(*s.start, bonds.state())));  // work of the whole load
  DamagedPlate damaged(*s.start->breaking(), s.start->boundary(), {s.c.section, s.c.discretization});
  const BondLimits limits(*s.c.growth, s.c.section, s.c.discretization);
  BondCheck check(*s.c.growth, limits, damaged, s.start->boundary());
  CHECK(check.largest(loaded.critical * bonds.state()) == Approx(1));
  bonds.choose(at(0, loaded.critical, loaded.critical));
  bonds.advance(loaded.critical);
  CHECK(*bonds.broken_bonds() % 2 == 0);
  CHECK(*bonds.broken_bonds() >= 2);
}

TEST_CASE("quasi-static bonds: what bonds take is what the plate loses under the load that is there") {
  const ClampedSquare s;
  auto bonds = s.bonds();
  double spent = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto loaded = bonds.solve();
    bonds.choose(at(i, loaded.critical, loaded.critical));
    const plate::State u = loaded.critical * bonds.state();
    const double before = energy(bonds.forces(), u);
    bonds.advance(loaded.critical);
    spent += before - energy(bonds.forces(), u);
    CHECK(bonds.fracture_energy() == Approx(spent));
    CHECK(bonds.advances() == i + 1);
  }
  const auto found = bonds.solve();  // equilibrium of what is left, though by the factor of the plate at the start
  plate::Forces rest;
  bonds.forces().internal_force(bonds.state(), rest);
  rest += s.load();
  s.start->constraints().fold(rest);
  CHECK(rest.norm() < 1e-6 * s.load().norm());
  CHECK(found.displacement > 0);
}

TEST_CASE("quasi-static bonds: one that recalls goes on to the same numbers") {
  const ClampedSquare s;
  auto first = s.bonds(), second = s.bonds();
  const auto step = [](QuasiStaticBonds& bonds, std::size_t i) {
    const auto loaded = bonds.solve();
    bonds.choose(at(i, loaded.critical, loaded.critical));
    return loaded.critical;
  };
  first.advance(step(first, 0));
  const double factor = step(first, 1);
  std::stringstream stream;
  plate::OutArchive out(stream);
  first.save(out);
  plate::InArchive in(stream);
  second.restore(in);
  *second.of_points() = *first.of_points();
  second.restored_points();
  first.advance(factor), second.advance(factor);
  CHECK(step(first, 2) == step(second, 2));
  CHECK(first.fracture_energy() == second.fracture_energy());
  CHECK(*first.broken_bonds() == *second.broken_bonds());
  CHECK(first.record().growth.rows == second.record().growth.rows);
}

TEST_CASE("a plate in parts: bonds that break at rest, across a border") {
  auto file = shared_run::tall_plate();
  auto& c = file.content;
  c.outline = geometry::rectangle(0, 0, 1, 1.2);
  c.cracks = {{{0.47, 0.3}, {0.5, 0.62}}};
  c.analysis.tolerance = 1e-10;
  c.growth->criterion = Growth::Criterion::bond_energy;
  c.growth->control = Growth::Control::equilibrium;
  c.growth->max_advances = 8;
  const auto whole = shared_run::whole(file);
  for (const int processes : {1, 3}) {
    const auto shared = shared_run::texts(file, processes);
    for (const auto& [name, table] : whole) {
      CAPTURE(processes, name);
      CHECK(shared_run::apart(table, shared.at(name)) < 1e-6);
    }
  }
}
