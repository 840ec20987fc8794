#include "post/files/vtk/series.hpp"
#include "post/files/whole_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder, small_run::text_of;

namespace {

/// The text with every `from` as `to`, which is as long.
std::string with(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from)) text.replace(at, from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("a frame that is read is the one that was written") {
  const TemporaryFolder folder;
  const auto frame = small_run::frame(0.25, 3);
  post::VtkSeries(folder.path(), small_run::mesh()).write(frame);
  const auto [mesh, read] = post::read_frame(folder / "fields_0000.vtu");
  CHECK(mesh.positions == small_run::mesh().positions);
  CHECK(mesh.quads == small_run::mesh().quads);
  CHECK(mesh.triangles == small_run::mesh().triangles);
  CHECK(read.time == 0.25);
  CHECK(read.state == frame.state);
  CHECK(read.damage == frame.damage);
  CHECK(read.resultants.moments == frame.resultants.moments);
  CHECK(read.resultants.von_mises == frame.resultants.von_mises);
}

TEST_CASE("what is no frame, or lacks a part of one, is an error with the path") {
  const TemporaryFolder folder;
  const auto path = folder / "fields_0000.vtu";
  CHECK_THROWS_WITH(post::read_frame(path), Catch::Contains("fields_0000.vtu"));
  post::VtkSeries(folder.path(), small_run::mesh()).write(small_run::frame(0, 0));
  const auto text = text_of(path);
  post::write_whole(path, with(text, "Name=\"theta\"", "Name=\"thetb\""));
  CHECK_THROWS_WITH(post::read_frame(path), Catch::Contains("no w and theta"));
  post::write_whole(path, with(text, "Name=\"Mxy\"", "Name=\"Mab\""));
  CHECK_THROWS_WITH(post::read_frame(path), Catch::Contains("von_mises without the moments"));
  post::write_whole(path, with(text, "Name=\"von_mises\"", "Name=\"von_misez\""));
  CHECK(post::read_frame(path).frame.resultants.von_mises.size() == 0);
  post::write_whole(path, "not a frame");
  CHECK_THROWS_WITH(post::read_frame(path), Catch::Contains("fields_0000.vtu"));
}
