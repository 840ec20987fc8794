#include "cases/input/keys.hpp"

#include <sstream>

#include "tests/unit/cases/case_text.hpp"

namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("the table of keys in the guide is the program's") {
  std::string table = "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n";
  for (const auto& key : cases::keys())
    table += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.unit, key.allowed, key.standard, key.help);
  const auto guide = contents(std::filesystem::path(PDPLATE_SOURCE_DIR) / "cases" / "keys.md");
  CHECK_THAT(guide, Catch::Contains(table));
}

TEST_CASE("every key is documented once") {
  std::map<std::string, int> count;
  for (const auto& key : cases::keys()) {
    INFO(key.name);
    CHECK(++count[key.name] == 1);
    CHECK_FALSE(key.help.empty());
    CHECK_FALSE(key.allowed.empty());
    CHECK_FALSE(key.standard.empty());
  }
  CHECK(count.contains("support[].kind"));
  CHECK(count.contains("srif.normalize.width"));
}
