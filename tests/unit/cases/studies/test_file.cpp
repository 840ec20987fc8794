#include "cases/studies/orders.hpp"

#include "post/files/table.hpp"
#include "tests/unit/cases/studies.hpp"

using namespace studies;

namespace {

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
    CHECK(row.outcome == cases::RunOutcome::done);
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
  CHECK(cases::orders(outcome.table).empty());
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
