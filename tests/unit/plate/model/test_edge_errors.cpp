#include "plate/model/problem_validation.hpp"

#include "plate/formulations.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/support_validation.hpp"
#include "tests/catch.hpp"

using plate::Subject;

namespace {

plate::Problem clamped_square() {
  plate::Problem problem;
  problem.outline = geometry::rectangle(0, 0, 1, 1);
  problem.discretization.formulation = plate::formulations().back();  // bonds: layers follow the axes
  problem.supports = {{plate::SupportKind::clamped, {"left"}, {}}};
  return problem;
}

std::vector<std::pair<Subject, std::size_t>> found(const plate::Problem& problem) {
  std::vector<std::pair<Subject, std::size_t>> result;
  for (const auto& one : plate::errors_in_edges(problem)) result.emplace_back(one.subject, one.number);
  return result;
}

using Found = std::vector<std::pair<Subject, std::size_t>>;

}  // namespace

TEST_CASE("faults of edges: names that the plate does not have, edges held twice, points beside the plate") {
  auto problem = clamped_square();
  CHECK(found(problem).empty());
  problem.supports.push_back({plate::SupportKind::clamped, {"left", "lft"}, {}});
  problem.supports.push_back({plate::SupportKind::pinned, {}, {{0.5, 0.5}, {1, 0.5}, {1.1, 0.5}}});
  problem.loads = {plate::Load{plate::EdgeShear{.edges = {"top", "roof"}}}};
  CHECK(found(problem) == Found{{Subject::support_edges, 1},
                                {Subject::support_edges, 1},
                                {Subject::support_points, 2},
                                {Subject::load_edges, 0}});
  CHECK_THAT(plate::errors_in_edges(problem)[0].what, Catch::Contains("did you mean 'left'?"));
}

TEST_CASE("faults of edges: what mirrors the lattice needs an edge along it") {
  auto problem = clamped_square();
  problem.outline.outer = {{{0, 0}, {1, 0}, {1.2, 1}, {0, 1}}, {"bottom", "right", "top", "left"}};
  problem.supports = {{plate::SupportKind::symmetry, {"left", "right"}, {}}};
  CHECK(found(problem) == Found{{Subject::support_direction, 0}});
  problem.discretization.formulation = plate::formulations().front();
  CHECK(found(problem).empty());
}

TEST_CASE("faults of edges: a force at a point lies inside the plate, a pin on its boundary too") {
  auto problem = clamped_square();
  CHECK(plate::on_plate(problem.outline, {1, 0.5}));
  problem.loads = {plate::Load{plate::PointForce{.position = {1, 0.5}}}};
  CHECK(found(problem) == Found{{Subject::load_position, 0}});
}

TEST_CASE("faults of edges: layers need straight edges along the axes, whatever they hold, and something to hold") {
  auto problem = clamped_square();
  problem.discretization.boundary = plate::EdgeMethod::layer;
  CHECK(found(problem).empty());
  problem.outline.outer = {{{0, 0}, {1, 0}, {1.2, 1}, {0, 1}}, {"bottom", "right", "top", "left"}};
  problem.supports = {{plate::SupportKind::simply_supported, {"left", "right"}, {}}};
  CHECK(found(problem) == Found{{Subject::support_direction, 0}});
  CHECK_THAT(plate::errors_in_edges(problem)[0].what, Catch::Contains("choose \"images\""));
  using enum plate::SupportKind;
  problem.supports = {{symmetry, {"left"}, {}}, {plate::SupportKind::free, {"top"}, {}}, {pinned, {}, {{0.5, 0.5}}}};
  CHECK(found(problem) == Found{{Subject::edge_method, 0}});
  problem.discretization.formulation = plate::formulations().front();  // refuses the key itself
  CHECK(found(problem).empty());
}

