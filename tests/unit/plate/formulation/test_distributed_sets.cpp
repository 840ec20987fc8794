#include "plate/formulation/pieces.hpp"

#include <mutex>
#include <set>

#include "plate/model/halo_exchange.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace plate;

namespace {

/// Own points 0 and 1, and copies 2 and 3 of those of the process before.
Boundary shared(const Communicator& all) {
  Boundary result;
  result.cloud.positions.assign(4, {0, 0});
  result.cloud.plate_points = 4;
  result.map = {&all, {1, 1, 0, 0}};
  result.constraints.resolve();
  const int before = (all.rank() + all.size() - 1) % all.size();
  result.constraints.share(all, {2, 3}, all.halo_exchange(4, {{2, before, 0}, {3, before, 1}}));
  return result;
}

}  // namespace

TEST_CASE("set numbers: of one process the roots") {
  Boundary boundary;
  boundary.cloud.positions.assign(5, {0, 0});
  DisjointSets sets(5);
  sets.join(1, 4), sets.join(3, 2);
  CHECK(set_numbers(sets, boundary) == std::vector<std::int64_t>{0, 1, 2, 2, 1});
}

TEST_CASE("set numbers: a chain through all processes is one set, what hangs on none of them another") {
  for (const int processes : {1, 2, 5}) {
    std::mutex one_by_one;
    std::set<std::int64_t> chain, others;
    thread_ranks::run(processes, [&](const Communicator& all) {
      const Boundary boundary = shared(all);
      DisjointSets sets(4);
      if (all.size() > 1) sets.join(0, 2);  // every first point to that of the process before
      const auto numbers = set_numbers(sets, boundary);
      const std::lock_guard guard(one_by_one);
      chain.insert(numbers[0]), others.insert(numbers[1]);
      if (all.size() > 1) CHECK(numbers[2] == numbers[0]);
    });
    CHECK(chain.size() == 1);
    CHECK(others.size() == std::size_t(processes));
    CHECK(!others.contains(*chain.begin()));
  }
}
