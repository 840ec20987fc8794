// Bonds that break one by one, quasi-statically and in motion: toughness, books, symmetry, plates that fall to pieces.
#include <cmath>

#include "cases/driver/run.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"
#include "tests/verification/verified_plate.hpp"

using fracture::Growth;
namespace vp = verified_plate;

namespace {

/// A strip along the lattice, 32 spacings wide, clamped along both sides under pressure, with a crack along its middle:
/// the energy release rate does not depend on the length of the crack.
cases::Case strip(double thickness_in_spacings) {
  constexpr double spacing = 1.0 / 32;
  auto c = vp::free_plate(geometry::rectangle(0, -0.5, 2.4, 0.5), spacing);
  c.analysis.kind = cases::Analysis::Kind::static_;
  c.section.thickness = thickness_in_spacings * spacing;
  c.section.density = 1;
  c.cracks = {{{0, 0}, {1.2, 0}}};
  c.supports = {vp::held(plate::SupportKind::clamped, {"bottom", "top"})};
  c.loads[0].as<plate::Pressure>()->value = 1000;
  c.growth.emplace();
  c.growth->fracture_energy = 1;
  c.growth->control = Growth::Control::equilibrium;
  c.growth->max_length = 1.2 + 10 * spacing;
  c.growth->no_fail = {{0, -0.5, 2.4, -0.25}, {0, 0.25, 2.4, 0.5}};  // not beside the supports
  c.output.vtk = c.output.hdf5 = false;
  return c;
}

struct Rest {
  post::Summary summary;
  std::vector<double> load_factors, lengths;
};

Rest grown(const cases::Case& c) {
  const small_run::TemporaryFolder folder;
  Rest result{cases::run({c, {}}, {folder.path(), true}), {}, {}};
  const auto table = post::read_csv(folder / "growth.csv");
  for (const auto& row : table.rows) {
    result.load_factors.push_back(std::get<double>(row[table.column("load_factor")]));
    if (c.growth->by_bonds()) result.lengths.push_back(std::get<double>(row[table.column("crack_length")]));
  }
  return result;
}

}  // namespace

TEST_CASE("quasi-static bonds: steady growth needs the fracture energy, by the table of apparent toughness") {
  for (const double thickness : {1.5, 4.0, 8.0}) {
    auto c = strip(thickness);
    auto tip = c;
    tip.growth->direction = Growth::Direction::straight;
    tip.growth->max_advances = 2;
    const double reference = grown(tip).load_factors[1];  // where G = G_c h
    c.growth->criterion = Growth::Criterion::bond_energy;
    const auto found = grown(c);
    REQUIRE(found.summary.growth->outcome == "the largest length of cracks");
    double most = 0;
    for (std::size_t i = 0; i < found.lengths.size(); ++i)
      if (found.lengths[i] >= 1.2 + 3.0 / 32) most = std::max(most, found.load_factors[i]);
    CAPTURE(thickness, std::pow(most / reference, 2));
    CHECK(std::pow(most / reference, 2) == Approx(1).margin(0.1));
  }
}

TEST_CASE("quasi-static bonds: outcomes under given loads and given displacements") {
  auto c = strip(4);
  c.growth->criterion = Growth::Criterion::bond_energy;
  c.growth->control = Growth::Control::load;
  c.loads[0].as<plate::Pressure>()->value = 1;
  CHECK(grown(c).summary.growth->outcome == "no bond breaks under the whole load");
  c.loads[0].as<plate::Pressure>()->value = 4.4;  // the first bonds of the cut tip break, steady growth needs more
  auto found = grown(c);
  CHECK(found.summary.growth->outcome == "arrested under the whole load");
  CHECK(*found.summary.growth->broken_bonds > 4);
  c.loads[0].as<plate::Pressure>()->value = 1000;
  c.growth->unstable = Growth::Unstable::stop;
  CHECK(grown(c).summary.growth->outcome == "the next bond breaks unstably");
  c.growth->criterion = Growth::Criterion::curvature_shear;
  c.growth->unstable = Growth::Unstable::jump;
  c.growth->control = Growth::Control::displacement;
  c.growth->max_length = 1.2 + 3.0 / 32;
  CHECK(grown(c).summary.growth->outcome == "the largest length of cracks");
}

