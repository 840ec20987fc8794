#include "plate/solve/interruption.hpp"

#include <csignal>
#include <optional>

#include "tests/catch.hpp"

using namespace plate;

namespace {

volatile std::sig_atomic_t seen = 0;

}  // namespace

TEST_CASE("a signal asks for the end while a guard lives, and no longer") {
  const auto before = std::signal(SIGTERM, [](int) { seen = 1; });
  {
    const StopOnSignals outer;
    CHECK_FALSE(stop_is_asked());
    CHECK_NOTHROW(stop_if_asked("a test"));
    std::optional<StopOnSignals> inner(std::in_place);
    raise(SIGTERM);
    CHECK(stop_is_asked());
    inner.reset();
    CHECK(stop_is_asked());  // what encloses it is asked too
    CHECK_THROWS_WITH(stop_if_asked("a test"), "asked to stop in a test");
    raise(SIGINT);  // passed on by another: not the second of its kind
    CHECK(stop_is_asked());
  }
  CHECK_FALSE(stop_is_asked());
  CHECK(seen == 0);
  raise(SIGTERM);  // whoever handled it before does again
  CHECK(seen == 1);
  std::signal(SIGTERM, before);
}

TEST_CASE("a signal that is ignored stays so") {
  const auto before = std::signal(SIGINT, SIG_IGN);
  {
    const StopOnSignals guard;
    raise(SIGINT);
    CHECK_FALSE(stop_is_asked());
  }
  std::signal(SIGINT, before);
}
