#include "post/report/html_data.hpp"

#include <nlohmann/json.hpp>

#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

TEST_CASE("a drawing has the edges, holes, cracks, supports and loads of its plate") {
  plate::Problem problem;
  problem.outline = geometry::rectangle(-1, -2, 3, 4);
  problem.outline.holes = {geometry::Circle{{0, 0}, 0.5, "hole0"},
                           geometry::Polygon{{{1, 1}, {1, 2}, {2, 2}}, {"hole1", "hole1", "hole1"}}};
  problem.cracks = {{{0.5, 0}, {1, 0}}};
  problem.supports = {{plate::SupportKind::clamped, {"left"}, {}}, {plate::SupportKind::pinned, {}, {{2, 3}}}};
  const plate::Load moment{plate::EdgeMoment{.edges = {"top"}, .tensor = {{1, 2, 3}}}};
  const plate::Load force{plate::PointForce{.position = {0.25, 0.75}, .value = -7},
                          {plate::History::Kind::ramp, 0.1, 0, {}}};
  problem.loads = {moment, force};
  const auto json = nlohmann::json::parse(post::plate_json(problem));
  CHECK(json["outline"].size() == 4);
  CHECK(json["edges"].size() == 4 + 3);
  CHECK(json["holes"][0]["radius"] == 0.5);
  CHECK(json["holes"][1]["vertices"].size() == 3);
  CHECK(json["cracks"][0] == nlohmann::json{{0.5, 0}, {1, 0}});
  CHECK(json["supports"][0]["kind"] == "clamped");
  CHECK(json["supports"][1]["points"][0] == nlohmann::json{2, 3});
  CHECK(json["loads"][0]["tensor"] == nlohmann::json{1, 2, 3});
  CHECK_FALSE(json["loads"][0].contains("position"));
  CHECK(json["loads"][1]["position"] == nlohmann::json{0.25, 0.75});
  CHECK(json["loads"][1]["history"] == "rising over 0.1");
}
