// What processes make of a window of a plate on a lattice against what they cut from all of it, bit by bit.
#include "plate/galerkin/part_of_cells.hpp"

#include <mutex>

#include "plate/formulation/foundations.hpp"
#include "plate/formulation/springs_and_stiffeners.hpp"
#include "plate/galerkin/discretised_cells.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/galerkin/supports.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/geometry/random_plates.hpp"
#include "tests/unit/plate/bonds/parts.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace plate;

namespace {

using geometry::Point;

double number(const Dof& dof) {
  return double(index_by_points(std::int64_t(dof.point), dof.component));
}

/// Numbers, and what they are of, that two ways to a part must agree on.
struct Told {
  std::vector<std::pair<std::string, std::vector<double>>> all;

  template <typename Values>
  void add(const std::string& what, const Values& values) {
    auto& own = all.emplace_back(what, std::vector<double>()).second;
    for (const auto& value : values)
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Dof>)
        own.push_back(number(value));
      else
        own.push_back(double(value));
  }
  void add_points(const std::string& what, const std::vector<Point>& values) {
    auto& own = all.emplace_back(what, std::vector<double>()).second;
    for (const auto& x : values) own.push_back(x.x()), own.push_back(x.y());
  }
  void add_matrix(const std::string& what, const Eigen::MatrixXd& values) {
    add(what, std::vector<double>(values.data(), values.data() + values.size()));
  }
};

void add_cells(const PartOfCells& part, Told& told) {
  const auto& cells = part.part.cells;
  told.add_points("positions", cells.positions), told.add_points("local", cells.local);
  for (const auto& square : cells.squares) told.add("square", square);
  for (const auto& triangle : cells.triangles) told.add("triangle", triangle);
  for (const auto& [from, to, edge] : cells.borders)
    told.add("border", std::array{double(from), double(to), double(edge)});
  told.add("number", part.number), told.add("own", part.own), told.add("stretch", part.column_block);
  for (const auto& copy : part.copies)
    told.add("copy", std::array{double(copy.point), double(copy.owner), double(copy.of_owner)});
  told.add("about", std::array{part.about.low[0], part.about.low[1], part.about.high[0], part.about.high[1]});
}

void add_boundary(const Boundary& boundary, std::size_t motions, Told& told) {
  told.add_points("cloud", boundary.cloud.positions), told.add_points("lattice", boundary.lattice);
  told.add("areas", boundary.cloud.areas), told.add("active", boundary.active);
  for (const auto& [point, holder, rotations] : boundary.holds)
    told.add("hold", std::array{point, holder, std::uint32_t(rotations)});
  told.add("fixed", boundary.constraints.fixed());
  for (const auto& [follower, leader, factor] : boundary.constraints.ties())
    told.add("tie", std::array{number(follower), number(leader), factor});
  for (std::size_t motion = 0; motion < motions; ++motion) {
    const auto lift = boundary.constraints.lift(motion, boundary.cloud.size());
    told.add_matrix("lift", lift.cols() > 0 ? lift : State::Zero(3, Eigen::Index(boundary.cloud.size())));
  }
  for (const auto& part : boundary.elastic_supports.parts()) {
    told.add(part->name + " rows", part->row), told.add("first", part->first);
    told.add("columns", part->column), told.add("values", part->value);
    if (!part->contact) continue;
    for (std::size_t p = 0; p < part->contact->places(); ++p) {
      const auto place = part->contact->place(p);
      told.add("stiffness", std::array{place.stiffness});
      for (const auto& [dof, factor] : place.form) told.add("form", std::array{double(dof), factor});
    }
  }
}

