#include "cases/input/key_forms.hpp"
#include "tests/catch.hpp"

TEST_CASE("forms: a list of words leaves out what is unknown or named twice, and says so") {
  const cases::Words<int> words{{{"vtk", 0}, {"hdf5", 1}}};
  const auto root = toml::parse("fields = [\"vtk\", \"hdf\", \"vtk\", \"hdf5\"]");
  cases::Reading reading("a.toml");
  CHECK(cases::chosen(cases::Value(root["fields"].ref<toml::array>(), "fields", reading), words) == std::vector{0, 1});
  REQUIRE(reading.problems().size() == 2);
  CHECK_THAT(reading.problems()[0].what, Catch::Contains("did you mean 'hdf5'?"));
  CHECK_THAT(reading.problems()[1].what, Catch::Contains("named twice"));
}
