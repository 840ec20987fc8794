#include "post/files/hdf5/state_file.hpp"
#include "post/files/whole_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder;

TEST_CASE("what cannot be opened or read is an error with the path") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(post::StateFile({folder / "none/state.h5", "", "1"}, small_run::mesh()),
                    Catch::Contains("none/state.h5") && Catch::Contains("No such file"));
  CHECK_THROWS_WITH(post::read_run(folder / "state.h5"), Catch::Contains("state.h5"));
  post::write_whole(folder / "state.h5", "not HDF5");
  CHECK_THROWS_WITH(post::read_run(folder / "state.h5"), Catch::Contains("state.h5"));
  post::StateFile({folder / "no_frames.h5", "", "1"}, small_run::mesh()).close();
  CHECK(post::read_run(folder / "no_frames.h5").times.empty());
}
