#include "post/studies/orders.hpp"

#include "post/files/table.hpp"
#include "tests/unit/cases/studies.hpp"

using namespace studies;

namespace {

std::string short_axis(const std::string& name, const std::string& key, const std::string& values) {
  return "[[axis]]\nname = \"" + name + "\"\nkey = \"" + key + "\"\nvalues = " + values + "\n";
}

/// The case of b.toml in time.
std::string dynamic_case() {
  std::string text = case_text::with_line(cracked, 17, "kind = \"dynamic\"\nduration = 0.2");
  text = case_text::with_line(text, 4, "thickness = 0.1\ndensity = 1.0");
  return text + "far = [0.9, 0.0]\n";
}

std::vector<post::Cell> cells(const post::Table& table, const std::string& name) {
  std::vector<post::Cell> result;
  for (const auto& row : table.rows) result.push_back(row[table.column(name)]);
  return result;
}

}  // namespace

TEST_CASE("an axis of a key has a point for each value, of any kind") {
  const Studies studies;
  const auto study =
      studies.read("case = \"a.toml\"\n" + short_axis("spacing", "discretization.spacing", "[0.1, 0.05]") +
                   short_axis("method", "analysis.method", "[\"cg\", \"adr\"]") +
                   short_axis("cracks", "geometry.cracks", "[[[[-0.3, 0.0], [0.3, 0.0]]], [[[-0.5, 0], [0.5, 0]]]]"));
  REQUIRE(study.runs.size() == 8);
  const auto& last = study.runs.back();
  CHECK(last.labels[0] == "0.05");
  CHECK(last.labels[1] == "adr");
  CHECK_THAT(last.labels[2], Catch::Contains("-0.5"));
  CHECK(last.file.content.discretization.spacing == 0.05);
  CHECK(last.file.content.analysis.method == cases::Analysis::Method::adr);
  CHECK(last.file.content.cracks[0][1].x() == 0.5);
  CHECK(study.runs.front().file.content.analysis.method == cases::Analysis::Method::cg);
}

TEST_CASE("a label that is a number may be given as a number") {
  const Studies studies;
  const auto study = studies.read("case = \"a.toml\"\n" + short_axis("E", "section.young", "[10, 20.5]") +
                                  reference("quantity = \"K1\"\ntip = 0\nwhere = { E = 20.5 }\nvalue = 3"));
  CHECK_FALSE(study.runs[0].wanted[0].reference);
  CHECK(study.runs[1].wanted[0].reference);
}

TEST_CASE("what is wrong with an axis of a key is told where it stands") {
  const Studies studies;
  expect(studies.problems("case = \"a.toml\"\n" + short_axis("a", "section.poisson", "[0.1, 0.7]") +
                          short_axis("b", "section.yung", "[1.0]")),
         {"study.toml:5 section.poisson: 0.7 given", "study.toml:9 section.yung: unknown key 'yung'"});
  expect(studies.problems("case = \"a.toml\"\n" + short_axis("a", "section.young", "[1.0, 1]") +
                          short_axis("b", "section.young", "3") + short_axis("c", "section.young", "[]") +
                          "[[axis]]\nname = \"d\"\nkey = \"section.young\"\n" +
                          "[[axis]]\nname = \"e\"\nvalues = [1, 2]\n" + short_axis("f", "section.young", "[1]") +
                          "[[axis.point]]\nlabel = \"x\"\n"),
         {"study.toml:5 axis[0].values[1]: \"1\" is given twice", "study.toml:9 axis[1].values: 3 given",
          "study.toml:13 axis[2].values: [] given, must be a list of values of the key",
          "study.toml:14 axis[3].values: is missing", "study.toml:19 axis[4].values: axis[4].values is used with key",
          "study.toml:24 axis[5].point: axis[5].point is used with no key"});
}

