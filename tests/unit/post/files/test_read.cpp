#include "post/files/atomic_file.hpp"
#include "post/files/vtk_series.hpp"
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
  post::write_atomically(path, with(text, "Name=\"theta\"", "Name=\"thetb\""));
  CHECK_THROWS_WITH(post::read_frame(path), Catch::Contains("fields_0000.vtu: no theta"));
  post::write_atomically(path, with(text, "Name=\"Mxy\"", "Name=\"Mab\""));
  CHECK_THROWS_WITH(post::read_frame(path), Catch::Contains("no Mxy"));
  post::write_atomically(path, with(text, "vtkZLibDataCompressor", "vtkLZ4DataCompressor "));
  CHECK_THROWS_WITH(post::read_frame(path), Catch::Contains("not written by this version"));
  post::write_atomically(path, "not a frame");
  CHECK_THROWS_WITH(post::read_frame(path), Catch::Contains("fields_0000.vtu"));
}

TEST_CASE("a frame with a changed character is refused, or is the one that was written") {
  const TemporaryFolder folder;
  const auto path = folder / "fields_0000.vtu";
  const auto frame = small_run::frame(0.25, 3);
  const auto mesh = small_run::mesh();
  post::VtkSeries(folder.path(), mesh).write(frame);
  const auto text = text_of(path);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    auto changed = text;
    changed[i] = text[i] == 'A' ? 'B' : 'A';
    std::ofstream(path, std::ios::binary) << changed;
    INFO("character " << i << ", " << text[i]);
    try {
      const auto [cells, read] = post::read_frame(path);
      CHECK(((cells.positions == mesh.positions && cells.quads == mesh.quads && cells.triangles == mesh.triangles)));
      CHECK((read.time == frame.time && read.state == frame.state && read.damage == frame.damage));
      CHECK(read.resultants.moments == frame.resultants.moments);
      CHECK(read.resultants.von_mises == frame.resultants.von_mises);
    } catch (const std::runtime_error& error) {
      CHECK_THAT(error.what(), Catch::Contains("fields_0000.vtu: "));
      ++refused;
    }
  }
  CHECK(refused > text.size() / 2);
}
