#include "plate/edges/surface_formulation.hpp"

#include "geometry/lattice/cloud.hpp"
#include "plate/edges/multiplied_plate.hpp"
#include "plate/edges/surface_plate.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;
using geometry::Point;

namespace {

Problem square(std::vector<Support> supports, std::vector<Load> loads, double spacing = 0.25) {
  Problem p;
  p.section = {1000, 0.3, 0.4};
  p.outline = geometry::rectangle(-1, -1, 1, 1);
  p.discretization.spacing = spacing, p.discretization.volume_correction = VolumeCorrection::lattice_fitted;
  p.discretization.formulation = &bonds_with_surface_nodes;
  p.supports = std::move(supports), p.loads = std::move(loads);
  return p;
}

const std::vector<std::string> all{"left", "right", "bottom", "top"};

Load unit_pressure() {
  return {Pressure{.value = 1}};
}

Load moment(std::vector<std::string> edges, double value) {
  return {EdgeMoment{.edges = std::move(edges), .value = value}};
}

State solved(const Formulation& plate) {
  const auto result = solve_static(plate, plate.total_load(), StaticMethod::direct, {}, {1e-9, 10, {}});
  CHECK(result.solution.converged);
  CHECK(result.solution.iterations <= 2);
  return result.solution.state;
}

/// What it is refused for.
Subject refused(const Problem& problem, const FormulationKind& kind = bonds_with_surface_nodes) {
  try {
    kind.discretise(problem, single_process());
  } catch (const Refused& why) {
    return why.reasons().front().subject;
  }
  FAIL("not refused");
  return {};
}

}  // namespace

TEST_CASE("surface nodes: a problem has the solution of the plate that it is made of") {
  const auto problem = square({{SupportKind::clamped, all, {}}}, {unit_pressure()});
  const auto made = bonds_with_surface_nodes.discretise(problem, single_process());
  const State state = solved(*made.plate);
  const auto plate = surface_plate(problem.section, problem.discretization, {-1, -1}, {1, 1});
  const auto expected = solution(
      plate, [](const Point&, const Point&) { return edge_condition(SupportKind::clamped); },
      [](const Point&) { return Eigen::Vector3d(1, 0, 0); });
  for (int k = 0; k < plate.body.real; ++k)
    CHECK((state.col(k) - expected.values.segment<3>(3 * k)).norm() < 1e-10 * state.cwiseAbs().maxCoeff());
  CHECK(made.plate->points() == std::size_t(plate.unknowns() / 3));
  CHECK(made.plate->fictitious_points() == plate.body.surface.size());
}

TEST_CASE("surface nodes: reactions of held edges are the load") {
  const auto made = bonds_with_surface_nodes.discretise(square({{SupportKind::clamped, all, {}}}, {unit_pressure()}),
                                                        single_process());
  Forces force;
  made.plate->internal_force(solved(*made.plate), force);
  const Eigen::VectorXd held = made.plate->constraints().on_held(force);
  double sum = 0;
  for (std::size_t i = 0; i < made.plate->constraints().held().size(); ++i)
    if (is_deflection(made.plate->constraints().held()[i])) sum += held[Eigen::Index(i)];
  CHECK(sum == Approx(4).epsilon(1e-9));  // internal forces: opposite to reactions
}

TEST_CASE("surface nodes: moments on opposite edges bend the plate alike everywhere") {
  const auto made = bonds_with_surface_nodes.discretise(
      square({{SupportKind::pinned, {}, {{-0.9, -0.9}, {0.9, -0.9}, {0.1, 0.9}}}}, {moment({"left", "right"}, 2)}),
      single_process());
  const State state = solved(*made.plate);
  const auto M = made.plate->resultants(state);
  const auto points = Eigen::Index(made.plate->cloud().plate_points);
  for (Eigen::Index k = 0; k < points; ++k) {
    CHECK(M.moments(0, k) == Approx(2).epsilon(1e-8));
    CHECK(M.moments(1, k) == Approx(0).margin(1e-8));
    CHECK(M.shear(0, k) == Approx(0).margin(1e-8));
  }
  // the energy of a plate in pure bending: M^2 / (2 D (1 - nu^2)) on 2 x 2
  const Section section{1000, 0.3, 0.4};
  const double density = 4 / (2 * section.bending_stiffness() * (1 - 0.3 * 0.3));
  CHECK(made.plate->strain_energy(state) == Approx(4 * density).epsilon(1e-8));
}

TEST_CASE("surface nodes: values beside a crack are read off its own side, and a piece that cracks cut out is loose") {
  auto problem = square({{SupportKind::clamped, all, {}}}, {unit_pressure()}, 0.125);
  problem.cracks = {{{-0.5, 0}, {0.5, 0}}};
  const auto made = bonds_with_surface_nodes.discretise(problem, single_process());
  const auto& at = made.plate->cloud().positions;
  for (const double y : {-0.01, 0.01})
    for (const auto& share : made.plate->interpolation({0.02, y})) CHECK(at[share.point].y() * y > 0);
  CHECK(made.plate->cut()[8 * 16 + 8] > 0.1);
  CHECK(made.plate->cut()[0] == 0);
  CHECK(made.plate->held());
  problem.cracks = {
      {{-0.5, -0.5}, {0.5, -0.5}}, {{0.5, -0.5}, {0.5, 0.5}}, {{0.5, 0.5}, {-0.5, 0.5}}, {{-0.5, 0.5}, {-0.5, -0.5}}};
  CHECK(!bonds_with_surface_nodes.discretise(problem, single_process()).plate->held());
}