TEST_CASE("quasi-static bonds: a symmetric plate stays symmetric") {
  auto c = vp::square(0.1);
  c.analysis.kind = cases::Analysis::Kind::static_;
  c.analysis.tolerance = 1e-8;
  c.cracks = {{{-0.3, 0}, {0.3, 0}}};
  c.supports = {vp::held_all_round(plate::SupportKind::simply_supported)};
  c.loads[0].as<plate::Pressure>()->value = 1000;
  c.growth.emplace();
  c.growth->criterion = Growth::Criterion::bond_energy;
  c.growth->fracture_energy = 1;
  c.growth->control = Growth::Control::equilibrium;
  c.growth->max_advances = 12;
  c.output.hdf5 = c.output.vtk = false;
  const small_run::TemporaryFolder folder;
  const auto summary = cases::run({c, {}}, {folder.path(), true});
  CHECK(summary.growth->advances == 12);
  const auto table = post::read_csv(folder / "growth.csv");
  double before = 0;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const double now = std::get<double>(table.rows[i][table.column("broken_bonds")]);
    CHECK((now - before == 2 || now - before == 4));  // with their mirror images
    before = now;
  }
}

namespace {

struct Motion {
  post::Summary summary;
  double residual;  // largest of the books, over the largest work
  post::Table history;
};

Motion moved(const cases::Case& c) {
  const small_run::TemporaryFolder folder;
  Motion result{cases::run({c, {}}, {folder.path(), true}), 0, post::read_csv(folder / "history.csv")};
  double work = 0;
  for (const auto& row : result.history.rows) {
    work = std::max(work, std::get<double>(row.at(result.history.column("external_work"))));
    result.residual =
        std::max(result.residual, std::abs(std::get<double>(row.at(result.history.column("energy_residual")))));
  }
  result.residual /= work;
  return result;
}

/// A clamped square with a crack in its middle, under a pressure that rises fast.
cases::Case struck(double pressure) {
  auto c = vp::square(0.04);
  c.section.density = 1;
  c.cracks = {{{-0.2, 0}, {0.2, 0}}};
  c.supports = {vp::held_all_round(plate::SupportKind::clamped)};
  c.loads[0].as<plate::Pressure>()->value = pressure;
  c.loads[0].history.kind = plate::History::Kind::ramp, c.loads[0].history.rise_time = 0.05;
  c.analysis.duration = 0.4;
  c.growth.emplace();
  c.growth->criterion = Growth::Criterion::bond_energy;
  c.growth->fracture_energy = 1;
  c.output.vtk = c.output.hdf5 = false;
  return c;
}

}  // namespace

namespace {

/// The strip under 1.1 times the pressure that steady growth needs at rest.
cases::Case slow() {
  auto c = strip(4);
  c.analysis.kind = cases::Analysis::Kind::dynamic;
  c.analysis.duration = 1.5;
  c.loads[0].history.kind = plate::History::Kind::ramp, c.loads[0].history.rise_time = 0.6;
  c.loads[0].as<plate::Pressure>()->value = 4.9;
  c.growth->control = Growth::Control::load;
  c.growth->max_length.reset();
  c.growth->criterion = Growth::Criterion::bond_energy;
  c.growth->no_fail.push_back({2.1, -0.5, 2.4, 0.5});
  return c;
}

}  // namespace

TEST_CASE("bonds in motion: a slow crack takes the fracture energy within a tenth, and the books close") {
  const auto c = slow();
  const auto found = moved(c);
  REQUIRE(found.summary.growth->lengths.size() == 1);
  CAPTURE(*found.summary.growth->spent, found.residual, found.summary.growth->lengths[0]);
  CHECK(found.summary.growth->lengths[0] > 1.5);
  CHECK(*found.summary.growth->spent == Approx(1).margin(0.1));
  CHECK(found.residual < 0.01);
  CHECK(*found.summary.growth->largest_speed < 0.93 * c.section.shear_wave_speed());
}

