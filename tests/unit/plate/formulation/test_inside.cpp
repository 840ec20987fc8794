#include "plate/formulation/support_constraints.hpp"

#include <mutex>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/formulations.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/bonds/parts.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point;

TEST_CASE("a line holds what lies on it of every linear field, a part all of its points") {
  for (const auto* kind : formulations()) {
    auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.1);
    c.discretization.formulation = kind;
    c.supports = {{SupportKind::pinned, {}, {}, {{0.2, 0.17}, {0.7, 0.61}}},
                  {SupportKind::clamped, {}, {}, {}, geometry::Circle{{0.75, 0.25}, 0.16, ""}}};
    c.loads = {Load{Pressure{.value = 1}}};
    const auto plate = vp::assembled(c);
    const auto& b = plate->boundary();
    REQUIRE(b.holders.size() == 2);
    CHECK(b.holders[0].name == "line0");
    CHECK(b.holders[1].name == "part0");
    CHECK(b.holders[1].support == 1);
    CHECK(plate->held());
    // w = (x - a) . n vanishes on the line: what is held of it there is what it is
    const Point along = Point(0.5, 0.44).normalized(), n(-along.y(), along.x());
    State field = vp::field(
        *plate, [&](const Point& x) { return Eigen::Vector3d((x - Point(0.2, 0.17)).dot(n), n.y(), -n.x()); });
    State held = field;
    b.constraints.impose(held);
    std::size_t on_line = 0, in_part = 0;
    for (const auto& hold : b.holds) {
      if (hold.holder == 1) in_part += !hold.rotations;
      if (hold.holder != 0) continue;
      ++on_line;
      CHECK((held.col(hold.point) - field.col(hold.point)).norm() < 1e-12);
    }
    CHECK(on_line >= 5);
    CHECK(in_part >= 4);
    for (const auto& hold : b.holds)
      if (hold.holder == 1)
        for (std::uint32_t i = 0; i < 3; ++i) CHECK(b.constraints.held(dof(hold.point, i)));
  }
}

TEST_CASE("a clamped part along an edge is a clamped edge") {
  for (const auto* kind : formulations()) {
    auto c = vp::free_plate(geometry::rectangle(0.2, 0, 1, 1), 0.05);
    c.discretization.formulation = kind;
    c.supports = {vp::held(SupportKind::clamped, {"left"})};
    c.loads = {Load{Pressure{.gradient = {1, 0.5}}}};
    const auto edge = vp::assembled(c);
    const double expected = vp::solved(*edge).state.cwiseAbs().maxCoeff();
    c.outline = geometry::rectangle(0, 0, 1, 1);
    for (const double beyond : {0.0, 0.3}) {  // the part ends on the edge, or beyond it
      c.supports = {
          {SupportKind::clamped,
           {},
           {},
           {},
           geometry::Polygon{{{-beyond, -beyond}, {0.2, -beyond}, {0.2, 1 + beyond}, {-beyond, 1 + beyond}}, {}}}};
      const auto part = vp::assembled(c);
      CAPTURE(kind->name, beyond);
      CHECK(vp::solved(*part).state.cwiseAbs().maxCoeff() == Approx(expected).epsilon(1e-6));
    }
  }
}

TEST_CASE("a part over the whole plate carries all of its load") {
  for (const auto* kind : {&ordinary, &galerkin}) {
    auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.1);
    c.discretization.formulation = kind;
    c.supports = {{SupportKind::clamped, {}, {}, {}, geometry::Circle{{0.5, 0.5}, 2, ""}}};
    c.loads = {Load{Pressure{.value = 1}}};
    const auto plate = vp::assembled(c);
    const auto found =
        solve_static(*plate, plate->total_load(), StaticMethod::direct, Preconditioning::automatic, {1e-10, 1000, {}});
    CHECK(found.solution.converged);
    CHECK(found.solution.state.cwiseAbs().maxCoeff() == 0);
    CHECK(plate->constraints().on_held(plate->total_load()).size() == 3 * Eigen::Index(plate->points()));
  }
}

