#pragma once
#include "cases/studies/extremes.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

namespace extremes_table {

/// A table beside the case a.toml, a plate of 20 x 20 points with the probe "far".
class Table {
public:
  explicit Table(const std::string& rows) {
    std::ofstream(folder_ / "a.toml") << case_text::with_line(case_text::plain, 9,
                                                              "spacing = 0.1\nformulation = \"ordinary\"") +
                                             "method = \"cg\"\n[output]\nfields = []\nprobes = { far = [0.9, 0.0] }\n";
    std::ofstream(folder_ / "t.toml") << rows;
  }
  cases::Extremes read() const { return cases::read_extremes(folder_ / "t.toml"); }
  std::vector<cases::Verdict> run(const std::string& only = "", const std::vector<std::string>& set = {}) const {
    return cases::run_extremes(read(), {folder_ / "out", set, only, true});
  }
  std::filesystem::path csv() const { return folder_ / "out" / "extremes.csv"; }

private:
  small_run::TemporaryFolder folder_;
};

inline std::string row(const std::string& title, const std::string& lines) {
  return "[[row]]\ngroup = \"g\"\ntitle = \"" + title + "\"\ncase = \"a.toml\"\n" + lines + "\n";
}

inline const std::string w = "quantity = \"w\", probe = \"far\", ";

}  // namespace extremes_table
