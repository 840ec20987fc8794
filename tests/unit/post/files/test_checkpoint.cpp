#include "post/files/checkpoints.hpp"

#include <fstream>

#include "post/files/atomic_file.hpp"
#include "post/files/run_folder.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using namespace post;

namespace {

/// What is read back, and what was refused on the way.
struct ReadBack {
  std::optional<std::string> memory;
  std::vector<std::string> refused;
};

ReadBack read(const Checkpoints& checkpoints) {
  ReadBack result;
  result.memory = checkpoints.read(result.refused);
  return result;
}

}  // namespace

TEST_CASE("checkpoints: the newest comes back, two are kept, none is left of what was removed") {
  const ScratchFolder scratch("pdplate_checkpoint");
  const Checkpoints checkpoints(scratch.path(), "case 1");
  CHECK_FALSE(read(checkpoints).memory);
  const std::string odd("first\n\0with zeros", 17);
  checkpoints.write(odd);
  CHECK(read(checkpoints).memory == odd);
  checkpoints.write("second"), checkpoints.write("third");
  CHECK(read(checkpoints).memory == "third");
  std::filesystem::remove(scratch.path() / "checkpoint");
  CHECK(read(checkpoints).memory == "second");
  checkpoints.remove();
  CHECK(std::filesystem::is_empty(scratch.path()));
}

TEST_CASE("checkpoints: any byte that is damaged or missing gives the one before, with a word about it") {
  const ScratchFolder scratch("pdplate_checkpoint");
  const Checkpoints checkpoints(scratch.path(), "case 1");
  checkpoints.write("older"), checkpoints.write("newer");
  const auto path = scratch.path() / "checkpoint";
  const auto whole = read_text(path);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    auto text = whole;
    text[i] ^= 1;
    std::ofstream(path, std::ios::binary) << text;
    const auto damaged = read(checkpoints);
    REQUIRE(damaged.memory == "older");
    REQUIRE(damaged.refused.size() == 1);
    std::ofstream(path, std::ios::binary) << whole.substr(0, i);
    REQUIRE(read(checkpoints).memory == "older");
  }
}

TEST_CASE("checkpoints of another run are refused") {
  const ScratchFolder scratch("pdplate_checkpoint");
  Checkpoints(scratch.path(), "case 1").write("of case 1");
  const auto found = read(Checkpoints(scratch.path(), "case 2"));
  CHECK_FALSE(found.memory);
  REQUIRE(found.refused.size() == 1);
  CHECK_THAT(found.refused[0], Catch::Contains("case 1, not case 2"));
}

TEST_CASE("a checkpoint that cannot be written leaves those before") {
  const ScratchFolder scratch("pdplate_checkpoint");
  const Checkpoints checkpoints(scratch.path(), "case 1");
  checkpoints.write("good");
  {
    const small_run::FullDisk full(1000);
    CHECK_THROWS_AS(checkpoints.write(std::string(100000, 'x')), std::filesystem::filesystem_error);
  }
  CHECK(read(checkpoints).memory == "good");
  CHECK_FALSE(std::filesystem::exists(scratch.path() / "checkpoint.partial"));
}
