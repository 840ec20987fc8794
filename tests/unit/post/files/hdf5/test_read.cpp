#include <hdf5.h>

#include "post/files/atomic_file.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder;

namespace {

/// Where a dataset's first chunk stands in its file, and how many bytes it has.
std::pair<std::size_t, std::size_t> chunk_of(const std::filesystem::path& path, const char* name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), dataset = H5Dopen2(file, name, H5P_DEFAULT);
  const hid_t space = H5Dget_space(dataset);
  haddr_t begin = HADDR_UNDEF;
  hsize_t bytes = 0;
  unsigned filters = 0;
  CHECK(H5Dget_chunk_info(dataset, space, 0, nullptr, &filters, &begin, &bytes) >= 0);
  H5Sclose(space), H5Dclose(dataset), H5Fclose(file);
  return {begin, bytes};
}

}  // namespace

TEST_CASE("a state.h5 with a changed bit among its positions or frames is refused") {
  const TemporaryFolder folder;
  const auto path = folder / "state.h5";
  {
    post::StateFile file({path, "", "1"}, small_run::mesh());
    file.write(small_run::frame(0.25, 1), nullptr);
    file.close();
  }
  const auto whole = small_run::text_of(path);
  for (const char* name : {"/points/position", "/frames/state", "/frames/time"}) {
    post::write_atomically(path, whole);
    const auto [begin, bytes] = chunk_of(path, name);
    REQUIRE(bytes > 8);
    for (std::size_t i = begin; i < begin + bytes; ++i) {
      CAPTURE(name, i - begin);
      auto text = whole;
      text[i] ^= char(1 << i % 8);
      post::write_atomically(path, text);
      CHECK_THROWS_WITH(post::read_run(path), Catch::Contains("state.h5"));
    }
  }
}

TEST_CASE("what cannot be opened or read is an error with the path") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(post::StateFile({folder / "none/state.h5", "", "1"}, small_run::mesh()),
                    Catch::Contains("none/state.h5") && Catch::Contains("No such file"));
  CHECK_THROWS_WITH(post::read_run(folder / "state.h5"), Catch::Contains("state.h5"));
  post::write_atomically(folder / "state.h5", "not HDF5");
  CHECK_THROWS_WITH(post::read_run(folder / "state.h5"), Catch::Contains("state.h5"));
  post::StateFile({folder / "no_frames.h5", "", "1"}, small_run::mesh()).close();
  CHECK(post::read_run(folder / "no_frames.h5").times.empty());
}
