#include "post/files/vtk/series.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"
#include "tests/unit/post/xml.hpp"

using small_run::TemporaryFolder, small_run::text_of;

TEST_CASE("what ParaView reads is well-formed XML") {
  CHECK(xml::fault("<a>\n<b></a>") == "mismatched tag in line 2");
  CHECK(xml::fault(std::string("<a>\0</a>", 8)) == "not well-formed (invalid token) in line 1");
  const TemporaryFolder folder;
  post::VtkSeries(folder.path(), small_run::mesh()).write(small_run::frame(0.25, 3));
  post::write_cracks(folder / "cracks.vtp", {{{{{0, 1}, {2, 3}}, {0, 4}}}, {{0, 0, {2, 3}, {}}}});
  post::write_cracks(folder / "none.vtp", {});
  REQUIRE(folder.entries() == 4);
  for (const char* name : {"fields_0000.vtu", "fields.pvd", "cracks.vtp", "none.vtp"}) {
    INFO(name);
    CHECK(xml::fault(text_of(folder / name)) == "");
  }
}
