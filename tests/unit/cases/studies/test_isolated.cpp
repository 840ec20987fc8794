#include "cases/studies/isolated_runs.hpp"

#include <omp.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <ctime>
#include <stdexcept>
#include <thread>

#include "tests/catch.hpp"

using cases::RunOutcome;

namespace {

/// Work that a team of threads shares.
long shared_work() {
  long sum = 0;
#pragma omp parallel for reduction(+ : sum)
  for (long i = 0; i < 100000; ++i) sum += i;
  return sum;
}

}  // namespace

TEST_CASE("isolated: what a run comes to is told, however it ends") {
  using cases::Ended, cases::isolated;
  CHECK(isolated([] { return Ended{RunOutcome::done}; }).outcome == RunOutcome::done);
  const auto refused = isolated([] { return Ended{RunOutcome::refused, "two\nlines"}; });
  CHECK(refused.outcome == RunOutcome::refused);
  CHECK(refused.message == "two\nlines");
  const auto broken = isolated([]() -> Ended { throw std::runtime_error("disk full"); });
  CHECK(broken.outcome == RunOutcome::broken);
  CHECK(broken.message == "disk full");
  const auto killed = isolated([]() -> Ended {
    std::raise(SIGKILL);
    return {RunOutcome::done};
  });
  CHECK(killed.outcome == RunOutcome::killed);
  CHECK_THAT(killed.message, Catch::Contains("signal 9"));
  CHECK(isolated([]() -> Ended { _exit(7); }).outcome == RunOutcome::killed);
}

TEST_CASE("isolated: threads of this process neither hinder those of the run, nor are there fewer") {
  const int before = omp_get_max_threads();
  omp_set_num_threads(2);
  const long expected = shared_work();  // this process has a team now
  const auto ended = cases::isolated([&]() -> cases::Ended {
    return {shared_work() == expected ? RunOutcome::done : RunOutcome::failed, std::to_string(omp_get_max_threads())};
  });
  CHECK(ended.outcome == RunOutcome::done);
  CHECK(ended.message == "2");
  CHECK(shared_work() == expected);
  omp_set_num_threads(before);
}

TEST_CASE("isolated: processor seconds are those of the run, without what this process spent before or waited") {
  constexpr double spent = 0.05;  // [processor s]
  const auto burn = [] {
    const auto begun = std::clock();
    while (double(std::clock() - begun) / CLOCKS_PER_SEC < spent) continue;
  };
  burn(), burn();
  const auto ended = cases::isolated([&]() -> cases::Ended {
    burn();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return {RunOutcome::done};
  });
  CHECK(ended.processor_seconds >= spent);
  CHECK(ended.processor_seconds < 1.8 * spent);
}

TEST_CASE("isolated: nothing that a run changes is changed here") {
  int value = 1;
  cases::isolated([&]() -> cases::Ended {
    value = 2;
    return {RunOutcome::done};
  });
  CHECK(value == 1);
}
