#include "post/files/run_folder.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <system_error>

#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using post::NamedLock;
using Use = NamedLock::Use;

TEST_CASE("named locks: a name is kept by one, or shared, until its keeper ends") {
  const small_run::TemporaryFolder scratch;
  const auto file = scratch / "locks";
  const auto free = [&](const std::string& name, Use use) { return NamedLock(file, name, use).held(); };
  {
    NamedLock first(file, "a", Use::alone);
    CHECK(first.works());
    CHECK(first.held());
    CHECK_FALSE(free("a", Use::alone));
    CHECK_FALSE(free("a", Use::together));
    CHECK(free("b", Use::alone));
    const NamedLock moved(std::move(first));
    CHECK_FALSE(free("a", Use::alone));
  }
  CHECK(free("a", Use::alone));
  const NamedLock shared(file, "a", Use::together);
  CHECK(free("a", Use::together));
  CHECK_FALSE(free("a", Use::alone));
  CHECK_THROWS_AS(NamedLock(scratch / "none" / "locks", "a", Use::alone), std::system_error);
}

TEST_CASE("named locks: a process that was killed keeps them no longer, and one waits that long") {
  const small_run::TemporaryFolder scratch;
  const auto file = scratch / "locks";
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const NamedLock lock(file, "a", Use::alone);
    if (write(ready[1], "x", 1) == 1) pause();
    _exit(1);
  }
  char byte = 0;
  REQUIRE(read(ready[0], &byte, 1) == 1);
  CHECK_FALSE(NamedLock(file, "a", Use::alone).held());
  kill(child, SIGKILL);
  CHECK(NamedLock(file, "a", Use::alone, std::chrono::seconds(10)).held());
  waitpid(child, nullptr, 0);
  close(ready[0]), close(ready[1]);
}