Told told_of(const Communicator& all, const Problem& problem, const std::vector<geometry::CrackPath>& paths,
             bool global_number) {
  const auto tips = geometry::tips(paths);
  auto whole = global_number ? GlobalCells(cells_of(problem, paths, 1)) : global_cells_of(problem, paths, 1, true);
  const auto seen = cells_with_overlap(all, problem, whole, tips);
  const auto& cells = seen.cells;
  const auto areas = areas_of(cells);
  auto boundary = galerkin_boundary(cells, areas, geometry::to_lattice(problem.outline, cells.units), problem.supports,
                                    support_motions(problem), {&all});
  boundary.elastic_supports = elastic_supports_of(problem, cells);
  const auto part = part_of_cells(all, problem, seen, boundary.elastic_supports, tips);
  Told told;
  add_cells(part, told);
  add_boundary(restricted(boundary, part, problem.loads.size()), problem.loads.size(), told);
  told.add("cut", restricted(cut_share(cells, areas), part.part));
  told.add("masses", restricted(stiffener_masses(problem, cells), part.part));
  PointMap map{&all};
  for (const int owner : seen.owners) map.owned.push_back(owner == all.rank());
  for (const auto& load : problem.loads) {
    told.add_matrix("forces", restricted(nodal_forces(load, cells, areas, map), part.part));
    if (!load.moves()) continue;
    for (const auto& [time, forces] : restricted(moving_forces(load, cells, areas.size(), map), part).stations)
      for (const auto& [dof, force] : forces) told.add("station", std::array{time, number(dof), force});
  }
  return told;
}

/// What any process has otherwise from a window than from all; how many points windows leave out.
std::pair<std::string, std::size_t> difference(int processes, const Problem& problem) {
  const auto paths = crack_paths(problem);
  std::mutex one_by_one;
  std::string found;
  std::size_t left_out = 0;
  thread_ranks::run(processes, [&](const Communicator& all) {
    const auto mine = parts::own(problem);
    const auto one = told_of(all, mine, paths, true), other = told_of(all, mine, paths, false);
    auto lattice = global_cells_of(mine, paths, 1, true);
    const auto window = cells_with_overlap(all, mine, lattice, geometry::tips(paths));
    const std::lock_guard guard(one_by_one);
    left_out += points_of(lattice) - window.cells.positions.size();
    if (one.all.size() != other.all.size()) found += " sizes";
    for (std::size_t i = 0; i < std::min(one.all.size(), other.all.size()); ++i)
      if (one.all[i] != other.all[i]) {
        found += " " + one.all[i].first + " of process " + std::to_string(all.rank());
        break;
      }
  });
  return {found, left_out};
}

Problem overlapped_problem(geometry::Outline outline, double spacing) {
  auto problem = parts::problem_of(std::move(outline), {}, {parts::pressure(2)});
  problem.discretization.spacing = spacing, problem.discretization.formulation = &galerkin;
  return problem;
}

/// A line within the plate, somewhere.
geometry::Polyline line_in(const geometry::Outline& outline, random_plates::Maker& maker) {
  for (;;) {
    const auto place = [&] { return Point(maker.uniform(-0.8, 0.8), maker.uniform(-0.8, 0.8)); };
    const Point a = place(), b = place();
    if (geometry::contains(outline, a) && geometry::contains(outline, b) && !geometry::leaves(outline, a, b) &&
        geometry::distance_to_boundary(outline, a) > 0.05)
      return {a, b};
  }
}

/// Everything that can be asked of a plate, somewhere on it.
Problem loaded(const random_plates::Plate& plate, random_plates::Maker& maker, double spacing) {
  auto problem = overlapped_problem(plate.outline, spacing);
  problem.cracks = plate.cracks;
  const auto line = [&] { return line_in(plate.outline, maker); };
  const auto edge = [&](std::size_t i) { return plate.outline.outer.edge_names[i]; };
  Support along, part, pins, held;
  along.kind = SupportKind::pinned, along.along = line();
  part.kind = SupportKind::clamped, part.patch = geometry::Circle{line().front(), 0.1, ""};
  pins.kind = SupportKind::pinned, pins.points = line();
  held.kind = SupportKind::simply_supported_hard, held.edges = {edge(0), edge(2)};
  problem.supports = {along, part, pins, held};
  const Load force{PointForce{.position = line().front(), .value = 0.3}},
      along_line{LineLoad{.along = line(), .value = 2}};
  const Load moment{EdgeMoment{.edges = {edge(1)}, .value = 0.2}}, shear{EdgeShear{.edges = {edge(1)}, .value = 0.1}};
  const Load has_prescribed_displacements{Settlement{.support = 3, .value = 0.01, .slope = {0.02, 0.01}}};
  const Load runs{PointForce{.value = 3, .path = line(), .speed = 2}};
  const Load patch{Pressure{.value = 1, .gradient = {3, 2}, .patch = geometry::Circle{line().front(), 0.3, ""}}};
  const auto path = line();
  const Load rolls{Pressure{.value = 2, .patch = geometry::Circle{path.front(), 0.15, ""}, .path = path, .speed = 3}};
  // cells along the jump are parted
  const Load formula{Pressure{.formula = Formula("sin(9 * x) + (x > 0.1 ? 3 : 1) * y^2")}};
  problem.loads.insert(problem.loads.end(),
                       {force, along_line, moment, shear, has_prescribed_displacements, runs, patch, rolls, formula});
  problem.foundations = {{2000, 3, geometry::Hole(geometry::Circle{line().front(), 0.5, ""})},
                         {500, 0, geometry::Hole(geometry::Circle{line().front(), 0.4, ""}), true}};
  Spring of_edge, of_line, of_point;
  of_edge.edges = {edge(1)}, of_edge.deflection = 40, of_edge.rotation_normal = 3;
  of_line.along = line(), of_line.deflection = 70, of_line.rotation_tangential = 2;
  of_point.position = line().front(), of_point.deflection = 20, of_point.rotation = 5;
  problem.springs = {of_edge, of_line, of_point};
  Stiffener beam, rim;
  beam.bending = 0.3, beam.torsion = 0.1, beam.mass = 2, beam.along = line();
  rim.bending = 0.2, rim.mass = 1, rim.edges = {edge(0)};
  problem.stiffeners = {beam, rim};
  return problem;
}

}  // namespace

