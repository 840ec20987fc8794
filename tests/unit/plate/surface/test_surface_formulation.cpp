#include "plate/surface/surface_formulation.hpp"

#include <catch2/catch.hpp>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/resultants.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/refused.hpp"
#include "plate/solve/solution.hpp"
#include "plate/surface/surface_plate.hpp"

using namespace plate;
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

Load pressure() {
  Load load;
  load.value = 1;
  return load;
}

Load moment(std::vector<std::string> edges, double value) {
  Load load;
  load.kind = Load::Kind::edge_moment, load.value = value, load.edges = std::move(edges);
  return load;
}

State solved(const Formulation& plate) {
  const auto result = solve_static(plate, plate.total_load(), StaticMethod::direct, {}, {1e-9, 10, {}});
  CHECK(result.solution.converged);
  CHECK(result.solution.iterations <= 2);
  return result.solution.state;
}

/// What it is refused for.
Subject refused(const Problem& problem) {
  try {
    bonds_with_surface_nodes.discretise(problem);
  } catch (const Refused& why) {
    return why.reasons().front().subject;
  }
  FAIL("not refused");
  return {};
}

}  // namespace

TEST_CASE("surface nodes: a problem has the solution of the plate that it is made of") {
  const auto problem = square({{SupportKind::clamped, all, {}}}, {pressure()});
  const auto made = bonds_with_surface_nodes.discretise(problem);
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
  const auto made = bonds_with_surface_nodes.discretise(square({{SupportKind::clamped, all, {}}}, {pressure()}));
  Forces force;
  made.plate->internal_force(solved(*made.plate), force);
  const Eigen::VectorXd held = made.plate->constraints().on_held(force);
  double sum = 0;
  for (std::size_t i = 0; i < made.plate->constraints().held().size(); ++i)
    if (made.plate->constraints().held()[i] % 3 == 0) sum += held[Eigen::Index(i)];
  CHECK(sum == Approx(4).epsilon(1e-9));  // internal forces: opposite to reactions
}

TEST_CASE("surface nodes: moments on opposite edges bend the plate alike everywhere") {
  const auto made = bonds_with_surface_nodes.discretise(
      square({{SupportKind::pinned, {}, {{-0.9, -0.9}, {0.9, -0.9}, {0.1, 0.9}}}}, {moment({"left", "right"}, 2)}));
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
  auto problem = square({{SupportKind::clamped, all, {}}}, {pressure()}, 0.125);
  problem.cracks = {{{-0.5, 0}, {0.5, 0}}};
  const auto made = bonds_with_surface_nodes.discretise(problem);
  const auto& at = made.plate->cloud().positions;
  for (const double y : {-0.01, 0.01})
    for (const auto& share : made.plate->interpolation({0.02, y})) CHECK(at[share.point].y() * y > 0);
  CHECK(made.plate->cut()[8 * 16 + 8] > 0.1);
  CHECK(made.plate->cut()[0] == 0);
  CHECK(made.plate->held());
  problem.cracks = {
      {{-0.5, -0.5}, {0.5, -0.5}}, {{0.5, -0.5}, {0.5, 0.5}}, {{0.5, 0.5}, {-0.5, 0.5}}, {{-0.5, 0.5}, {-0.5, -0.5}}};
  CHECK(!bonds_with_surface_nodes.discretise(problem).plate->held());
}

TEST_CASE("surface nodes: what they cannot carry is refused with the reason") {
  const std::vector<Support> clamp{{SupportKind::clamped, all, {}}};
  auto cracked = square(clamp, {pressure()});
  cracked.cracks = {{{-0.3, 0}, {0.3, 0}}};  // 0.7 from the edges, the horizon being 0.754
  CHECK(refused(cracked) == Subject::cracks);
  cracked.cracks = {{{-1, 0}, {0, 0}}};
  CHECK(refused(cracked) == Subject::cracks);
  cracked.cracks = {{{-0.2, 0}, {0.2, 0}}};
  CHECK(bonds_with_surface_nodes.discretise(cracked).plate->tips().size() == 2);
  auto round = square(clamp, {pressure()});
  round.outline.holes.push_back(geometry::Circle{{0, 0}, 0.3, "hole"});
  CHECK(refused(round) == Subject::geometry);
  CHECK(refused(square({{SupportKind::clamped_layer, all, {}}}, {pressure()})) == Subject::support);
  CHECK(refused(square(clamp, {moment({"left"}, 1)})) == Subject::load_edges);
  CHECK(refused(square(clamp, {pressure()}, 2 / 8.51)) == Subject::spacing);
  CHECK(!bonds_with_surface_nodes.discretise(square({}, {pressure()})).plate->held());
  CHECK(bonds_with_surface_nodes.discretise(square(clamp, {pressure()})).plate->held());
}

TEST_CASE("surface nodes: a small plate tells that no motion grows with these edges, and how asymmetric they are") {
  const auto free = bonds_with_surface_nodes.discretise(
      square({{SupportKind::pinned, {}, {{-0.9, -0.9}, {0.9, -0.9}, {0.1, 0.9}}}}, {moment({"left", "right"}, 2)}));
  const auto clamped = bonds_with_surface_nodes.discretise(square({{SupportKind::clamped, all, {}}}, {pressure()}));
  const auto of_clamped = clamped.plate->of_edges();
  CHECK(free.plate->of_edges() != of_clamped);
  for (const auto& text : {free.plate->of_edges(), of_clamped}) {
    CHECK(text.find("motions that grow: 0") != std::string::npos);
    CHECK(text.find("asymmetry") != std::string::npos);
  }
}