TEST_CASE("a reference is a number, the finest run or a curve, and one of them") {
  const Studies studies;
  studies.write("curve.csv", "t,w,none\n0,0,0\n1,2,0\n");
  studies.write("one.csv", "t,w\n0,1\n");
  studies.write("radii.csv", "r,w\n0,1\n1,2\n");
  const std::string w = "quantity = \"w\"\nprobe = \"far\"\nwhere = { k = \"1\" }\n";
  studies.write("c.toml", dynamic_case());
  const std::string axes = "case = \"c.toml\"\n" + short_axis("k", "section.young", "[1, 2, 3, 4, 5, 6, 7, 8, 9]");
  const auto problem = [&](const std::string& lines) { return studies.problems(axes + reference(w + lines)); };
  expect(problem(""), {"study.toml:6 reference[0].value: is missing, must be a number; or give finest = true"});
  expect(problem("value = 1\nfinest = true"), {"study.toml:6 reference[0]: value and finest given"});
  expect(problem("finest = false"), {"study.toml:10 reference[0].finest: false given, must be true"});
  expect(problem("finest = 1"), {"study.toml:10 reference[0].finest: 1 given, must be true or false"});
  expect(problem("finest = true"), {"reference[0].finest: no axis changes the spacing"});
  expect(problem("value = 1\ncolumn = \"w\""), {"study.toml:11 reference[0].column: reference[0].column is used with"});
  expect(problem("value = 1\nmethod = \"x\""), {"study.toml:11 reference[0].method: reference[0].method is used with"});
  expect(problem("curve = \"curve.csv\""), {"reference[0].column: is missing"});
  expect(problem("curve = \"cuve.csv\"\ncolumn = \"w\""), {"study.toml:10 reference[0].curve: no such file"});
  expect(problem("curve = \"curve.csv\"\ncolumn = \"v\""),
         {"study.toml:11 reference[0].column: \"v\" given, must be one of \"t\", \"w\", \"none\""});
  expect(problem("curve = \"curve.csv\"\ncolumn = \"none\""), {"study.toml:11 reference[0].column: the curve must"});
  expect(problem("curve = \"one.csv\"\ncolumn = \"w\""), {"study.toml:11 reference[0].column: the curve must"});
  expect(problem("curve = \"radii.csv\"\ncolumn = \"w\""),
         {"study.toml:10 reference[0].curve: the file has no column"});
  CHECK(problem("curve = \"curve.csv\"\ncolumn = \"w\"").empty());
  studies.write("c.toml", cracked + "far = [0.9, 0.0]\n");
  expect(problem("curve = \"curve.csv\"\ncolumn = \"w\""), {"study.toml:6 reference[0]: the case is static"});
}

TEST_CASE("the finest run is the reference of the others, and orders follow from them") {
  const Studies studies;
  const auto study = studies.read(
      "case = \"b.toml\"\nset = [\"analysis.method=cg\", \"output.fields=[]\", \"srif.window=0.6\", "
      "\"discretization.formulation=ordinary\"]\n" +
      short_axis("thickness", "section.thickness", "[0.1, 0.3]") +
      short_axis("spacing", "discretization.spacing", "[0.2, 0.1, 0.05]") +
      reference("quantity = \"w\"\nprobe = \"far\"\nfinest = true") +
      reference("quantity = \"K1\"\ntip = 0\nmethod = \"displacement_extrapolation\"\nfinest = true") +
      reference("quantity = \"K1\"\ntip = 0\nmethod = \"guesswork\"\nfinest = true"));
  const auto outcome = cases::run_study(study, {studies.out(), true});
  CHECK(outcome.wrong_cases + outcome.failed_numbers == 0);
  const auto table = post::read_csv(studies.out() / "study.csv");
  REQUIRE(table.rows.size() == 18);
  const auto computed = cells(table, "computed"), errors = cells(table, "error");
  for (std::size_t i = 0; i < 18; ++i) {
    if (i % 3 == 2) {  // the third quantity of each run
      CHECK(computed[i] == post::Cell());
      CHECK_THAT(std::get<std::string>(cells(table, "message")[i]),
                 Catch::Contains("no method guesswork, but ") && Catch::Contains("displacement_extrapolation"));
      continue;
    }
    const std::size_t finest = i / 9 * 9 + 6 + i % 9 % 3;
    if (i == finest)
      CHECK(errors[i] == post::Cell());
    else
      CHECK(std::get<double>(errors[i]) ==
            Approx(std::get<double>(computed[i]) / std::get<double>(computed[finest]) - 1));
  }
  const auto orders = post::read_csv(studies.out() / "orders.csv");
  REQUIRE(orders.rows.size() == 4);
  CHECK(cells(orders, "thickness")[0] == post::Cell("0.1"));
  CHECK(std::get<double>(cells(orders, "runs")[0]) == 2);
  CHECK(cells(orders, "order")[0] == post::Cell());  // the errors of two spacings lie on any line
  for (const char* plot :
       {"error_against_seconds.svg", "error_against_points.svg", "w_against_thickness.svg", "K1_against_spacing.svg"})
    CHECK_THAT(small_run::text_of(studies.out() / plot), Catch::Contains("</svg>"));
}