TEST_CASE("faults of edges: a load on an edge that holds all it acts on would go into the support") {
  using enum plate::SupportKind;
  enum class Kind { edge_moment, edge_shear };
  struct Tried {
    plate::SupportKind kind;
    Kind load;
    double moment, twist;
    bool refused;
  };
  const Tried tried[] = {{clamped, Kind::edge_moment, 1, 0, true},
                         {clamped, Kind::edge_shear, 1, 0, true},
                         {clamped, Kind::edge_moment, 0, 1, true},
                         {simply_supported, Kind::edge_shear, 1, 0, true},
                         {simply_supported, Kind::edge_moment, 1, 1, false},
                         {simply_supported_hard, Kind::edge_moment, 0, 1, true},
                         {simply_supported_hard, Kind::edge_moment, 1, 1, false},
                         {symmetry, Kind::edge_moment, 1, 0, true},
                         {symmetry, Kind::edge_moment, 1, 1, false},
                         {symmetry, Kind::edge_shear, 1, 0, false},
                         {simply_supported_layer, Kind::edge_moment, 1, 0, false},
                         {plate::SupportKind::free, Kind::edge_shear, 1, 0, false}};
  for (const auto& [kind, load_kind, moment, twist, refused] : tried) {
    auto problem = clamped_square();
    problem.supports = {{kind, {"left"}, {}}};
    plate::EdgeMoment edge_moment{.edges = {"left", "top"}, .value = moment, .twist = twist};
    plate::EdgeShear edge_shear{.edges = {"left", "top"}, .value = moment};
    const bool shears = load_kind == Kind::edge_shear;
    problem.loads = {shears ? plate::Load{edge_shear} : plate::Load{edge_moment}};
    CAPTURE(int(kind), int(load_kind), moment, twist);
    CHECK(found(problem) == (refused ? Found{{Subject::load_edges, 0}} : Found{}));
    edge_moment.edges = edge_shear.edges = {"top"};
    problem.loads = {shears ? plate::Load{edge_shear} : plate::Load{edge_moment}};
    CHECK(found(problem).empty());
  }
  auto problem = clamped_square();
  problem.loads = {plate::Load{plate::EdgeMoment{.edges = {"left"}, .tensor = {{1, 0, 0}}}}};
  CHECK(found(problem) == Found{{Subject::load_edges, 0}});
}

TEST_CASE("faults of edges: a traction all round a free hub pulls it nowhere, unless it turns it") {
  auto problem = clamped_square();
  problem.outline.holes = {geometry::Circle{{0.5, 0.5}, 0.1, "hole0"}};
  problem.supports = {{plate::SupportKind::hub, {"hole0"}, {}}};
  for (const double shear : {0.0, 1.0}) {
    problem.loads = {plate::Load{plate::EdgeTraction{.edges = {"hole0"}, .value = 1, .shear = shear}}};
    CHECK(found(problem) == (shear == 0 ? Found{{Subject::load_edges, 0}} : Found{}));
  }
  problem.loads = {plate::Load{plate::EdgeTraction{.edges = {"hole0"}, .tensor = {{1, 2, 3}}}}};
  CHECK(found(problem) == Found{{Subject::load_edges, 0}});
}

TEST_CASE("faults of edges: one has no name that the reaction of a pin, line, part or hub has") {
  auto problem = clamped_square();
  problem.outline.outer.edge_names = {"a", "b", "c", "hub0"};
  plate::Support hub{plate::SupportKind::hub, {}, {}};
  hub.patch = geometry::Circle{{0.5, 0.5}, 0.1, ""};
  problem.supports = {hub};
  CHECK(found(problem) == Found{{Subject::geometry, 0}});
  problem.outline.outer.edge_names.back() = "hub1";
  CHECK(found(problem).empty());
}

TEST_CASE("faults of edges: a force on a crack has no face") {
  auto problem = clamped_square();
  problem.cracks = {{{0.2, 0.2}, {0.6, 0.6}}};
  for (const auto& [x, y, refused] :
       {std::tuple{0.4, 0.4, true}, {0.6, 0.6, true}, {0.4, 0.41, false}, {0.7, 0.7, false}}) {
    problem.loads = {plate::Load{plate::PointForce{.position = {x, y}}}};
    CHECK(found(problem) == (refused ? Found{{Subject::load_position, 0}} : Found{}));
  }
}

