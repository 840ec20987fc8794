#include "post/files/atomic_file.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

TEST_CASE("a state.h5 that was put beside another case is refused") {
  const small_run::TemporaryFolder folder;
  post::StateFile file({folder / "state.h5", "title = \"a\"\n", "1"}, small_run::mesh());
  file.write(small_run::frame(0, 0), nullptr);
  file.close();
  CHECK(post::read_run(folder / "state.h5").times.size() == 1);  // alone
  post::write_atomically(folder / "case.resolved.toml", "title = \"a\"\n");
  CHECK(post::read_run(folder / "state.h5").resolved_case == "title = \"a\"\n");
  post::write_atomically(folder / "case.resolved.toml", "title = \"b\"\n");
  CHECK_THROWS_WITH(post::read_run(folder / "state.h5"), Catch::Contains("state.h5 is of another case"));
}
