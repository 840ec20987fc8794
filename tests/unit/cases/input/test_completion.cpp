#include "tests/catch.hpp"
#include "tests/unit/cases/input/small_program.hpp"

using Catch::Contains;
using small_program::keys, small_program::program;

TEST_CASE("completion: commands, options and keys, no other shells") {
  for (const char* shell : {"bash", "fish"}) {
    const auto script = cases::completion(shell, program, keys, {"first", "hole"}).value();
    for (const char* part : {"run", "quiet", "section.young", "load.0.kind", "first hole"})
      CHECK_THAT(script, Contains(part));
  }
  CHECK_THAT(cases::completion("fish", program, keys, {}).value(), Contains("it\\'s quiet"));
  CHECK_FALSE(cases::completion("csh", program, keys, {}));
}
