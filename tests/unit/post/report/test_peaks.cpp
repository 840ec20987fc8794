#include "post/report/peaks.hpp"

#include <catch2/catch.hpp>

namespace {

post::Srif of(std::size_t tip, const std::string& method, double K1, double K2, bool resolves = true) {
  post::Srif srif;
  srif.tip = tip, srif.method = method, srif.K1 = K1, srif.K2 = K2, srif.resolved = {true, resolves, false};
  return srif;
}

}  // namespace

TEST_CASE("peaks: of each tip by its recommended method, with sign and time, what is not resolved left out") {
  const std::vector<std::vector<post::Srif>> rows{
      {of(0, "a", 1, 0), of(0, "b", 99, 99), of(1, "a", -1, 2)},
      {of(0, "a", -3, 0), of(0, "b", 99, 99), of(1, "a", 0.5, 8, false)},
      {of(0, "a", 2, 0), of(1, "a", 0.5, -3)},
  };
  const post::Table history{{"time", "max_abs_w"}, {{0.0, 0.1}, {0.5, 0.4}, {1.0, 0.3}}};
  const auto found = post::peaks({0, 0.5, 1}, rows, history);
  const auto check = [&](std::size_t i, const std::string& name, std::optional<std::size_t> tip, double value,
                         double time) {
    CHECK(found.at(i).quantity == name);
    CHECK(found[i].tip == tip);
    CHECK(found[i].value == value);
    CHECK(found[i].time == time);
  };
  REQUIRE(found.size() == 5);
  check(0, "K1", 0, -3, 0.5);
  check(1, "K2", 0, 0, 0);
  check(2, "K1", 1, -1, 0);
  check(3, "K2", 1, -3, 1);
  check(4, "w", std::nullopt, 0.4, 0.5);
  CHECK(post::peaks({}, {}, {{"time", "max_abs_w"}, {}}).size() == 1);
}

TEST_CASE("deflections beyond half a thickness are warned of") {
  const post::Table history{{"time", "max_abs_w"}, {{0.0, 0.0}, {0.5, 0.04}, {1.0, 0.01}}};
  CHECK(post::distrust_of_deflection(history, 0.1).empty());
  const auto found = post::distrust_of_deflection(history, 1e-3);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], Catch::Contains("0.04, is 40 thicknesses"));
}
