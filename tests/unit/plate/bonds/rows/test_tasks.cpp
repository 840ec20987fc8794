#include "plate/bonds/rows/lattice_operator.hpp"

#include <algorithm>
#include <numeric>

#include "tests/catch.hpp"

using plate::Tasks;

namespace {

/// What each of so many threads visits.
std::vector<std::vector<std::size_t>> shares(const Tasks& tasks, int threads) {
  std::vector<std::vector<std::size_t>> result{std::size_t(threads)};
#pragma omp parallel num_threads(threads)
  {
    auto& own = result[std::size_t(omp_get_thread_num())];
    tasks.for_share([&](std::size_t number) { own.push_back(number); });
  }
  return result;
}

}  // namespace

TEST_CASE("tasks: every one is of one thread, in order, and all threads have about as much to do") {
  Tasks tasks;
  std::vector<double> time;
  for (std::size_t i = 0; i < 100; ++i) time.push_back(1 + double(i % 7)), tasks.add(3 * i, time.back());
  CHECK(tasks.size() == 100);
  const double all = std::accumulate(time.begin(), time.end(), 0.0);
  for (const int threads : {1, 2, 3, 5}) {
    std::vector<std::size_t> visited;
    for (const auto& share : shares(tasks, threads)) {
      double sum = 0;
      for (const auto number : share) sum += time[number / 3];
      CHECK(std::abs(sum - all / threads) <= 7);
      visited.insert(visited.end(), share.begin(), share.end());
    }
    REQUIRE(visited.size() == 100);
    for (std::size_t i = 0; i < 100; ++i) CHECK(visited[i] == 3 * i);
  }
}

TEST_CASE("tasks: none, and fewer than threads") {
  CHECK(shares(Tasks(), 3) == std::vector<std::vector<std::size_t>>(3));
  Tasks one;
  one.add(8, 2.5);
  std::vector<std::size_t> visited;
  for (const auto& share : shares(one, 4)) visited.insert(visited.end(), share.begin(), share.end());
  CHECK(visited == std::vector<std::size_t>{8});
}
