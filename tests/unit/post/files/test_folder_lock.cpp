#include "post/files/run_folder.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include "tests/catch.hpp"

using namespace post;

TEST_CASE("a folder is of one run at a time, until that ends") {
  const ScratchFolder scratch("pdplate_lock");
  {
    FolderLock first(scratch.path());
    CHECK(first.held());
    CHECK_FALSE(FolderLock(scratch.path()).held());
    const FolderLock moved(std::move(first));
    CHECK(moved.held());
    CHECK_FALSE(FolderLock(scratch.path()).held());
  }
  CHECK(FolderLock(scratch.path()).held());
}

TEST_CASE("a process that dies leaves no lock behind, nor a file") {
  const ScratchFolder scratch("pdplate_lock");
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(scratch.path());
    [[maybe_unused]] const auto written = write(ends[1], "x", 1);
    pause();
  }
  char byte = 0;
  REQUIRE(read(ends[0], &byte, 1) == 1);
  CHECK_FALSE(FolderLock(scratch.path()).held());
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  CHECK(FolderLock(scratch.path()).held());
  CHECK(std::filesystem::is_empty(scratch.path()));
  close(ends[0]), close(ends[1]);
}
