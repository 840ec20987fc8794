#include "cases/studies/study.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/studies.hpp"

using namespace studies;

TEST_CASE("every combination is a run with its case, its overrides and its references") {
  const Studies studies;
  const auto study = studies.read(
      "set = [\"section.young=7\", \"section.poisson=0.1\"]\n" +
      axis("file",
           {"label = \"A\"\ncase = \"a.toml\"", "label = \"B\"\ncase = \"b.toml\"\nset = [\"section.young=9\"]"}) +
      axis("nu", {"label = \"0.2\"\nset = [\"section.poisson=0.2\"]", "label = \"as it is\""}) +
      reference("quantity = \"F1\"\ntip = 1\nwhere = { file = \"A\", nu = \"0.2\" }\nvalue = 1") +
      reference("quantity = \"F1\"\ntip = 1\nwhere = { file = \"B\" }\nvalue = 2") +
      reference(
          "quantity = \"w\"\nprobe = \"far\"\nwhere = { file = \"B\", nu = \"as it is\" }\nvalue = 3\nsource = \"s\""));
  CHECK(study.title == "study");
  CHECK(study.axis_names() == std::vector<std::string>{"file", "nu"});
  REQUIRE(study.runs.size() == 4);
  struct Expected {
    std::vector<std::string> labels;
    std::string folder;
    double young, poisson;
    std::vector<std::optional<double>> references;  // of F1, and of w where there is a probe
  };
  const std::vector<Expected> expected{{{"A", "0.2"}, "A_0.2", 7, 0.2, {1.0}},
                                       {{"A", "as it is"}, "A_as_it_is", 7, 0.1, {std::nullopt}},
                                       {{"B", "0.2"}, "B_0.2", 9, 0.2, {2.0, std::nullopt}},
                                       {{"B", "as it is"}, "B_as_it_is", 9, 0.1, {2.0, 3.0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& run = study.runs[i];
    CHECK(run.labels == expected[i].labels);
    CHECK(run.folder == expected[i].folder);
    CHECK(run.file.content.section.young == expected[i].young);
    CHECK(run.file.content.section.poisson == expected[i].poisson);
    std::vector<std::optional<double>> references;
    for (const auto& wanted : run.wanted)
      references.push_back(wanted.reference ? std::optional(std::get<double>(*wanted.reference)) : std::nullopt);
    CHECK(references == expected[i].references);
  }
}

TEST_CASE("all problems of a study file are told together") {
  const Studies studies;
  expect(
      studies.problems("titel = \"x\"\ncase = \"c.toml\"\nset = [\"a=b\", 3]\n" +
                       axis("points", {"label = \"a\"\nsett = []", "label = \"a\""}) + "[[axis]]\nnam = \"q\"\n" +
                       reference("quantity = \"G1\"\nvalue = 0") +
                       reference("quantity = \"K1\"\nprobe = \"x\"\nvalue = nan") +
                       reference("quantity = \"w\"\nprobe = \"x\"\ntip = 1.5\nvalue = 1")),
      {"study.toml:1 titel: unknown key 'titel' (did you mean 'title'?)", "study.toml:2 case: no such file",
       "study.toml:3 set[1]: 3 given, must be a string", "study.toml:5 axis[0].name: \"points\" is a column",
       "study.toml:8 axis[0].point[0].sett: unknown key 'sett' (did you mean 'set'?)",
       "study.toml:10 axis[0].point[1].label: \"a\" is given twice", "study.toml:11 axis[1].name: is missing",
       "study.toml:11 axis[1].point: is missing", "study.toml:12 axis[1].nam: unknown key 'nam' (did you mean 'name'?)",
       "study.toml:14 reference[0].quantity: \"G1\" given, must be one of \"K1\"",
       "study.toml:15 reference[0].value: 0 given", "study.toml:16 reference[1].tip: is missing",
       "study.toml:18 reference[1].probe: is used with quantity = w", "study.toml:19 reference[1].value: nan given",
       "study.toml:23 reference[2].tip"});
}

TEST_CASE("problems of the cases are told with those of the study, each once and where the study file has it") {
  const Studies studies;
  studies.write("a.toml", case_text::with_line(cracked, 4, "thickness = 0"));
  expect(
      studies.problems("set = [\"sectio.young=3\"]\n" +
                       axis("file", {"label = \"A\"\ncase = \"a.toml\"", "label = \"B\"\ncase = \"b.toml\""}) +
                       axis("nu", {"label = \"0.2\"", "label = \"0.7\"\nset = [\"section.poisson=0.7\"]"}) +
                       reference("quantity = \"w\"\nprobe = \"far\"\nwhere = { fil = \"A\", nu = \"3\" }\nvalue = 1")),
      {"a.toml:4 section.thickness: 0 given, must be a number > 0 (in 2 of 4 runs, first: A, 0.2)",
       "study.toml:1 sectio: unknown key 'sectio' (did you mean 'section'?)",
       "study.toml:16 section.poisson: 0.7 given, must be a number in (-1, 0.5) (in 2 of 4 runs, first: A, 0.7)",
       "study.toml:20 reference[0].where.fil: no axis \"fil\" (did you mean 'file'?)",
       "study.toml:20 reference[0].where.nu: \"3\" given, must be one of \"0.2\", \"0.7\""});
}

TEST_CASE("references that no run can have, or that one run has twice, are refused") {
  const Studies studies;
  const std::string file = axis("file", {"label = \"A\"\ncase = \"a.toml\"", "label = \"B\"\ncase = \"b.toml\""});
  expect(studies.problems(file + reference("quantity = \"w\"\nprobe = \"far\"\nvalue = 1") +
                          reference("quantity = \"K1\"\ntip = 2\nvalue = 1") +
                          reference("quantity = \"K1\"\ntip = 0\nvalue = 1") +
                          reference("quantity = \"K1\"\ntip = 0\nwhere = { file = \"B\" }\nvalue = 1")),
         {"study.toml:9 reference[0]: the case has no probe \"far\" (in 1 of 2 runs, first: A)",
          "study.toml:13 reference[1]: the case has 2 crack tips",
          "study.toml:21 reference[3]: matches a run with the same quantity as reference[2]"});
  expect(studies.problems(axis("file", {"label = \"A\"\ncase = \"a.toml\"", "label = \"none\""})),
         {"study.toml case: is missing, must be a case file (in 1 of 2 runs, first: none)"});
  expect(studies.problems("case = [[\n"), {""});
  CHECK_THROWS_AS(cases::read_study(studies.out()), cases::CaseError);
}

TEST_CASE("errors of a study follow from what its runs have written") {
  const Studies studies;
  const auto study = studies.read(
      "case = \"b.toml\"\n" + fast +
      axis("E", {"label = \"1\"\nset = [\"section.young=1000\"]", "label = \"2\"\nset = [\"section.young=2000\"]"}) +
      reference("quantity = \"F1\"\ntip = 1\nvalue = 0.5") +
      reference("quantity = \"w\"\nprobe = \"far\"\nwhere = { E = \"2\" }\nvalue = -3") +
      reference("quantity = \"strain_energy\"\nvalue = 4"));
  const auto outcome = cases::run_study(study, {studies.out(), true});
  CHECK(outcome.wrong_cases + outcome.failed_numbers == 0);
  const auto table = post::read_csv(studies.out() / "study.csv");
  REQUIRE(table.rows.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto cell = [&](const std::string& name) { return table.rows[i][table.column(name)]; };
    const auto folder = studies.out() / (i < 3 ? "1" : "2");
    const auto summary = nlohmann::json::parse(small_run::text_of(folder / "summary.json"));
    double x = 0, y = 0, w = 0;  // of the only row of probes.csv, read another way
    const auto probes = small_run::text_of(folder / "probes.csv");
    REQUIRE(std::sscanf(probes.c_str() + probes.find('\n'), "\n0,far,%lf,%lf,%lf", &x, &y, &w) == 3);
    const double computed[] = {summary["srif"][1]["F1"], w, summary["energy"]["strain"]};
    const double references[] = {0.5, -3, 4};
    CHECK(std::get<double>(cell("computed")) == Approx(computed[i % 3]).epsilon(1e-12));
    if (i == 1)
      CHECK(cell("error") == post::Cell());  // the reference of w is that of E = 2
    else
      CHECK(std::get<double>(cell("error")) == Approx(computed[i % 3] / references[i % 3] - 1).epsilon(1e-10));
    CHECK(cell("E") == post::Cell(i < 3 ? "1" : "2"));
    CHECK(cell("points") == post::Cell(400.0));
    CHECK(std::get<double>(cell("iterations")) == summary["analysis"]["iterations"].get<double>());
    CHECK(std::get<double>(cell("seconds")) == Approx(summary["seconds"]["total"].get<double>()));
  }
}

TEST_CASE("a run that fails is a row with its message, and the study goes on") {
  const Studies studies;
  const auto study =
      studies.read("case = \"b.toml\"\n" + fast +
                   axis("kind", {"label = \"loose\"\nset = [\"support[0].kind=free\"]",
                                 "label = \"early\"\nset = [\"analysis.max_iterations=3\"]", "label = \"good\""}) +
                   reference("quantity = \"strain_energy\"\nvalue = 4"));
  const auto outcome = cases::run_study(study, {studies.out(), true});
  CHECK(outcome.wrong_cases == 1);
  CHECK(outcome.failed_numbers == 1);
  const auto& rows = outcome.table.rows;
  REQUIRE(rows.size() == 3);
  CHECK_THAT(rows[0].message, Catch::Contains("not held"));
  CHECK_THAT(rows[1].message, Catch::Contains("3 iterations"));
  CHECK_FALSE(rows[1].computed);
  CHECK(rows[2].message.empty());
  CHECK(rows[2].computed > 0);
  CHECK(post::read_csv(studies.out() / "study.csv").rows.size() == 3);
}

TEST_CASE("the studies in the tree read, and their references are those of the table") {
  const std::filesystem::path cases_folder = std::filesystem::path(PDPLATE_SOURCE_DIR) / "cases";
  CHECK(cases::read_study(cases_folder / "static" / "study_convergence.toml").runs.size() == 8);
  for (const auto& run : cases::read_study(cases_folder / "static" / "study_m_convergence.toml").runs) {
    CHECK(run.file.content.discretization.horizon() == Approx(0.201));  // the same in all runs
    CHECK(run.file.content.discretization.horizon_ratio == std::stod(run.labels[0]));
  }
  const auto study = cases::read_study(cases_folder / "static" / "study_paper_4.1.toml");
  const auto known = post::read_csv(cases_folder / "references" / "static_summary.csv");
  REQUIRE(study.runs.size() == 50);
  for (const auto& run : study.runs) {
    REQUIRE(run.wanted.size() == 1);
    std::vector<post::Cell> values;
    for (const auto& row : known.rows)
      if (row[known.column("load")] == post::Cell(run.labels[0]) && row[known.column("W_2h")] == post::Cell(10.0) &&
          row[known.column("two_a_over_W")] == post::Cell(std::stod(run.labels[2])) &&
          row[known.column("support")] == post::Cell("soft") && row[known.column("nu")] == post::Cell(0.3))
        values.push_back(row[known.column("F1_paper_LS")]);
    REQUIRE(values.size() == 1);
    CHECK(values[0] == post::Cell(std::get<double>(*run.wanted[0].reference)));
    const auto& c = run.file.content;  // width 2: the label is the half length
    CHECK(*c.srif->half_length == std::stod(run.labels[2]));
    CHECK(c.cracks[0][1].x() - c.cracks[0][0].x() == Approx(2 * std::stod(run.labels[2])));
  }
}
