#pragma once
#include "cases/input/case_file.hpp"

#include <unistd.h>
#include <atomic>
#include <fstream>

#include "tests/catch.hpp"

/// Case files as text, for tests: written to a file of their own, read, removed.
namespace case_text {

/// A complete static case. Its lines are counted by the tests: section 1-4, geometry 5-7, discretization 8-9,
/// support 10-12, load 13-15, analysis 16-17.
inline const std::string plain = R"([section]
young = 1000.0
poisson = 0.3
thickness = 0.1
[geometry]
outline = { rectangle = [-1.0, -1.0, 1.0, 1.0] }
cracks = [[[-0.3, 0.0], [0.3, 0.0]]]
[discretization]
spacing = 0.05
[[support]]
kind = "clamped"
edges = ["left"]
[[load]]
kind = "pressure"
value = 1.0
[analysis]
kind = "static"
)";

/// The text with one of its lines replaced (lines count from 1).
inline std::string with_line(std::string text, int line, const std::string& replacement) {
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) begin = text.find('\n', begin) + 1;
  return text.replace(begin, text.find('\n', begin) - begin, replacement);
}

/// A plate that moves for 0.4, with a probe far from its support; `more`: lines of its analysis.
inline std::string probed_motion(const std::string& more = "") {
  std::string text = plain;
  text.replace(text.find("kind = \"static\""), 15, "kind = \"dynamic\"\nduration = 0.4\n" + more);
  text.insert(text.find("thickness"), "density = 1.0\n");
  return text + "[srif]\n[output]\nfields = []\nprobes = { far = [0.9, 0.0] }\n";
}

class File {
public:
  explicit File(const std::string& text) {
    static std::atomic<int> count{0};
    path_ = std::filesystem::temp_directory_path() /
            ("case_file_test_" + std::to_string(getpid()) + "_" + std::to_string(count++) + ".toml");
    std::ofstream(path_) << text;
  }
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

inline cases::CaseFile read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const File file(text);
  return cases::read_case(file.path(), overrides);
}

/// The problems of a text, with the file's name removed from their places: ":12", "--set KEY".
inline std::vector<cases::Problem> problems(const std::string& text, const std::vector<std::string>& overrides = {},
                                            bool distributed = false) {
  const File file(text);
  try {
    cases::read_case(file.path(), overrides, distributed);
  } catch (const cases::CaseError& error) {
    auto found = error.problems();
    for (auto& problem : found)
      if (problem.place.starts_with(file.path().string())) problem.place.erase(0, file.path().string().size());
    return found;
  }
  return {};
}

/// The text has exactly one problem, with this place, key and part of what is said.
inline void expect(const std::string& text, const std::string& place, const std::string& key, const std::string& what,
                   const std::vector<std::string>& overrides = {}) {
  INFO(text);
  const auto found = problems(text, overrides);
  for (const auto& problem : found) UNSCOPED_INFO(problem.place << " " << problem.key << " " << problem.what);
  REQUIRE(found.size() == 1);
  CHECK(found[0].place == place);
  CHECK(found[0].key == key);
  CHECK_THAT(found[0].what, Catch::Contains(what));
}

}  // namespace case_text
