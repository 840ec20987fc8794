#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

std::string table(const std::string& name, const std::string& more = "") {
  return with_line(plain, 15, "table = \"" + name + "\"" + (more.empty() ? "" : "\n" + more));
}

/// A table beside the case files of tests.
struct Csv {
  std::string name = "table_of_test_" + std::to_string(getpid()) + ".csv";
  std::filesystem::path path = std::filesystem::temp_directory_path() / name;
  explicit Csv(const std::string& rows) { std::ofstream(path) << "x,y,pressure\n" << rows; }
  ~Csv() { std::filesystem::remove(path); }
};

}  // namespace

TEST_CASE("tables of pressures are sought beside the case, and known by what they say") {
  const Csv csv("-1,-1,1\n1,-1,2\n-1,1,3\n1,1,4\n");
  const auto file = read(table(csv.name));
  const auto* pressure = file.content.loads[0].as<plate::Pressure>();
  REQUIRE(pressure);
  CHECK(pressure->at({0, 0}) == 2.5);
  const auto resolved = cases::resolved_toml(file.content);
  CHECK(resolved.find(csv.path.string()) != std::string::npos);
  CHECK(resolved.find("table_digest = \"" + pressure->table.digest()) != std::string::npos);
  CHECK(cases::resolved_toml(read(resolved).content) == resolved);
  std::ofstream(csv.path, std::ios::app) << "# more\n";
  CHECK_THROWS_AS(read(resolved), cases::CaseError);  // another table
  CHECK(cases::resolved_toml(read(table(csv.name)).content) != resolved);
}

TEST_CASE("tables that are wrong are refused") {
  expect(table("not_there.csv"), ":15", "load[0].table", "\"not_there.csv\": cannot be read");
  expect(table("."), ":15", "load[0].table", "\".\": cannot be read");
  expect(table("/dev/zero"), ":15", "load[0].table", "has more than 268435456 bytes");
  const Csv narrow("-1,-1,1\n1,-1,2\n-1,0.9,3\n1,0.9,4\n");
  expect(table(narrow.name), ":15", "load[0].table", "do not reach [1, 1]");
  expect(table(narrow.name, "on = { circle = [0, 0, 0.5] }\nvalue = 2"), ":17", "load[0].value",
         "neither body_force, expression, table nor gravity only");
  CHECK(problems(table(narrow.name, "on = { circle = [0, 0, 0.5] }")).empty());
}

TEST_CASE("a fluid stands up to a level") {
  const auto fluid = [](const std::string& more) { return with_line(plain, 15, "value = 2\nlevel = 0.5" + more); };
  const auto load = read(fluid("")).content.loads[0];
  const auto* pressure = load.as<plate::Pressure>();
  REQUIRE(pressure);
  CHECK(pressure->at({0.3, 0}) == 1);
  CHECK(pressure->at({0.3, 0.6}) == 0);
  expect(fluid("\ngradient = [1, 2]"), ":17", "load[0].gradient", "without level only");
  CHECK(cases::resolved_toml(read(fluid("")).content).find("level = 0.5") != std::string::npos);
}

TEST_CASE("loads move along paths in motions alone") {
  const std::string wheel = with_line(plain, 14, "kind = \"point_force\"\npath = [[-1, 0.3], [1, 0.3]]\nspeed = 2");
  const std::vector<std::string> motion{"analysis.kind=dynamic", "analysis.duration=1", "section.density=1"};
  CHECK(problems(wheel, motion).empty());
  CHECK(problems(wheel).size() == 3);  // path and speed in statics, where a position is missed
  CHECK(problems(with_line(wheel, 15, "path = [[-1, 0.3], [3, 0.3]]"), motion).empty());  // it drives off
  expect(with_line(wheel, 15, "path = [[-1, 2], [3, 2]]"), ":15", "load[0].path", "does not cross the plate", motion);
  expect(with_line(wheel, 16, "speed = -2"), ":16", "load[0].speed", "-2 given", motion);
  expect(with_line(wheel, 14, "kind = \"pressure\""), ":15", "load[0].path", "give on", motion);
  expect(wheel + "method = \"lanczos\"\n", ":20", "analysis.method", "loads that move need steps", motion);
}

TEST_CASE("soil that lifts off is refused where it cannot go") {
  const auto soil = [](const std::string& more) {
    return plain + "[[foundation]]\nmodulus = 2\nlifts_off = true\n" + more;
  };
  CHECK(read(soil("")).content.foundations[0].unilateral);
  expect(soil("shear = 1\n"), ":18", "foundation[0]", "a shear layer holds the plate where it lifts off");
  expect(soil(""), ":18", "foundation", "has no frequencies",
         {"analysis.kind=frequencies", "section.density=1", "-load", "-geometry.cracks"});
  CHECK(problems(soil("[[load]]\nkind = \"settlement\"\nvalue = 1\nsupport = 0\n")).empty());
}

TEST_CASE("supports within the plate, and settlements, are checked") {
  const auto support = [](const std::string& lines) { return plain + "[[support]]\n" + lines + "\n"; };
  CHECK(problems(support("kind = \"clamped\"\nalong = [[0, 0.5], [0.5, 0.5]]")).empty());
  CHECK(problems(support("kind = \"pinned\"\non = { circle = [0, 0.5, 0.2] }")).empty());
  CHECK(problems(support("kind = \"clamped\"\npoints = [[0, 0.5]]")).empty());
  expect(support("kind = \"pinned\"\nalong = [[0, 0.5], [0.5, 0.5]]\npoints = [[0, 0.5]]"), ":18", "support[1].edges",
         "several are given, must be one of points, along or on");
  expect(support("kind = \"pinned\"\nalong = [[0, 0.5], [2.5, 0.5]]"), ":20", "support[1].along", "[2.5, 0.5] given");
  expect(support("kind = \"pinned\"\nalong = [[-0.5, 0], [0.5, 0]]"), ":20", "support[1].along", "lies along crack 0");
  expect(support("kind = \"pinned\"\non = { circle = [7, 7, 1] }"), ":20", "support[1].on",
         "the support lies on nothing of the plate");
  const auto has_prescribed_displacements = [](const std::string& lines) {
    return plain + "[[load]]\nkind = \"settlement\"\n" + lines + "\n";
  };
  CHECK(problems(
            has_prescribed_displacements("value = 0.1\nsupport = 0\nslope = [0.1, 0]\nfrom = [0, 1]\nrotation = 0.2"))
            .empty());
  expect(has_prescribed_displacements("value = 0.1"), ":18", "load[1].support", "is missing");
  expect(has_prescribed_displacements("value = 0.1\nsupport = 1"), ":21", "load[1].support",
         "there are the supports 0 to 0");
  expect(has_prescribed_displacements("value = 0.1\nsupport = 0"), ":18", "load[1].history", "moves a support at once",
         {"analysis.kind=dynamic", "analysis.duration=1", "section.density=1"});
  expect(has_prescribed_displacements("value = 0.1\nsupport = 0\nhistory = \"ramp\"\nrise_time = 1"), ":19",
         "load[1].kind", "supports that move need time steps",
         {"analysis.kind=dynamic", "analysis.duration=1", "section.density=1", "analysis.method=lanczos"});
}
