// What processes evaluate while they exchange copies. That nothing of it looks at copies which are not there yet shows
// in all tests of plates in parts: until they come, copies are no numbers there.
#include <omp.h>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/bonds/parts.hpp"
#include "tests/unit/plate/model/watched_communicator.hpp"

using namespace parts;

namespace {

/// An exchange: of how many components; for how many of the process's own points dilatations were found while it was
/// under way, and forces when it began and when it ended, as shares of all.
struct Seen {
  std::size_t components;
  double dilatations, forces_before, forces_after;
};

/// One process, and what it does.
class Process {
public:
  Process(const Communicator& all, const Problem& problem)
      : ranks_(all, [this](std::span<const double> values, bool ends) { watch(values, ends); }) {
    omp_set_num_threads(1);  // others would go ahead of the one that is watched
    plate = discretise(problem, ranks_).plate;
    forces = Forces::Constant(3, Eigen::Index(plate->points()), NAN);
  }

  std::unique_ptr<Formulation> plate;
  Forces forces;
  std::vector<Seen> seen;

private:
  void watch(std::span<const double> values, bool ends) {
    if (!plate) return;
    if (values.size() == plate->points()) dilatations_ = values;
    if (!ends) {
      before_.assign(dilatations_.begin(), dilatations_.end());
      seen.push_back({values.size() / plate->points(), 0, share_of_forces(), 0});
      return;
    }
    seen.back().dilatations = share([&](std::size_t k) { return !before_.empty() && dilatations_[k] != before_[k]; });
    seen.back().forces_after = share_of_forces();
  }

  template <typename Is>
  double share(const Is& is) const {
    double found = 0, all = 0;
    for (std::size_t k = 0; k < plate->cloud().plate_points; ++k)
      if (plate->boundary().owns(std::uint32_t(k))) all += 1, found += is(k);
    return found / all;
  }
  double share_of_forces() const {
    return share([&](std::size_t k) { return std::isfinite(forces(0, Eigen::Index(k))); });
  }

  thread_ranks::WatchedCommunicator ranks_;
  std::span<const double> dilatations_;
  std::vector<double> before_;
};

Problem strip() {
  return problem_of(geometry::rectangle(0, 0, 0.5, 1.2), {{SupportKind::clamped, {"left"}, {}}}, {pressure(2)});
}

/// Calls check(process, forces on the state as they come, the same as they should be) of every process, one by one.
template <typename Check>
void for_each_process(const Problem& problem, const Check& check) {
  std::mutex one_by_one;
  thread_ranks::run(2, [&](const Communicator& all) {
    Process process(all, own(problem));
    const auto& plate = *process.plate;
    State state(3, Eigen::Index(plate.points()));
    for (Eigen::Index k = 0; k < state.cols(); ++k) state.col(k).setConstant(std::sin(0.7 * double(k)));
    State whole = state, other = 2 * state;
    plate.constraints().impose(whole);
    Forces expected, unused;
    plate.internal_force(whole, expected), plate.constraints().impose(other), plate.internal_force(other, unused);
    process.seen.clear();
    PendingExchange rest(plate.constraints(), state);
    plate.internal_force_overlapped(state, rest, process.forces);
    const std::lock_guard guard(one_by_one);
    CHECK(state == whole);
    for (std::uint32_t k = 0; k < plate.cloud().plate_points; ++k)
      if (plate.boundary().owns(k)) CHECK(process.forces.col(k) == expected.col(k));
    check(process);
  });
}

}  // namespace

TEST_CASE("a plate in parts: bonds inside are evaluated while displacements, and while dilatations are exchanged") {
  for_each_process(strip(), [](const Process& process) {
    REQUIRE(process.seen.size() == 2);
    const auto &states = process.seen[0], &dilatations = process.seen[1];
    CHECK(states.components == 3);
    CHECK(states.dilatations > 0.8);  // 3 of 60 rows wait: 0.95
    CHECK(states.dilatations < 1);
    CHECK(states.forces_after == 0);
    CHECK(dilatations.components == 1);
    CHECK(dilatations.forces_before == 0);
    CHECK(dilatations.dilatations == 0);  // all were there
    CHECK(dilatations.forces_after > 0.8);
    CHECK(dilatations.forces_after < 1);
  });
}

TEST_CASE("a plate in parts: cells inside are evaluated while displacements are exchanged") {
  auto problem = strip();
  problem.discretization.formulation = &galerkin;
  for_each_process(problem, [](const Process& process) {
    REQUIRE(process.seen.size() == 1);
    CHECK(process.seen[0].components == 3);
    CHECK(process.seen[0].forces_before == 0);
    CHECK(process.seen[0].forces_after > 0.7);  // edges wait too, for what their lists leave
    CHECK(process.seen[0].forces_after < 1);
  });
}

TEST_CASE("a plate in parts: in motion every step but rows goes on while displacements are exchanged") {
  std::mutex one_by_one;
  thread_ranks::run(2, [&](const Communicator& all) {
    Process process(all, own(strip()));
    const auto& plate = *process.plate;
    DynamicOptions options{1e-5, 7, 5};
    options.velocity.resize(3, Eigen::Index(plate.points()));  // so that all rotations change at once
    for (Eigen::Index k = 0; k < options.velocity.cols(); ++k)
      options.velocity.col(k).setConstant(std::sin(0.7 * double(k)));
    process.seen.clear();
    central_differences(plate, plate.constraints(), plate.mass(), plate.loads(), options, [](const Instant&) {});
    const std::lock_guard guard(one_by_one);
    std::vector<bool> overlapped;
    for (const auto& one : process.seen)
      if (one.components == 3) overlapped.push_back(one.dilatations > 0.8);
    // whoever observes a row may ask for its velocity, of which copies come at once: here nobody does
    CHECK(overlapped == std::vector<bool>{true, true, true, true, false, true, false});
  });
}
