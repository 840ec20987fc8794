#include "tests/catch.hpp"
#include "tests/unit/cases/input/small_program.hpp"

using Catch::Contains;
using small_program::keys, small_program::program;

TEST_CASE("manual: every command, option and key stands in the page, and no text is taken for a request") {
  const auto page = cases::man_page(program, keys);
  for (const char* part : {".TH PLATES 1", "\\fB\\-\\-set\\fR \\fITEXT\\fR", "\\fB\\-\\-quiet\\fR\n",
                           ".SS run \\fIcase\\fR", "[\\fIkey\\fR]", "\\&.runs", "section.young", ".SH EXIT STATUS"})
    CHECK_THAT(page, Contains(part));
}