TEST_CASE("surface nodes: a load on a part of a side that is not whole cells is warned of") {
  auto problem = square({{SupportKind::clamped, {"right"}, {}}}, {moment({"low"}, 1)});
  problem.outline.outer = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, 0.1}}, {"bottom", "right", "top", "high", "low"}};
  const auto made = bonds_with_surface_nodes.discretise(problem, single_process());
  REQUIRE(made.warnings.size() == 1);  // 4 cells of 0.25 for 1.1
  CHECK(made.warnings[0].find("low acts on 4 cells of the lattice, 9.1 % less") != std::string::npos);
  problem.outline.outer.vertices.back().y() = 0;
  CHECK(bonds_with_surface_nodes.discretise(problem, single_process()).warnings.empty());
}

TEST_CASE("surface nodes: what they cannot carry is refused with the reason") {
  const std::vector<Support> clamp{{SupportKind::clamped, all, {}}};
  auto cracked = square(clamp, {unit_pressure()});
  cracked.cracks = {{{-0.3, 0}, {0.3, 0}}};  // 0.7 from the edges, the horizon being 0.754
  CHECK(refused(cracked) == Subject::cracks);
  cracked.cracks = {{{-1, 0}, {0, 0}}};
  CHECK(refused(cracked) == Subject::cracks);
  cracked.cracks = {{{-0.2, 0}, {0.2, 0}}};
  CHECK(bonds_with_surface_nodes.discretise(cracked, single_process()).plate->tips().size() == 2);
  auto round = square(clamp, {unit_pressure()});
  round.outline.holes.push_back(geometry::Circle{{0, 0}, 0.3, "hole"});
  CHECK(refused(round) == Subject::geometry);
  auto holed = square(clamp, {unit_pressure()}, 0.125);
  const auto hole = [](double half) {
    return geometry::Polygon{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}, {"h", "h", "h", "h"}};
  };
  holed.outline.holes = {hole(0.3)};
  CHECK(refused(holed) == Subject::geometry);  // 0.6 wide, two horizons being 0.754
  holed.outline.holes = {hole(0.4)};
  CHECK(bonds_with_surface_nodes.discretise(holed, single_process()).plate->held());
  holed.outline.holes = {hole(0.7)};
  CHECK(refused(holed) == Subject::spacing);  // 0.3 of plate about it, a horizon being 0.377
  CHECK(refused(square({{SupportKind::clamped_layer, all, {}}}, {unit_pressure()})) == Subject::support);
  CHECK(refused(square(clamp, {moment({"left"}, 1)})) == Subject::load_edges);
  CHECK(refused(square(clamp, {unit_pressure()}, 2 / 8.51)) == Subject::spacing);
  CHECK(!bonds_with_surface_nodes.discretise(square({}, {unit_pressure()}), single_process()).plate->held());
  CHECK(bonds_with_surface_nodes.discretise(square(clamp, {unit_pressure()}), single_process()).plate->held());
}

TEST_CASE("surface nodes: on oblique edges and round holes reactions are the load, whatever holds them") {
  using enum SupportKind;
  auto problem = square({}, {unit_pressure()}, 0.1);
  problem.outline.outer = {{{-1, -0.8}, {0.9, -1}, {1, 0.7}, {-0.7, 1}}, all};
  problem.outline.holes.push_back(geometry::Circle{{0, 0}, 0.35, "hole"});
  for (const auto kind : {clamped, simply_supported_hard, simply_supported}) {
    problem.supports = {{kind, {"left", "top"}, {}}};
    const auto made = bonds_with_surface_nodes.discretise(problem, single_process());
    CHECK(made.plate->held());
    Forces force;
    made.plate->internal_force(solved(*made.plate), force);
    const Eigen::VectorXd held = made.plate->constraints().on_held(force);
    double sum = 0, load = made.plate->total_load().row(0).sum();
    for (std::size_t i = 0; i < made.plate->constraints().held().size(); ++i)
      if (is_deflection(made.plate->constraints().held()[i])) sum += held[Eigen::Index(i)];
    for (std::size_t i = 0; i < made.plate->constraints().held().size(); ++i)
      if (is_deflection(made.plate->constraints().held()[i]))
        load -= made.plate->total_load()(0, made.plate->constraints().held()[i].point);
    CHECK(sum == Approx(load).epsilon(1e-9));
    CHECK(made.plate->total_load().row(0).sum() == Approx(geometry::area(problem.outline)).epsilon(1e-9));
  }
}