TEST_CASE("bonds in motion: a plate that falls to pieces keeps its books, and pieces may be frozen") {
  for (const auto detached : {Growth::Detached::move, Growth::Detached::freeze}) {
    auto c = struck(8);
    c.growth->detached = detached;
    const auto found = moved(c);
    CAPTURE(found.summary.growth->outcome, found.residual);
    CHECK(*found.summary.growth->broken_bonds > 1000);
    CHECK(found.summary.growth->outcome.find("the plate split in") != std::string::npos);
    CHECK(found.residual < 0.01);
    const auto energy = [&](const char* name) {
      for (const auto& [of, value] : found.summary.energy)
        if (of == name) return value;
      return 0.0;
    };
    const bool frozen = detached == Growth::Detached::freeze;
    CHECK((energy("frozen") > 0.1 * energy("external_work")) == frozen);
    CHECK((energy("kinetic") > 0.5 * energy("external_work")) == !frozen);
  }
}

TEST_CASE("quasi-static bonds: a plate that is cut through has split, which is an outcome") {
  auto c = vp::free_plate(geometry::rectangle(0, -0.5, 2, 0.5), 0.05);
  c.analysis.kind = cases::Analysis::Kind::static_;
  c.cracks = {{{1, -0.5}, {1, 0.1}}};
  c.supports = {vp::held(plate::SupportKind::clamped, {"left"})};
  c.loads = {plate::Load{plate::EdgeMoment{.edges = {"right"}, .value = 1}}};
  c.growth.emplace();
  c.growth->criterion = Growth::Criterion::bond_energy;
  c.growth->fracture_energy = 1;
  c.output.vtk = c.output.hdf5 = false;
  for (const auto control : {Growth::Control::load, Growth::Control::equilibrium}) {
    c.growth->control = control;
    const auto found = grown(c);
    CHECK(found.summary.growth->outcome.starts_with("the plate split: "));
    CHECK(found.summary.growth->advances > 50);
    CHECK(*found.summary.growth->spent > 0);
    CHECK(found.summary.growth->lengths.size() == 1);
    CHECK(found.summary.growth->lengths[0] == Approx(1).margin(0.11));
  }
}

TEST_CASE("bonds under tension only break where tips of the same sign grow") {
  auto c = strip(4);
  c.growth->tension_only = true;
  c.growth->direction = Growth::Direction::straight;
  for (const double pressure : {1000.0, -1000.0}) {
    c.loads[0].as<plate::Pressure>()->value = pressure;
    c.growth->criterion = Growth::Criterion::energy_release;
    c.growth->max_advances = 2;
    const bool tips = grown(c).summary.growth->advances > 0;
    c.growth->criterion = Growth::Criterion::bond_energy;
    c.growth->max_advances = 60;
    const auto bonds = grown(c);
    CHECK((bonds.summary.growth->lengths[0] > 1.25) == tips);
  }
}

TEST_CASE("bonds in motion end at the largest length of cracks and after so many advances") {
  auto c = struck(8);
  c.growth->max_advances = 10;
  CHECK(moved(c).summary.growth->advances == 10);
  c = slow();
  c.growth->max_length = 1.4;
  const auto found = moved(c);
  double all = 0;
  for (const double length : found.summary.growth->lengths) all += length;
  CHECK(all >= 1.4);
  CHECK(all <= 1.4 + 2.0 / 32);
}

TEST_CASE("bonds in motion: cracks begin where there is none, and branch under a higher load") {
  auto c = struck(3.5);
  c.cracks.clear();
  CHECK(*moved(c).summary.growth->broken_bonds > 100);
  auto branched = struck(4.5);
  branched.growth->no_fail = {{-1, -1, 1, -0.7}, {-1, 0.7, 1, 1}, {-1, -1, -0.7, 1}, {0.7, -1, 1, 1}};
  branched.analysis.duration = 0.25;
  CHECK(moved(branched).summary.growth->lengths.size() >= 5);
}
