#include "plate/formulation/discretised.hpp"

#include <thread>

#include "tests/catch.hpp"

using plate::Stopwatch;

namespace {

double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void wait() {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

}  // namespace

TEST_CASE("stopwatch: stages in the order of their first lap, whose times are all the time that passed") {
  const auto begin = std::chrono::steady_clock::now();
  Stopwatch watch;
  for (const char* stage : {"geometry", "solve", "geometry"}) wait(), watch.lap(stage);
  CHECK(watch.total() <= since(begin));
  REQUIRE(watch.seconds().size() == 2);
  CHECK(watch.seconds()[0].first == "geometry");
  CHECK(watch.seconds("geometry") >= 0.004);
  CHECK(watch.seconds("solve") >= 0.002);
  CHECK(watch.total() == Approx(watch.seconds("geometry") + watch.seconds("solve")));
  CHECK(watch.seconds("output") == 0);
}

TEST_CASE("stopwatch: what another has counted is not counted twice where it is followed") {
  const auto begin = std::chrono::steady_clock::now();
  Stopwatch outer, inner;
  wait(), inner.lap("families");
  outer.follow(inner);
  wait(), outer.lap("solve");
  CHECK(outer.total() <= since(begin));
  CHECK(outer.seconds("families") == inner.seconds("families"));
  outer.add(inner);
  CHECK(outer.seconds("families") == Approx(2 * inner.seconds("families")));
}
