#include "post/manual/program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace {

using Catch::Contains;

const std::vector<post::ManualKey> keys{
    {"title", "-", "a string", "\"\"", "title"},
    {"section.young", "force/length^2", "a number > 0", "required", "modulus"},
    {"section.poisson", "-", "a number in (-1, 0.5)", "required", "ratio"},
    {"load[].kind", "-", "one of \"pressure\", \"point_force\"", "required", "what acts"},
    {"analysis.modes", "-", "an integer in [1, 1000]", "6", "how many"},
    {"analysis.time_step", "time", "\"auto\" or a number > 0", "\"auto\"", "step"},
    {"geometry.cracks", "length", "[ [[x, y], [x, y], ...], ... ]", "absent", "polylines"}};

const post::Program program{
    "plates",
    "1.0",
    "bends - plates",
    {{{"--version"}, "", "version"}},
    {{"run", ".runs", {{"case", "which", true}}, {{{"--set"}, "TEXT", "override"}, {{"--quiet"}, "", "it's quiet"}}},
     {"keys", "keys", {{"key", "part", false}}, {}}}};

}  // namespace

TEST_CASE("manual: every command, option and key stands in the page, and no text is taken for a request") {
  const auto page = post::man_page(program, keys);
  for (const char* part : {".TH PLATES 1", "\\fB\\-\\-set\\fR \\fITEXT\\fR", "\\fB\\-\\-quiet\\fR\n",
                           ".SS run \\fIcase\\fR", "[\\fIkey\\fR]", "\\&.runs", "section.young", ".SH EXIT STATUS"})
    CHECK_THAT(page, Contains(part));
}

TEST_CASE("completion: commands, options and keys; no other shells") {
  for (const char* shell : {"bash", "fish"}) {
    const auto script = post::completion(shell, program, keys, {"first", "hole"});
    for (const char* part : {"run", "quiet", "section.young", "load.0.kind", "first hole"})
      CHECK_THAT(script, Contains(part));
  }
  CHECK_THAT(post::completion("fish", program, keys, {}), Contains("it\\'s quiet"));
  CHECK_THROWS_AS(post::completion("csh", program, keys, {}), std::invalid_argument);
}

TEST_CASE("schema: types, bounds, words, tables and lists of tables of the key table") {
  const auto json = nlohmann::json::parse(post::schema("case", keys));
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
