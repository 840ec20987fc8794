#include "post/files/vtk_series.hpp"

#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder, small_run::text_of;

TEST_CASE("fields.pvd lists every frame with its time") {
  const TemporaryFolder folder;
  post::VtkSeries series(folder.path(), small_run::mesh());
  series.write(small_run::frame(0, 0));
  series.write(small_run::frame(1e-5, 1));
  const std::string text = text_of(folder / "fields.pvd");
  CHECK_THAT(text, Catch::Contains("timestep=\"0\" part=\"0\" file=\"fields_0000.vtu\""));
  CHECK_THAT(text, Catch::Contains("timestep=\"1e-05\" part=\"0\" file=\"fields_0001.vtu\""));
  CHECK_THAT(text, Catch::EndsWith("</VTKFile>\n"));
  CHECK(folder.entries() == 3);
}

TEST_CASE("cracks that change are a series beside the fields") {
  const TemporaryFolder folder;
  post::VtkSeries series(folder.path(), small_run::mesh());
  for (const double time : {0.0, 0.5}) {
    auto frame = small_run::frame(time, 0);
    frame.cracks = post::Cracks{{{{{0, 0}, {1, time}}, {0, time}}}, {}};
    series.write(frame);
  }
  CHECK_THAT(text_of(folder / "cracks.pvd"), Catch::Contains("timestep=\"0.5\" part=\"0\" file=\"cracks_0001.vtp\""));
  CHECK(folder.entries() == 6);
}