TEST_CASE(
    "windows of a lattice: supports, loads, soil, springs and beams of random plates as of the whole, bit by bit") {
  std::size_t tried = 0, left_out = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    random_plates::Maker maker(seed);
    const auto plate = maker.plate();
    const auto problem = loaded(plate, maker, 0.05 - 0.002 * seed);
    const int processes = std::array{2, 3, 4, 7}[seed % 4];
    CAPTURE(seed, processes);
    try {
      const auto [found, points] = difference(processes, problem);
      CHECK(found == "");
      ++tried, left_out += points;
    } catch (const Refused& refused) {
      WARN(refused.what());
    }
  }
  CHECK(tried > 5);
  CHECK(left_out > 0);
}

TEST_CASE(
    "windows of a lattice: rectangles, holes, an L, cracks across the borders of processes, along them and oblique") {
  const geometry::Outline l_shape{
      {{{0, 0}, {2, 0}, {2, 1.1}, {1.1, 1.1}, {1.1, 2}, {0, 2}}, {"a", "b", "c", "d", "e", "f"}}, {}};
  auto holes = geometry::rectangle(0, 0, 3, 2.01);
  holes.holes = {geometry::Circle{{1.03, 1.21}, 0.3, "hole0"},
                 geometry::Polygon{{{2, 0.4}, {2.4, 0.6}, {2.1, 0.9}}, {"hole1", "hole1", "hole1"}}};
  for (const auto& outline : {l_shape, holes, geometry::rectangle(0, 0, 9, 1)})
    for (const int processes : {1, 3, 7}) {
      auto problem = overlapped_problem(outline, 0.02);
      problem.supports = {{SupportKind::clamped, {outline.outer.edge_names[0]}, {}}};
      problem.cracks = {{{0.3, 0.5}, {0.7, 0.5}}, {{0.1, 0.13}, {0.97, 0.83}}, {{1.5, 0}, {1.5, 0.6}}};
      problem.foundations = {{20, 3, std::nullopt}};
      CAPTURE(processes);
      const auto [found, points] = difference(processes, problem);
      CHECK(found == "");
      CHECK((points > 0) == (processes > 1));
    }
}

TEST_CASE(
    "windows of a lattice: a part that is held beside a process is held, one beside the plate is refused by all") {
  auto problem = overlapped_problem(geometry::rectangle(0, 0, 4, 4), 0.02);
  Support part;
  part.kind = SupportKind::clamped, part.patch = geometry::Circle{{0.2, 0.2}, 0.1, ""};
  problem.supports = {part};
  CHECK(difference(4, problem) == std::pair(std::string(), difference(4, problem).second));
  problem.supports[0].patch = geometry::Circle{{5, 5}, 0.1, ""};
  int refused = 0;
  std::mutex one_by_one;
  thread_ranks::run(4, [&](const Communicator& all) {
    try {
      told_of(all, problem, {}, false);
    } catch (const Refused&) {
      const std::lock_guard guard(one_by_one);
      ++refused;
    }
  });
  CHECK(refused == 4);
}
