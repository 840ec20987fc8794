#include "post/report/html_data.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/catch.hpp"

TEST_CASE("tables become columns, without those that are empty") {
  const post::Table table{{"time", "name", "nothing"}, {{0.0, "a", {}}, {0.1, "b\"c", {}}}};
  const auto json = nlohmann::json::parse(post::table_json(table));
  CHECK(json == nlohmann::json{{"time", {0, 0.1}}, {"name", {"a", "b\"c"}}});
}

TEST_CASE("of many rows the first, the last and the largest are kept") {
  post::Table table{{"time", "K"}, {}};
  for (int i = 0; i <= 10000; ++i) table.rows.push_back({double(i), i == 777 ? 50.0 : std::sin(i)});
  const auto json = nlohmann::json::parse(post::table_json(table, 100));
  const std::vector<double> times = json["time"], K = json["K"];
  CHECK(times.size() <= 110);
  CHECK(times.front() == 0);
  CHECK(times.back() == 10000);
  CHECK(*std::ranges::max_element(K) == 50);
  CHECK(std::ranges::is_sorted(times));
}

TEST_CASE("of many rows in time all parts are kept alike") {
  post::Table table{{"time", "support", "force"}, {}};
  for (int i = 0; i < 1000; ++i)
    for (const char* name : {"left", "right", "loads"}) table.rows.push_back({double(i), name, std::sin(i)});
  for (const std::size_t most : {100, 500, 999, 1000, 1001, 1500}) {
    INFO(most);
    const auto json = nlohmann::json::parse(post::table_json(table, most));
    const std::vector<std::string> names = json["support"];
    std::vector<std::ptrdiff_t> counts;
    for (const char* name : {"left", "right", "loads"}) counts.push_back(std::ranges::count(names, name));
    CHECK(counts[0] >= std::ptrdiff_t(most / 6));
    CHECK(names.size() <= most + 9);
    CHECK(std::abs(counts[0] - counts[1]) <= 6);  // those of the extremes
    CHECK(std::abs(counts[0] - counts[2]) <= 6);
  }
}

TEST_CASE("the recommended method is the first of each time and tip") {
  const post::Table table{{"time", "tip", "method"},
                          {{0.0, 0.0, "a"}, {0.0, 0.0, "b"}, {0.0, 1.0, "b"}, {1.0, 1.0, "c"}, {1.0, 1.0, "a"}}};
  const auto found = post::recommended(table);
  REQUIRE(found.rows.size() == 3);
  CHECK(found.rows[0] == table.rows[0]);
  CHECK(found.rows[1] == table.rows[2]);
  CHECK(found.rows[2] == table.rows[3]);
  CHECK(post::columns_of(found, {"method", "absent"}).columns == std::vector<std::string>{"method"});
}