TEST_CASE("a part between the points of bonds is refused") {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.1);
  c.supports = {{SupportKind::clamped, {}, {}, {}, geometry::Circle{{0.5, 0.5}, 0.03, ""}}};
  c.loads = {Load{Pressure{.value = 1}}};
  CHECK_THROWS_WITH(vp::assembled(c), Catch::Contains("no point of the plate lies on it"));
}

TEST_CASE("places on lines and about parts keep away from edges and cracks") {
  const auto outline = geometry::rectangle(0, 0, 1, 1);
  const std::vector<geometry::CrackPath> crack = geometry::crack_paths(outline, {{{0.5, 0.3}, {0.5, 0.7}}}, 1e-9);
  const auto places = places_inside({{SupportKind::pinned, {}, {}, {{0, 0.5}, {0.8, 0.5}}}}, outline, crack, 0.1);
  CHECK(places.size() == 7);
  for (const auto& x : places) {
    CHECK(x.x() > 0.05);
    CHECK(std::abs(x.x() - 0.5) > 0.05);
  }
  CHECK(places_inside({}, outline, crack, 0.1).empty());
}

TEST_CASE("a part of the plate that only some processes see is held by these, and refused by none") {
  for (const auto* kind : {&ordinary, &galerkin}) {
    auto problem = parts::problem_of(geometry::rectangle(0, 0, 2.5, 1), {}, {parts::pressure(1)});
    problem.discretization.formulation = kind;
    problem.supports = {{SupportKind::clamped, {}, {}, {}, geometry::Circle{{1.2, 0.1}, 0.05, ""}}};
    const auto held = [&](const Communicator& communicator) {
      const auto plate = discretise(problem, communicator).plate;
      const auto& boundary = plate->boundary();
      return std::ranges::count_if(boundary.holds,
                                   [&](const auto& hold) { return !hold.rotations && boundary.owns(hold.point); });
    };
    const auto whole = held(single_process());
    CHECK(whole > 70);  // of 79 spacings square
    std::ptrdiff_t all = 0, least = whole;
    std::mutex one_by_one;
    thread_ranks::run(4, [&](const Communicator& communicator) {
      const auto own = held(communicator);
      const std::lock_guard guard(one_by_one);
      all += own, least = std::min(least, own);
    });
    CHECK(all == whole);
    CHECK(least == 0);
  }
}

TEST_CASE("a clamped part across processes has the energy and the pieces that it has on one") {
  for (const auto* kind : {&ordinary, &galerkin}) {
    auto problem = parts::problem_of(geometry::rectangle(0, 0, 2.5, 1), {}, {parts::pressure(1)});
    problem.discretization.formulation = kind;
    problem.supports = {{SupportKind::clamped, {}, {}, {}, geometry::Circle{{1.2, 0.5}, 0.25, ""}}};
    const auto alone = discretise(problem, single_process()).plate;
    State state = zero_state(alone->points());
    const auto set = [](const Formulation& plate, State& values) {
      for (std::size_t k = 0; k < plate.points(); ++k) {
        const Point& x = plate.cloud().positions[k];
        values.col(Eigen::Index(k)) =
            PointValues(std::sin(3 * x.x()) + x.y() * x.y(), x.x() * x.y(), std::cos(2 * x.y()));
      }
      plate.constraints().impose(values);
    };
    set(*alone, state);
    const double energy = alone->strain_energy(state);
    CAPTURE(kind->name, alone->pieces().size());
    std::mutex one_by_one;
    thread_ranks::run(4, [&](const Communicator& communicator) {
      const auto plate = discretise(problem, communicator).plate;
      State own = zero_state(plate->points());
      set(*plate, own);
      const double shared = plate->strain_energy(own);
      const std::lock_guard guard(one_by_one);
      CHECK(shared == Approx(energy).epsilon(1e-10));
      CHECK(plate->pieces().size() == alone->pieces().size());
      CHECK(plate->mechanisms().searched);
    });
  }
}