TEST_CASE("a history is compared with a curve") {
  const Studies studies;
  studies.write("c.toml", dynamic_case());
  studies.write("curves.csv", "t,w\n0,0\n0.05,1\n0.1,-2\n");
  const auto study =
      studies.read("case = \"c.toml\"\nset = [\"output.fields=[]\", \"discretization.spacing=0.1\"]\n" +
                   reference("quantity = \"w\"\nprobe = \"far\"\ncurve = \"curves.csv\"\ncolumn = \"w\""));
  const auto outcome = cases::run_study(study, {studies.out(), true});
  REQUIRE(outcome.table.rows.size() == 1);
  const auto& row = outcome.table.rows[0];
  CHECK(row.message.empty());
  CHECK(row.reference == -2.0);
  CHECK(row.source == "curves.csv w");
  std::ifstream file(studies.out() / "run" / "probes.csv");  // read another way
  std::string line;
  std::getline(file, line);
  double squares = 0;
  while (std::getline(file, line)) {
    double t = 0, x = 0, y = 0, w = 0;
    REQUIRE(std::sscanf(line.c_str(), "%lf,far,%lf,%lf,%lf", &t, &x, &y, &w) == 4);
    for (const auto& [instant, known] : {std::pair(0.0, 0.0), {0.05, 1.0}, {0.1, -2.0}})
      if (std::abs(t - instant) < 1e-9) squares += (w - known) * (w - known) / 3;
  }
  REQUIRE(row.error());
  CHECK(*row.error() == Approx(std::sqrt(squares) / 2).epsilon(1e-6));
}

TEST_CASE("quantities are listed for every run without a reference, with their estimated errors") {
  const Studies studies;
  const std::string lengths = "[[axis]]\nname = \"half\"\nkey = \"section.young\"\nvalues = [500, 1000]\n";
  const auto study = studies.read("case = \"b.toml\"\nrepeats = 2\n" + fast + lengths +
                                  "[[quantities]]\nquantity = \"K1\"\ntip = 1\n[[quantities]]\nquantity = \"max_w\"\n"
                                  "[[quantities]]\nquantity = \"w\"\nprobe = \"far\"\n");
  const auto outcome = cases::run_study(study, {studies.out(), true});
  const auto& rows = outcome.table.rows;
  REQUIRE(rows.size() == 6);
  for (const auto& row : rows) {
    CHECK(row.outcome == "done");
    CHECK(row.computed.has_value());
    CHECK_FALSE(row.error());
    CHECK(*row.seconds_min <= *row.seconds);
    CHECK(*row.seconds <= *row.seconds_max);
    double stages = 0;
    for (const auto& [stage, spent] : row.stage_seconds) stages += stage == "total" ? 0 : spent;
    CHECK(stages > 0);
  }
  CHECK(*rows[1].computed == Approx(2 * *rows[4].computed));  // half as stiff
  CHECK(std::filesystem::exists(studies.out() / "K1_against_half.svg"));
  CHECK(std::filesystem::exists(studies.out() / "study.json"));
  CHECK(post::orders(outcome.table).empty());
}

TEST_CASE("a study goes on where it was ended: what is done is taken, all else is run") {
  const Studies studies;
  const auto read = [&](const std::string& good) {
    return studies.read("case = \"b.toml\"\n" + fast +
                        axis("kind", {"label = \"early\"\nset = [\"analysis.max_iterations=3\"]",
                                      "label = \"good\"\nset = [\"section.young=" + good + "\"]"}) +
                        reference("quantity = \"strain_energy\"\nvalue = 4"));
  };
  const auto first = cases::run_study(read("1000"), {studies.out(), true});
  CHECK(first.failed_numbers == 1);
  const auto file = studies.out() / "good" / "summary.json";
  const auto written = std::filesystem::last_write_time(file);
  const auto second = cases::run_study(read("1000"), {studies.out(), true});
  CHECK(second.failed_numbers == 1);  // run again, and failed again
  CHECK(std::filesystem::last_write_time(file) == written);
  CHECK(second.table.rows[1].computed == first.table.rows[1].computed);
  CHECK(second.table.rows[1].seconds == first.table.rows[1].seconds);
  const auto other = cases::run_study(read("500"), {studies.out(), true});  // other settings
  CHECK(std::filesystem::last_write_time(file) != written);
  CHECK(*other.table.rows[1].computed == Approx(2 * *first.table.rows[1].computed));
  const auto third = std::filesystem::last_write_time(file);
  cases::run_study(read("500"), {studies.out(), true, true});
  CHECK(std::filesystem::last_write_time(file) != third);
  std::filesystem::remove(file);  // as where a run was killed
  cases::run_study(read("500"), {studies.out(), true});
  CHECK(std::filesystem::exists(file));
}

TEST_CASE("a file for another command is refused in one line that names the command") {
  const Studies studies;
  expect(studies.problems(case_text::plain), {"this file is for pdplate run"});
  expect(studies.problems("[[row]]\ntitle = \"one\"\n"), {"this file is for pdplate extremes"});
  const small_run::TemporaryFolder folder;
  std::ofstream(folder / "study.toml") << "case = \"a.toml\"\n" + axis("way", {"label = \"one\""});
  CHECK_THROWS_WITH(cases::read_case(folder / "study.toml", {}), Catch::Contains("this file is for pdplate study"));
}
