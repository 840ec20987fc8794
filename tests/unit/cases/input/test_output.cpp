#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("output is checked") {
  const auto output = [](const std::string& lines) { return plain + "[output]\n" + lines + "\n"; };
  expect(output("fields = [\"vtk\", \"hdf\"]"), ":19", "output.fields", "did you mean 'hdf5'?");
  expect(output("probes = { far = [3, 0] }"), ":19", "output.probes.far", "[3, 0] given");
  expect(output("probes = { far = 3 }"), ":19", "output.probes.far", "[x, y]");
}
