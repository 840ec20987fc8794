#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("intensity factors need tips and a whole normalisation") {
  const auto srif = [](const std::string& lines) { return plain + "[srif]\n" + lines + "\n"; };
  CHECK(problems(srif("")).empty());
  expect(with_line(srif(""), 7, ""), ":18", "srif", "no crack tip");
  expect(srif("normalize = { moment = 1 }"), ":18", "srif.half_length", "is missing");
  expect(srif("half_length = 1"), ":19", "srif.half_length", "with normalize only");
  expect(srif("normalize = { pressure = 1 }\nhalf_length = 1"), ":19", "srif.normalize", "either { pressure");
  expect(srif("normalize = { pressure = 1, width = 1, moment = 1 }\nhalf_length = 1"), ":19", "srif.normalize",
         "either { pressure");
  expect(srif("rows = 3"), ":19", "srif.rows", "an integer in [1, 2]");
  expect(srif("window = 0.1\nwindow_horizons = 2"), ":20", "srif.window_horizons", "beside 'window'");
}
