#pragma once

#include "case_text.hpp"
#include "cases/driver/run.hpp"
#include "cases/studies/study.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

/// Study files as text, for tests.
namespace studies {

/// Of 400 points bonded over a horizon.
inline const std::string fast =
    "set = [\"analysis.method=cg\", \"output.fields=[]\", \"discretization.spacing=0.1\", "
    "\"discretization.formulation=ordinary\"]\n";
inline const std::string cracked = case_text::plain +
                                   "[srif]\nmethods = [\"displacement_extrapolation\"]\nwindow = 0.5\nnormalize = { "
                                   "moment = 1.0 }\nhalf_length = 0.3\n[output.probes]\n";

/// A study and two cases beside it: a.toml with a crack and without probes, b.toml with the probe "far" too.
class Studies {
public:
  Studies() {
    write("a.toml", cracked);
    write("b.toml", cracked + "far = [0.9, 0.0]\n");
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  cases::Study read(const std::string& text) const {
    write("study.toml", text);
    return cases::read_study(folder_ / "study.toml");
  }
  /// "PLACE KEY: WHAT" of all problems, the folder left out of the places.
  std::vector<std::string> problems(const std::string& text) const {
    std::vector<std::string> found;
    try {
      read(text);
    } catch (const cases::CaseError& error) {
      for (auto [place, key, what] : error.problems()) {
        const std::string folder = folder_.path().string() + "/";
        if (place.starts_with(folder)) place.erase(0, folder.size());
        found.push_back(place + " " + key + ": " + what);
      }
    }
    return found;
  }
  std::filesystem::path out() const { return folder_ / "out"; }

private:
  small_run::TemporaryFolder folder_;
};

inline void expect(const std::vector<std::string>& found, const std::vector<std::string>& expected) {
  for (const auto& problem : found) UNSCOPED_INFO(problem);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK_THAT(found[i], Catch::Contains(expected[i]));
}

inline std::string axis(const std::string& name, const std::vector<std::string>& points) {
  std::string text = "[[axis]]\nname = \"" + name + "\"\n";
  for (const auto& point : points) text += "[[axis.point]]\n" + point + "\n";
  return text;
}

inline std::string reference(const std::string& lines) {
  return "[[reference]]\n" + lines + "\n";
}

inline std::string short_axis(const std::string& name, const std::string& key, const std::string& values) {
  return "[[axis]]\nname = \"" + name + "\"\nkey = \"" + key + "\"\nvalues = " + values + "\n";
}

/// The case of b.toml in time.
inline std::string dynamic_case() {
  std::string text = case_text::with_line(cracked, 17, "kind = \"dynamic\"\nduration = 0.2");
  text = case_text::with_line(text, 4, "thickness = 0.1\ndensity = 1.0");
  return text + "far = [0.9, 0.0]\n";
}

}  // namespace studies
