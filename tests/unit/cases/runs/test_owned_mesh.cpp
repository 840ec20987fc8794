#include "cases/runs/owned_mesh.hpp"

#include <map>
#include <mutex>
#include <set>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/statics.hpp"
#include "post/files/frame.hpp"
#include "post/files/recorder.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace plate;

namespace {

using Place = std::array<long, 2>;  // [1e-9 length]

/// What is drawn: cells by the places of their vertices, w, Mxx and Qy of every point that is in one or own.
struct Picture {
  std::multiset<std::vector<Place>> cells;
  std::map<Place, std::array<double, 3>> values;
};

Place place(const geometry::Point& x) {
  return {std::lround(x.x() * 1e9), std::lround(x.y() * 1e9)};
}

Picture picture(const Mesh& mesh, const post::Frame& frame) {
  Picture result;
  const auto all = post::vertices(mesh);
  const auto add = [&](const auto& cells) {
    for (const auto& cell : cells) {
      std::vector<Place> places;
      for (const auto vertex : cell) places.push_back(place(all[vertex]));
      result.cells.insert(std::move(places));
    }
  };
  add(mesh.quads), add(mesh.triangles);
  for (std::size_t k = 0; k + mesh.others < mesh.positions.size(); ++k) {
    const auto i = Eigen::Index(k);
    result.values[place(mesh.positions[k])] = {frame.state(0, i), frame.resultants.moments(0, i),
                                               frame.resultants.shear(1, i)};
  }
  return result;
}

post::Frame frame_of(const Formulation& plate) {
  State state = State::Zero(3, Eigen::Index(plate.points()));
  for (std::uint32_t k = 0; k < plate.points(); ++k) {
    const auto& x = plate.cloud().positions[k];
    state.col(k) << std::sin(3 * x.x()) * x.y(), std::cos(2 * x.y()), x.x() * x.y();
  }
  plate.constraints().impose(state);
  return post::frame_of(plate, 0, 0, state, true);
}

}  // namespace

namespace {

void check(const Problem& problem) {
  const auto whole = discretise(problem).plate;
  const auto wanted = picture(whole->mesh(), frame_of(*whole));
  REQUIRE(wanted.cells.size() > 2000);
  for (const int processes : {1, 2, 5}) {
    Picture all;
    double apart = 0;
    std::mutex one_by_one;
    thread_ranks::run(processes, [&](const Communicator& communicator) {
      const auto plate = discretise(problem, communicator).plate;
      const cases::OwnedMesh drawing(*plate, plate->mesh());
      const auto own = picture(drawing.mesh(), drawing.frame(frame_of(*plate)));
      const std::lock_guard guard(one_by_one);
      all.cells.insert(own.cells.begin(), own.cells.end());
      for (const auto& [at, value] : own.values) {
        all.values[at] = value;
        for (std::size_t c = 0; c < 3; ++c) apart = std::max(apart, std::abs(value[c] - wanted.values.at(at)[c]));
      }
    });
    CHECK((all.cells == wanted.cells));
    CHECK(all.values.size() == wanted.values.size());
    CHECK(apart < 1e-12);  // of values up to 8; measured: 0
  }
}

}  // namespace

TEST_CASE("own drawing: together processes draw every cell once, with the values of one process") {
  Problem problem;
  problem.outline = geometry::rectangle(0, 0, 3, 0.7);
  problem.outline.holes.push_back(geometry::Circle{{2.55, 0.3}, 0.11, "hole"});
  problem.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  problem.supports = {{SupportKind::clamped, {"left"}, {}}, {SupportKind::simply_supported, {"top"}, {}}};
  problem.loads = {Load{}};
  problem.cracks = {{{2.2, 0.41}, {2.83, 0.49}}, {{0.3, 0.16}, {0.9, 0.16}}};  // across and along borders
  problem.discretization.spacing = 0.01;
  problem.discretization.formulation = &ordinary;
  SECTION("of bonds") {
    check(problem);
  }
  SECTION("of a Galerkin plate, graded: without cracks, as places tell points here") {
    problem.cracks.clear();
    problem.discretization.spacing = 0.04, problem.discretization.hole_spacing = 0.01;
    problem.discretization.formulation = &galerkin;
    check(problem);
  }
}
