#include "fracture/growth/record.hpp"

#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

TEST_CASE("record: what a growth does not have stays empty, and each row has a cell for every column") {
  fracture::Record record;
  record.add(fracture::GrowthRow{2, {}, 0.5, 3.0});
  fracture::TipRow tip{2, {}, 1};
  tip.reached = "'left'";
  record.add(tip);
  REQUIRE(record.growth.rows.size() == 1);
  CHECK(record.growth.rows[0].size() == record.growth.columns.size());
  CHECK(record.tips.rows[0].size() == record.tips.columns.size());
  CHECK(record.growth.rows[0][record.growth.column("load_factor")] == post::Cell(0.5));
  CHECK(record.growth.rows[0][record.growth.column("time")] == post::Cell());
  CHECK(record.tips.rows[0][record.tips.column("reached")] == post::Cell("'left'"));
  CHECK(record.tips.rows[0][record.tips.column("G")] == post::Cell());
}

TEST_CASE("record: tips have membrane factors where loads act in the plane") {
  fracture::Record record;
  record.acts_in_plane();
  record.add({.advance = 1, .N1 = 2.0, .face = "z<0"});
  record.add(fracture::TipRow{2});
  for (const auto& row : record.tips.rows) CHECK(row.size() == record.tips.columns.size());
  CHECK(record.tips.rows[0][record.tips.column("N1")] == post::Cell(2.0));
  CHECK(record.tips.rows[0][record.tips.column("face")] == post::Cell("z<0"));
  CHECK(record.tips.rows[1][record.tips.column("N2")] == post::Cell());
}

TEST_CASE("record: vertices of cracks by advance, or by time in motion") {
  fracture::Record record;
  record.cracks.lines = {{{{0, 0}, {1, 0}}, {0, 4}}};
  CHECK(record.crack_table().rows[1][4] == post::Cell(4.0));
  CHECK(record.crack_table().rows[1][5] == post::Cell());
  record.in_motion = true;
  CHECK(record.crack_table().rows[1][4] == post::Cell());
  CHECK(record.crack_table().rows[1][5] == post::Cell(4.0));
}

TEST_CASE("record: where something presses or holds, and cracks have grown through it") {
  plate::Problem problem;
  problem.discretization.spacing = 0.1;
  problem.impact.emplace().position = {0.5, 0.05};
  problem.springs.emplace_back().position = geometry::Point(0.2, 0.3);
  problem.supports.emplace_back().points = {{0.5, -0.2}, {2, 0.01}};
  problem.loads = {plate::Load{plate::PointForce{.position = {0.9, 0}}}};
  fracture::Record record;
  record.cracks.lines.push_back({{{0, 0}, {1, 0}}, {0, 0}});
  const auto said = record.cut_places(problem);
  REQUIRE(said.size() == 2);
  CHECK_THAT(said[0], Catch::StartsWith("a crack runs through (0.5, 0.05), where a mass hits"));
  CHECK_THAT(said[1], Catch::StartsWith("a crack runs through (0.9, 0), where a force acts"));
}
