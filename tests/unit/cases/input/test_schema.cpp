#include <nlohmann/json.hpp>

#include "cases/input/keys.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/input/small_program.hpp"

using small_program::keys;

TEST_CASE("schema: types, bounds, words, tables and lists of tables of the key table") {
  const auto json = nlohmann::json::parse(cases::schema("case", keys));
  const auto& all = json.at("properties");
  CHECK(all.at("title").at("type") == "string");
  CHECK(all.at("section").at("properties").at("young").at("exclusiveMinimum") == 0);
  const auto& poisson = all.at("section").at("properties").at("poisson");
  CHECK(poisson.at("exclusiveMinimum") == -1);
  CHECK(poisson.at("exclusiveMaximum") == 0.5);
  CHECK(all.at("load").at("type") == "array");
  CHECK(all.at("load").at("items").at("properties").at("kind").at("enum").size() == 2);
  CHECK(all.at("analysis").at("properties").at("modes").at("type") == "integer");
  CHECK(all.at("analysis").at("properties").at("modes").at("maximum") == 1000);
  CHECK(all.at("analysis").at("properties").at("time_step").at("anyOf").size() == 2);
  CHECK(all.at("geometry").at("properties").at("cracks").at("items").at("items").at("maxItems") == 2);
  CHECK(all.at("section").at("additionalProperties") == false);
}

TEST_CASE("schema: cracks are polylines or tables") {
  const auto json = nlohmann::json::parse(cases::schema("case", cases::keys()));
  const auto& crack = json.at("properties").at("geometry").at("properties").at("cracks").at("items").at("anyOf");
  CHECK(crack.at(0).at("items").at("maxItems") == 2);
  CHECK(crack.at(1).at("properties").at("arc").at("minItems") == 5);
  CHECK(crack.at(1).at("properties").at("file").at("type") == "string");
  CHECK(crack.at(1).at("additionalProperties") == false);
}
