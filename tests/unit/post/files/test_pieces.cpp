#include "post/files/vtk_series.hpp"

#include <regex>
#include <set>

#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder, small_run::text_of;

namespace {

/// Name and components of every array of points.
std::set<std::pair<std::string, std::string>> arrays(const std::string& text, const std::string& element) {
  const auto begin = text.find("PointData"), end = text.rfind("PointData>");
  const std::string within = text.substr(begin, end - begin);
  const std::regex array("<" + element + " type=\"Float64\" Name=\"(\\w+)\"([^>]*)");
  const std::regex components("NumberOfComponents=\"(\\d)\"");
  std::set<std::pair<std::string, std::string>> found;
  for (std::sregex_iterator one(within.begin(), within.end(), array), none; one != none; ++one) {
    std::smatch number;
    const std::string rest = (*one)[2];
    found.emplace((*one)[1], std::regex_search(rest, number, components) ? number[1].str() : "1");
  }
  return found;
}

}  // namespace

TEST_CASE("pieces: every process writes one, and one file names them and what they hold") {
  const TemporaryFolder folder;
  thread_ranks::run(2, [&](const plate::Communicator& all) {
    post::VtkSeries pieces(folder.path(), small_run::mesh(), all);
    pieces.write(small_run::frame(0, 0));
    pieces.write(small_run::frame(0.5, 1));
  });
  CHECK(folder.entries() == 7);
  const std::string together = text_of(folder / "fields_0001.pvtu");
  CHECK_THAT(together, Catch::Contains("<Piece Source=\"fields_0001_0.vtu\"/>"));
  CHECK_THAT(together, Catch::Contains("<Piece Source=\"fields_0001_1.vtu\"/>"));
  const auto named = arrays(together, "PDataArray");
  CHECK(named.size() == 11);
  CHECK((named == arrays(text_of(folder / "fields_0001_1.vtu"), "DataArray")));
  CHECK_THAT(text_of(folder / "fields.pvd"), Catch::Contains("timestep=\"0.5\" part=\"0\" file=\"fields_0001.pvtu\""));
  CHECK(post::frames_in(folder.path()).empty());
}

TEST_CASE("pieces: the list names membrane forces where there are any") {
  const TemporaryFolder folder;
  thread_ranks::run(2, [&](const plate::Communicator& all) {
    auto frame = small_run::frame(0, 0);
    frame.in_plane = post::InPlaneFields{Eigen::Matrix2Xd::Zero(2, frame.state.cols()),
                                         Eigen::Matrix3Xd::Zero(3, frame.state.cols())};
    post::VtkSeries(folder.path(), small_run::mesh(), all).write(frame);
  });
  const auto named = arrays(text_of(folder / "fields_0000.pvtu"), "PDataArray");
  CHECK(named.size() == 14);
  CHECK((named == arrays(text_of(folder / "fields_0000_1.vtu"), "DataArray")));
}

TEST_CASE("pieces: points of others that only corners need are no cells") {
  const TemporaryFolder folder;
  auto mesh = small_run::mesh();
  const auto cells = [&](const char* name) {
    post::VtkSeries(folder / name, mesh).write(small_run::frame(0, 0));
    const std::string text = text_of(folder / name / "fields_0000.vtu");
    std::smatch number;
    REQUIRE(std::regex_search(text, number, std::regex("NumberOfCells=\"(\\d+)\"")));
    return std::stoi(number[1]);
  };
  std::filesystem::create_directory(folder / "all"), std::filesystem::create_directory(folder / "less");
  mesh.quads.clear(), mesh.triangles.clear();  // every point is a cell
  const int all = cells("all");
  CHECK(all == int(mesh.positions.size() + mesh.corners.size()));
  mesh.others = 1;
  CHECK(cells("less") == all - 1);
}
