#include "cases/input/problems.hpp"

#include <filesystem>
#include <fstream>

#include "tests/catch.hpp"

namespace fs = std::filesystem;

namespace {

/// The names in backticks on the lines of a source, without its comments; numbers in them are 0.
std::vector<std::string> names_in(const fs::path& path) {
  std::vector<std::string> result;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    line = line.substr(0, line.find("//"));
    for (auto begin = line.find('`'); begin != std::string::npos;) {
      const auto end = line.find('`', begin + 1);
      result.push_back(line.substr(begin + 1, end == std::string::npos ? end : end - begin - 1));
      if (const auto number = result.back().find("{}"); number != std::string::npos)
        result.back().replace(number, 2, "0");
      begin = end == std::string::npos ? end : line.find('`', end + 1);
    }
  }
  return result;
}

}  // namespace

TEST_CASE("problems: a key that was not given has the place of its nearest parent") {
  const cases::Source source{{{"", "a.toml"}, {"support", "a.toml:7"}, {"support[1].edges", "--set support[1].edges"}}};
  CHECK(source.place("support[1].edges") == "--set support[1].edges");
  CHECK(source.place("support[1].edges[2]") == "--set support[1].edges");
  CHECK(source.place("support[0].edges") == "a.toml:7");
  CHECK(source.place("section.young") == "a.toml");
}

TEST_CASE("problems: all of them in one message, a line each") {
  const cases::CaseError error({{"a.toml:1", "section.young", "is missing"}, {"b.toml", "", "no such file"}});
  CHECK(error.what() == std::string("a.toml:1: section.young: is missing\nb.toml: no such file"));
  CHECK(error.problems().size() == 2);
}

TEST_CASE("problems: settings that are named in backticks have their keys") {
  const cases::CaseError error({{"a.toml", "srif", "no room; set `spacing` = 0.1"}});
  CHECK(error.what() == std::string("a.toml: srif: no room; set discretization.spacing = 0.1"));
  CHECK(error.problems()[0].what == "no room; set discretization.spacing = 0.1");
}

TEST_CASE("setting names: the last part of a key, where no other key has it") {
  CHECK(cases::key_of_setting("spacing") == "discretization.spacing");
  CHECK(cases::key_of_setting("accuracy_seconds") == "srif.accuracy_seconds");
  CHECK(cases::key_of_setting("support_patch") == "support.on");
  for (const char* name : {"duration", "kind", "level", "spacings", "", "discretization"}) {
    INFO(name);
    CHECK_FALSE(cases::key_of_setting(name));
  }
}

TEST_CASE("setting names: lists and their entries") {
  CHECK(cases::key_of_setting("support") == "[[support]]");
  CHECK(cases::key_of_setting("support 12") == "support[12]");
  for (const char* name : {"support ", "support x", "support 1 2", "srif 1", "1"}) {
    INFO(name);
    CHECK_FALSE(cases::key_of_setting(name));
  }
}

TEST_CASE("setting names: keys stand in a message for the names in backticks, other text stays") {
  CHECK(cases::with_keys("set `spacing` or tip_spacing = 0.1") == "set discretization.spacing or tip_spacing = 0.1");
  CHECK(cases::with_keys("`support 0` and `support 1` hold it") == "support[0] and support[1] hold it");
  CHECK(cases::with_keys("`accuracy`") == "srif.accuracy");
  for (const char* same : {"", "`", "``", "edge `x` and `y`", "edge x` is held", "no room"})
    CHECK(cases::with_keys(same) == same);
  CHECK(cases::with_keys("edge 'x`' is off; set `spacing` = 1") == "edge 'x`' is off; set discretization.spacing = 1");
}

TEST_CASE("setting names: all that the folders below name have a key") {
  std::size_t found = 0;
  for (const char* folder : {"geometry", "plate", "post", "fracture"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(PDPLATE_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      for (const auto& name : names_in(entry.path())) {
        INFO(entry.path() << ": `" << name << "`");
        CHECK(cases::key_of_setting(name));
        ++found;
      }
    }
  CHECK(found > 20);
}
