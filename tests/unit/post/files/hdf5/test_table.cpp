#include <cmath>

#include "post/files/hdf5/state_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/files/hdf5/look.hpp"
#include "tests/unit/post/small_run.hpp"

TEST_CASE("tables in state.h5: columns of numbers and of words, with their units") {
  const small_run::TemporaryFolder folder;
  {
    post::StateFile file({folder / "state.h5", "", "1"}, small_run::mesh());
    file.write("reactions", {{"time", "support", "force", "moment_x", "moment_y", "strain_energy", "theta_x"},
                             {{0.5, "left", 1.0, 2.0, 3.0, post::Cell(), 4.0}}});
    file.write("odd",
               {{"mixed", "empty"}, {{"word", post::Cell()}, {0.1, post::Cell()}, {post::Cell(), post::Cell()}}});
    CHECK_THROWS(file.write("short", {{"a", "b"}, {{1.0}}}));
    file.close();
  }
  const hdf5_look::Look look(folder / "state.h5");
  const auto unit = [&](const std::string& column) {
    return look.text_attribute(("/tables/reactions/" + column).c_str(), "unit");
  };
  CHECK(unit("time") == "time");
  CHECK(unit("force") == "force");
  CHECK(unit("moment_x") == "force length");
  CHECK(unit("moment_y") == "force length");
  CHECK(unit("strain_energy") == "force length");
  CHECK(unit("theta_x") == "1");
  CHECK(std::isnan(look.numbers("/tables/reactions/strain_energy")[0]));
  CHECK(look.words("/tables/reactions/support") == std::vector<std::string>{"left"});
  CHECK(look.words("/tables/odd/mixed") == std::vector<std::string>{"word", "0.1", ""});
  CHECK(std::isnan(look.numbers("/tables/odd/empty")[2]));
}
