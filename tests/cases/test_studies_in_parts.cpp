// Studies that are made in parts, by processes that end as they like, through the program itself.
#include <fstream>
#include <map>
#include <sstream>

#include "tests/cases/program.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

namespace fs = std::filesystem;
using program_run::Ended, program_run::program, program_run::command, program_run::shell;
using small_run::TemporaryFolder, small_run::text_of;

namespace {

/// Six runs of some 20 ms. With `long_one` the fourth moves until it is killed, the others are at rest.
class SmallStudy {
public:
  explicit SmallStudy(bool long_one = false) {
    std::ofstream(scratch_ / "plate.toml") << case_text::plain << "[output]\nfields = []\n";
    std::ofstream(scratch_ / "study.toml") << text(long_one, "1000");
  }
  static std::string text(bool long_one, const std::string& young) {
    const std::string last =
        long_one ? "set = [\"analysis.kind=dynamic\", \"analysis.duration=1e6\", \"section.density=1\", "
                   "\"analysis.method=central_difference\", \"discretization.formulation=ordinary\"]\n"
                 : "";
    return "case = \"plate.toml\"\nset = [\"section.young=" + young +
           "\"]\n[[axis]]\nname = \"support\"\n[[axis.point]]\nlabel = \"one edge\"\n[[axis.point]]\nlabel = \"two "
           "edges\"\n" +
           last +
           "[[axis]]\nname = \"spacing\"\nkey = \"discretization.spacing\"\nvalues = [0.2, 0.1, 0.05]\n"
           "[[reference]]\nquantity = \"strain_energy\"\nfinest = true\n";
  }
  fs::path file() const { return scratch_ / "study.toml"; }
  fs::path out(const std::string& name) const { return scratch_ / name; }
  std::vector<std::string> arguments(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> all{"study", file().string(), "--out", this->out(out).string(), "--threads", "1"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Ended run(const std::string& out, const std::vector<std::string>& more = {}) const {
    return program(arguments(out, more));
  }

private:
  TemporaryFolder scratch_;
};

/// A table without the columns of times and of what was measured against them. No cell of it has a comma or two lines.
std::string without_times(const fs::path& csv) {
  std::istringstream lines(text_of(csv));
  std::vector<bool> kept;
  std::string result;
  for (std::string line; std::getline(lines, line); result += '\n') {
    std::istringstream cells(line + ",");
    const bool is_header = result.empty();
    std::size_t column = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (is_header) kept.push_back(cell.find("seconds") == std::string::npos);
      REQUIRE(column < kept.size());
      if (kept[column]) result += cell + ",";
    }
    REQUIRE(column == kept.size());
  }
  return result;
}

/// Two folders of one study hold the same: tables but for times, drawings that show none, and files of equal names.
void check_same(const fs::path& one, const fs::path& other) {
  for (const char* name : {"study.csv", "runs.csv", "orders.csv"}) {
    INFO(name);
    CHECK(without_times(one / name).size() > 100);
    CHECK(without_times(one / name) == without_times(other / name));
  }
  const auto files = [](const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      names.push_back(fs::relative(entry.path(), folder).string());
    std::sort(names.begin(), names.end());
    return names;
  };
  CHECK(files(one) == files(other));
  CHECK(text_of(one / "error_against_points.svg") == text_of(other / "error_against_points.svg"));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++found;
  return found;
}

}  // namespace

TEST_CASE("parts of a study: side by side they make what an undivided study makes") {
  const SmallStudy study;
  REQUIRE(study.run("whole").exit_code == 0);
  std::string lines, ends = "true";
  for (const std::string part : {"1", "2", "3"}) {
    lines += command(study.arguments("parts", {"--part", part + "/3"})) + " &\npart" + part + "=$!\n";
    ends += " && wait $part" + part;
  }
  const auto parts = shell(lines + ends);
  INFO(parts.output);
  REQUIRE(parts.exit_code == 0);
  CHECK(count(parts.output, "of 6 runs") == 3);
  CHECK(count(parts.output, "done before") == 0);
  CHECK_FALSE(fs::exists(study.out("parts") / "study.csv"));
  const auto merged = study.run("parts", {"--merge"});
  INFO(merged.output);
  CHECK(merged.exit_code == 0);
  check_same(study.out("whole"), study.out("parts"));

  const auto again = study.run("parts", {"--part", "1/1"});  // another division finds all of them
  CHECK(again.exit_code == 0);
  CHECK(count(again.output, "done before") == 6);
  CHECK(count(study.run("parts").output, "done before") == 6);  // and so does the undivided study
  CHECK(count(study.run("parts", {"--part", "2/3", "--again"}).output, "done before") == 0);
  CHECK(study.run("parts", {"--merge"}).exit_code == 0);
}

TEST_CASE("parts of a study: what no part has made, or with other settings, is missing, and exit code 5") {
  const SmallStudy study;
  CHECK(study.run("parts", {"--merge"}).exit_code == 2);
  CHECK_FALSE(fs::exists(study.out("parts")));
  REQUIRE(study.run("parts", {"--part", "1/3"}).exit_code == 0);
  REQUIRE(study.run("parts", {"--part", "3/3"}).exit_code == 0);
  auto merged = study.run("parts", {"--merge"});
  INFO(merged.output);
  CHECK(merged.exit_code == 5);
  CHECK(merged.output.find("1 of 6 runs are missing") != std::string::npos);
  const auto table = text_of(study.out("parts") / "study.csv");  // the finest of one support: that has no errors
  CHECK(count(table, ",missing,not made to its end") == 1);
  CHECK(count(table, "the finest is missing") == 2);
  CHECK(count(table, "finest: 0.05") == 2);
  REQUIRE(study.run("parts", {"--part", "2/3"}).exit_code == 0);
  CHECK(study.run("parts", {"--merge"}).exit_code == 0);
  REQUIRE(study.run("whole").exit_code == 0);
  check_same(study.out("whole"), study.out("parts"));

  std::ofstream(study.file()) << SmallStudy::text(false, "2000");
  merged = study.run("parts", {"--merge"});
  CHECK(merged.exit_code == 5);
  CHECK(count(text_of(study.out("parts") / "study.csv"), "made with other settings") == 6);
  CHECK(count(study.run("parts", {"--part", "2/3"}).output, "done before") == 0);
  CHECK(study.run("parts", {"--merge"}).output.find("5 of 6 runs are missing") != std::string::npos);
}

TEST_CASE("parts of a study: a part that is killed harms nothing, and the same part goes on") {
  const SmallStudy study(true);
  const auto out = study.out("parts").string();
  const auto part = command(study.arguments("parts", {"--part", "1/1"}));
  // Killed while its fourth run moves; a second process of the same part meanwhile, an undivided study, a merge.
  const auto ended =
      shell(part + " &\nfirst=$!\nfor i in $(seq 500); do [ -e " + out +
            "/two_edges_0.2/case.resolved.toml ] && break; sleep 0.02; done\n" + part + "\necho code $?\n" +
            command(study.arguments("parts", {})) + "\necho code $?\n" +
            command(study.arguments("parts", {"--merge"})) + "\necho code $?\nkill -9 $first\nwait $first");
  INFO(ended.output);
  CHECK(ended.exit_code == 137);
  CHECK(count(ended.output, "code 2\n") == 2);
  CHECK(count(ended.output, "code 5\n") == 1);
  CHECK(ended.output.find("--part: 1/1: another process works on this part") != std::string::npos);
  CHECK(ended.output.find("another study writes to this folder") != std::string::npos);
  CHECK(ended.output.find("another process makes it now") != std::string::npos);
  CHECK(ended.output.find("3 of 6 runs are missing") != std::string::npos);
  CHECK(study.run("parts", {"--merge"}).exit_code == 5);
  CHECK(count(text_of(study.out("parts") / "study.csv"), "not made to its end") == 3);

  std::ofstream(study.file()) << SmallStudy::text(false, "1000");  // the last three at rest: no trace of the motion
  const auto again = study.run("parts", {"--part", "1/1"});
  INFO(again.output);
  CHECK(again.exit_code == 0);
  CHECK(count(again.output, "done before") == 3);
  CHECK(study.run("parts", {"--merge"}).exit_code == 0);
  REQUIRE(study.run("whole").exit_code == 0);
  check_same(study.out("whole"), study.out("parts"));
}

TEST_CASE("parts of a study: wrong parts are exit code 2 with one message, and nothing is written") {
  const SmallStudy study;
  for (const char* part :
       {"0/3", "4/3", "x", "3/0", "3", "3/", "/3", "-1/3", "1/3/3", "1.0/3", "", " 1/3", "1/99999"}) {
    const auto ended = study.run("parts", {"--part", part});
    INFO(part << ": " << ended.output);
    CHECK(ended.exit_code == 2);
    CHECK(count(ended.output, "--part") == 1);
    CHECK(ended.output.find("must be a part as 3/16") != std::string::npos);
  }
  CHECK(study.run("parts", {"--part", "1/3", "--merge"}).exit_code == 2);
  CHECK(study.run("parts", {"--again", "--merge"}).exit_code == 2);
  CHECK_FALSE(fs::exists(study.out("parts")));
}