TEST_CASE("surface nodes: a small plate tells that no motion grows with these edges, and how asymmetric they are") {
  const auto free = bonds_with_surface_nodes.discretise(
      square({{SupportKind::pinned, {}, {{-0.9, -0.9}, {0.9, -0.9}, {0.1, 0.9}}}}, {moment({"left", "right"}, 2)}),
      single_process());
  const auto clamped = bonds_with_surface_nodes.discretise(square({{SupportKind::clamped, all, {}}}, {unit_pressure()}),
                                                           single_process());
  const auto of_clamped = clamped.plate->of_edges();
  CHECK(free.plate->of_edges() != of_clamped);
  for (const auto& text : {free.plate->of_edges(), of_clamped}) {
    CHECK(text.find("motions that grow: 0") != std::string::npos);
    CHECK(text.find("asymmetry") != std::string::npos);
  }
}

TEST_CASE(
    "fictitious nodes: a problem has the solution of the plate that it is made of, and its reactions are the load") {
  auto problem = square({{SupportKind::simply_supported_hard, all, {}}}, {unit_pressure()}, 0.1);
  problem.discretization.formulation = &bonds_with_fictitious_nodes;
  const auto made = bonds_with_fictitious_nodes.discretise(problem, single_process());
  const State state = solved(*made.plate);
  const auto plate = surface_plate(problem.section, problem.discretization, {-1, -1}, {1, 1});
  const auto hard = [](const Point&, const Point&) { return edge_condition(SupportKind::simply_supported_hard); };
  const auto expected = multiplied_solution(plate, hard, [](const Point&) { return Eigen::Vector3d(1, 0, 0); });
  for (int k = 0; k < plate.body.real; ++k)
    CHECK((state.col(k) - expected.segment<3>(3 * k)).norm() < 1e-10 * state.cwiseAbs().maxCoeff());
  CHECK(made.plate->fictitious_points() == 2 * plate.body.surface.size());
  CHECK(made.plate->held());
  CHECK(made.plate->of_edges().empty());
  const double added = *made.plate->multipliers(state);
  CHECK(added == Approx(0.1064).epsilon(0.01));  // measured: 0.10636
  CHECK(*made.plate->multipliers(2 * state) == Approx(2 * added));
  Forces force;
  made.plate->internal_force(state, force);
  double sum = 0;
  const auto& constraints = made.plate->constraints();
  const Eigen::VectorXd held = constraints.on_held(force);
  for (std::size_t i = 0; i < constraints.held().size(); ++i)
    if (is_deflection(constraints.held()[i])) sum += held[Eigen::Index(i)];
  CHECK(sum == Approx(4).epsilon(1e-9));
}

TEST_CASE("fictitious nodes: the value at an edge that is free to turn is that of the points behind it") {
  auto problem = square({{SupportKind::simply_supported_hard, all, {}}}, {unit_pressure()}, 0.1);
  problem.discretization.formulation = &bonds_with_fictitious_nodes;
  const auto made = bonds_with_fictitious_nodes.discretise(problem, single_process());
  const State state = solved(*made.plate);
  const auto plate = surface_plate(problem.section, problem.discretization, {-1, -1}, {1, 1});
  const auto& face = plate.body.surface[0];  // in the corner
  const int c = normal_rotation(face.axis),
            next = plate.body.node(plate.body.nodes[std::size_t(face.inner)] +
                                   LatticeBody::Index{face.axis == 0, face.axis == 1, 0});
  CHECK(state(0, plate.body.real) == 0);
  CHECK(state(c, plate.body.real) == Approx(1.5 * state(c, face.inner) - 0.5 * state(c, next)));
}

TEST_CASE("fictitious nodes: horizons that are wide for soft and free edges, or for the plate, are refused") {
  const auto with = [](SupportKind kind, std::vector<std::string> edges, double thickness, double spacing) {
    auto problem = square({{kind, std::move(edges), {}}}, {unit_pressure()}, spacing);
    problem.section.thickness = thickness, problem.discretization.formulation = &bonds_with_fictitious_nodes;
    return problem;
  };
  using enum SupportKind;
  const auto& kind = bonds_with_fictitious_nodes;
  CHECK(refused(with(clamped, all, 1, 2.0 / 18), kind) == Subject::spacing);             // 0.167 of the side
  CHECK(refused(with(clamped, all, 0.05, 0.1), kind) == Subject::spacing);               // 6 thicknesses
  CHECK(refused(with(simply_supported, all, 0.2, 2.0 / 36), kind) == Subject::spacing);  // 0.84
  CHECK(refused(with(simply_supported, all, 1, 2.0 / 26), kind) == Subject::spacing);    // 0.116 of the side
  CHECK(refused(with(clamped, {"left", "right"}, 1, 0.05), kind) == Subject::spacing);   // 0.075
  CHECK(refused(with(clamped, {"left"}, 0.2, 2.0 / 10.51), kind) == Subject::spacing);
  CHECK(kind.discretise(with(clamped, all, 0.1, 0.1), single_process()).plate->held());
}