TEST_CASE("faults of edges: a force on a part that is held would go into the support") {
  auto problem = clamped_square();
  plate::Support column;
  column.kind = plate::SupportKind::pinned, column.patch = geometry::Circle{{0.5, 0.5}, 0.1, ""};
  problem.supports.push_back(column);
  for (const auto& [x, refused] : {std::pair(0.5, true), {0.58, true}, {0.62, false}}) {
    problem.loads = {plate::Load{plate::PointForce{.position = {x, 0.5}}}};
    CHECK(found(problem) == (refused ? Found{{Subject::load_position, 0}} : Found{}));
  }
}

TEST_CASE("held holes: rims that stay level and pins on rims are told, once each, with the hub to set") {
  auto problem = clamped_square();
  for (const double x : {0.3, 0.7})
    problem.outline.holes.push_back(geometry::Circle{{x, 0.5}, 0.1, x < 0.5 ? "hole0" : "hole1"});
  CHECK(plate::warnings_about_held_holes(problem).empty());
  problem.supports = {{plate::SupportKind::clamped, {"hole0", "hole1"}, {}}};
  CHECK(plate::warnings_about_held_holes(problem).empty());
  for (const auto kind : {plate::SupportKind::simply_supported, plate::SupportKind::simply_supported_hard}) {
    problem.supports = {{kind, {"hole0", "left", "hole1"}, {}}};
    CHECK(plate::warnings_about_held_holes(problem) ==
          std::vector<std::string>{"hole0 and 1 more: simply_supported all round hinders the rim's turn; for fixings "
                                   "that turn set kind = \"hub\" and k_phi = 0"});
  }
  problem.supports = {{plate::SupportKind::pinned, {}, {{0.8, 0.5}, {0.6494, 0.5866}, {0.6494, 0.4134}}}};
  CHECK(plate::warnings_about_held_holes(problem) ==
        std::vector<std::string>{"hole1: pins on the rim hold the plate too softly; for fixings that turn set "
                                 "kind = \"hub\" and k_phi = 0"});
  problem.supports = {{plate::SupportKind::pinned, {}, {{0.8, 0.5}, {0.3, 0.2}, {0.5, 0.5}}}};  // one of them on a rim
  CHECK(plate::warnings_about_held_holes(problem).empty());
}

TEST_CASE(
    "hubs on the plate: what is closer than a spacing to a rim is told, and a disc over the whole plate refused") {
  auto problem = clamped_square();
  problem.discretization.spacing = 0.02;
  const auto hub = [](const geometry::Circle& disc) {
    plate::Support result;
    result.kind = plate::SupportKind::hub, result.patch = disc;
    return result;
  };
  const auto told = [&] { return plate::warnings_about_hubs(problem); };
  const std::string closer = ": errors may exceed their estimates; set `spacing` = 0.01";
  problem.supports = {hub({{0.5, 0.5}, 0.1, ""})};
  CHECK(told().empty());
  problem.cracks = {{{0.61, 0.5}, {0.8, 0.5}}};
  CHECK(told() == std::vector{"hub0: an edge, a crack or another disc is 0.5 spacings from its rim" + closer});
  problem.cracks = {{{0.62, 0.5}, {0.8, 0.5}}};
  problem.supports.push_back(hub({{0.5, 0.11}, 0.1, ""}));  // beside the edge
  CHECK(told() == std::vector{"hub1: an edge, a crack or another disc is 0.5 spacings from its rim" + closer});
  problem.supports[1] = hub({{0.5, 0.29}, 0.1, ""});
  CHECK(told().size() == 2);
  problem.cracks.clear();
  problem.supports = {hub({{0.5, 0.5}, 0.8, ""})};
  CHECK(found(problem) == Found{{Subject::support_patch, 0}});
}
