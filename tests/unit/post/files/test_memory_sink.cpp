#include "post/files/sinks.hpp"
#include "tests/catch.hpp"

using namespace post;

namespace {

/// Two points, and a frame of them whose numbers tell component and point.
Mesh mesh() {
  Mesh result;
  result.positions = {{0, 1}, {2, 3}};
  result.areas = {0.5, 0.25};
  result.cut = {0, 1};
  result.triangles = {{0, 1, 1}};
  return result;
}

Frame sunk_frame(double time) {
  Frame result{time, 7, plate::State(3, 2), {}, {0, 0.5}};
  result.state << 1, 2, 10, 20, 100, 200;
  result.resultants.moments = Eigen::Matrix3Xd::Constant(3, 2, 4);
  result.resultants.moments(2, 0) = 5;
  result.resultants.shear = Eigen::Matrix2Xd::Zero(2, 2);
  result.resultants.von_mises = Eigen::Vector2d(8, 9);
  return result;
}

using Numbers = std::vector<double>;

}  // namespace

TEST_CASE("what is kept has a row per point, whatever the order in memory was") {
  ResultsInMemory kept;
  MemorySink sink(kept);
  sink.open(mesh());
  sink.frame(sunk_frame(0.5), {}, {});
  REQUIRE(kept.frames.size() == 1);
  const auto& [time, arrays, quads, triangles] = kept.frames.front();
  CHECK(time == 0.5);
  CHECK(arrays.at("w").values == Numbers{1, 2});
  CHECK(arrays.at("theta").values == Numbers{10, 100, 20, 200});
  CHECK(arrays.at("theta").width == 2);
  CHECK(arrays.at("moments").values == Numbers{4, 4, 5, 4, 4, 4});
  CHECK(arrays.at("x").values == Numbers{0, 1, 2, 3});
  CHECK(arrays.at("damage").values == Numbers{0, 0.5});
  CHECK(arrays.at("von_mises").values == Numbers{8, 9});
  CHECK(triangles == std::vector<std::uint32_t>{0, 1, 1});
  CHECK(quads.empty());
}

TEST_CASE("corners of cells stand after the points, without area") {
  ResultsInMemory kept;
  MemorySink sink(kept);
  auto cornered = mesh();
  cornered.corners = {{{4, 5}, {{0, -0.5, 0.5}, {1, 1.5, 0.5}}}};  // beyond the second point; a mean of both
  sink.frame(sunk_frame(0), cornered, {});
  const auto& arrays = kept.frames.front().arrays;
  CHECK(arrays.at("x").values == Numbers{0, 1, 2, 3, 4, 5});
  CHECK(arrays.at("w").values == Numbers{1, 2, 2.5});
  CHECK(arrays.at("von_mises").values == Numbers{8, 9, 8.5});
  CHECK(arrays.at("area").values.back() == 0);
}

TEST_CASE("a frame that brings its cells has them, and so have those after it") {
  ResultsInMemory kept;
  MemorySink sink(kept);
  auto other = mesh();
  other.quads = {{0, 1, 1, 0}};
  sink.frame(sunk_frame(0), other, {});
  sink.frame(sunk_frame(1), {}, {});
  CHECK(kept.frames[0].quads.size() == 4);
  CHECK(kept.frames[1].quads == kept.frames[0].quads);
}

TEST_CASE("tables and cracks are kept as they are") {
  ResultsInMemory kept;
  kept.wants_fields = false;
  MemorySink sink(kept);
  CHECK_FALSE((sink.draws() || sink.stores() || sink.plots()));
  const Table table{{"a", "b"}, {{1.0, std::string("word")}, {{}, std::string()}}};
  sink.tables({{"history", &table}});
  Cracks cracks;
  cracks.lines.push_back({{{0, 1}, {2, 3}}, {0, 0}});
  sink.cracks(cracks);
  sink.summary("{}");
  CHECK(kept.tables.front().first == "history");
  CHECK(kept.tables.front().second.rows == table.rows);
  CHECK(kept.cracks.front().values == Numbers{0, 1, 2, 3});
  CHECK(kept.summary == "{}");
}
