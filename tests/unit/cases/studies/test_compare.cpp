#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/studies/comparison.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using cases::compare, post::Table, small_run::TemporaryFolder;

namespace {

/// Two probes and two tips by two methods; only what is to be chosen is t times a simple number.
void write_results(const TemporaryFolder& folder) {
  Table probes{{"time", "probe", "x", "y", "w", "theta_x", "theta_y"}, {}};
  Table srifs{{"time", "tip", "x", "y", "method", "K1", "F1"}, {}};
  for (const double t : {0.0, 1.0, 2.0}) {
    probes.rows.push_back({t, "edge", 1.0, 0.0, 99.0, 99.0, 99.0});
    probes.rows.push_back({t, "tip", 0.1, 0.0, 1.1 * t, 0.0, t});
    for (const double tip : {0.0, 1.0}) {
      const double x = tip == 0 ? -0.1 : 0.1;
      srifs.rows.push_back({t, tip, x, 0.0, "first", tip * 2 * t, tip * 3 * t});
      srifs.rows.push_back({t, tip, x, 0.0, "second", 99.0, 99.0});
    }
  }
  post::write_csv(folder / "probes.csv", probes);
  post::write_csv(folder / "srif.csv", srifs);
}

}  // namespace

TEST_CASE("a results folder is compared in every quantity that the reference knows") {
  const TemporaryFolder folder;
  write_results(folder);
  Table reference{{"t", "w", "theta_x", "K1", "F1_paper_LS", "F1", "F1_J", "w_f"}, {}};
  for (const double t : {0.0, 0.5, 1.5}) reference.rows.push_back({t, t, -0.0, 2 * t, 1.5 * t, 2.0 * t, 3 * t, t});
  post::write_csv(folder / "reference.csv", reference);

  const auto rows = compare(folder.path(), folder / "reference.csv");
  std::vector<std::string> names;
  std::vector<double> errors;
  for (const auto& row : rows) {
    names.push_back(row.quantity + ":" + row.reference);
    errors.push_back(row.comparison.relative_rms);
  }
  CHECK(names == std::vector<std::string>{"w:w", "F1:F1_J", "F1:F1_paper_LS", "F1:F1", "K1:K1"});
  const std::vector<double> expected{0.1, 0, 1, 0.5, 0};
  CHECK_THAT(errors, Catch::Matchers::Approx(expected).margin(1e-12));

  const std::string text = cases::to_text(rows);
  CHECK(std::count(text.begin(), text.end(), '\n') == 6);
  CHECK_THAT(text, Catch::Contains("F1_paper_LS") && Catch::Contains("10.000 %"));
}

TEST_CASE("factors in the plane and displacements there are compared where a run has them") {
  const TemporaryFolder folder;
  Table probes{{"time", "probe", "x", "y", "w", "u", "v"}, {}}, reference{{"t", "u", "N1", "N2_exact"}, {}};
  Table srifs{{"time", "tip", "x", "y", "method", "K1", "N1", "N2"}, {}};
  for (const double t : {0.0, 1.0, 2.0}) {
    probes.rows.push_back({t, "tip", 0.1, 0.0, t, 1.1 * t, 3 * t});
    srifs.rows.push_back({t, 0.0, 0.1, 0.0, "first", t, 2 * t, 5 * t});
    reference.rows.push_back({t, t, 2 * t, 4 * t});
  }
  post::write_csv(folder / "probes.csv", probes);
  post::write_csv(folder / "srif.csv", srifs);
  post::write_csv(folder / "reference.csv", reference);
  const auto rows = compare(folder.path(), folder / "reference.csv");
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].quantity == "u");
  CHECK(rows[0].comparison.relative_rms == Approx(0.1));
  CHECK(rows[1].quantity == "N1");
  CHECK(rows[1].comparison.relative_rms == Approx(0).margin(1e-12));
  CHECK(rows[2].reference == "N2_exact");
  CHECK(rows[2].comparison.relative_rms == Approx(0.25));
  CHECK(cases::plot(rows, "title", true).panels.size() == 3);
}

TEST_CASE("tolerances are held against every quantity, by measure or all") {
  const TemporaryFolder folder;
  write_results(folder);
  Table reference{{"t", "w", "theta_x"}, {}};
  for (const double t : {0.0, 0.5, 1.5, 2.0}) reference.rows.push_back({t, t, t});
  reference.rows.push_back({post::Cell(), 1.0, NAN});  // a row that is not whole counts for nothing
  post::write_csv(folder / "reference.csv", reference);
  const auto rows = compare(folder.path(), folder / "reference.csv");
  REQUIRE(rows.size() == 2);  // w is 1.1 t, theta_x 0
  CHECK(cases::exceeded(rows, {}).empty());
  CHECK(cases::exceeded({rows[0]}, cases::tolerances({"l2=0.11"}, std::nullopt)).empty());
  const auto above = cases::exceeded(rows, cases::tolerances({"peak=0.2"}, 0.05));
  std::vector<std::string> names;
  for (const auto& one : above) names.push_back(one.quantity + " " + one.measure);
  CHECK(names ==
        std::vector<std::string>{"w l2", "w max", "theta_x l2", "theta_x max", "theta_x peak", "theta_x peak_time"});
  CHECK(above[0].found == Approx(0.1));
  CHECK(above[0].allowed == 0.05);
  CHECK_THAT(cases::to_text(above), Catch::StartsWith("w against w: l2 is 0.1, above 0.05\n"));
  const auto json = nlohmann::json::parse(cases::to_json(rows, above));
  CHECK(json["within"] == false);
  CHECK(json["quantities"][0]["l2"].get<double>() == Approx(0.1));
  CHECK(json["quantities"][0]["peak"]["computed"].get<double>() == Approx(2.2));
  CHECK(json["exceeded"].size() == 6);
}

TEST_CASE("tolerances that say nothing are refused") {
  for (const std::string wrong : {"l3=0.1", "l2", "l2=", "l2=-1", "l2=nan", "l2=1x", "=1"})
    CHECK_THROWS_AS(cases::tolerances({wrong}, std::nullopt), std::invalid_argument);
  CHECK_THROWS_WITH(cases::tolerances({"shft=1"}, std::nullopt), Catch::Contains("did you mean 'shift'?"));
}

TEST_CASE("a reference without curves is refused") {
  const TemporaryFolder folder;
  write_results(folder);
  post::write_csv(folder / "static.csv", {{"r", "K1"}, {{0.1, 1.0}}});
  CHECK_THROWS_WITH(compare(folder.path(), folder / "static.csv"), Catch::Contains("no column t"));
  post::write_csv(folder / "other.csv", {{"t", "pressure"}, {{0.1, 1.0}}});
  CHECK_THROWS_WITH(compare(folder.path(), folder / "other.csv"), Catch::Contains("no curve in common"));
}

TEST_CASE("rotations of a probe at a crack tip get a note, and a probe ahead is compared with its own columns") {
  const TemporaryFolder folder;
  Table probes{{"time", "probe", "x", "y", "w", "theta_x", "theta_y"}, {}};
  Table srifs{{"time", "tip", "x", "y", "method", "K1"}, {}};
  Table reference{{"t", "w", "theta_y", "w_a", "ty_a"}, {}};
  for (const double t : {0.0, 1.0, 2.0}) {
    probes.rows.push_back({t, "tip", 0.1, 0.0, t, 0.0, 3 * t});
    probes.rows.push_back({t, "ahead", 0.12, 0.0, 2 * t, 0.0, 5 * t});
    srifs.rows.push_back({t, 0.0, 0.1, 0.0, "first", t});
    reference.rows.push_back({t, t, 2 * t, 2 * t, 4 * t});
  }
  post::write_csv(folder / "probes.csv", probes);
  post::write_csv(folder / "srif.csv", srifs);
  post::write_csv(folder / "reference.csv", reference);

  const auto rows = compare(folder.path(), folder / "reference.csv");
  std::vector<std::string> names, noted;
  for (const auto& row : rows) {
    names.push_back(row.quantity + ":" + row.reference);
    if (!row.note.empty()) noted.push_back(names.back());
  }
  CHECK(names == std::vector<std::string>{"w:w", "theta_y:theta_y", "w:w_a", "theta_y:ty_a"});
  CHECK(noted == std::vector<std::string>{"theta_y:theta_y"});
  CHECK(rows[2].comparison.relative_rms == Approx(0).margin(1e-12));
  CHECK(rows[3].comparison.relative_rms == Approx(0.25));
  CHECK_THAT(cases::to_text(rows),
             Catch::Contains("theta_y: the probe is at a crack tip") && Catch::Contains("columns tx_a, ty_a"));
  CHECK_THAT(cases::to_json(rows, {}), Catch::Contains("\"note\": \"the probe is at a crack tip"));

  for (auto& row : probes.rows) row[2] = std::get<double>(row[2]) + 0.05;  // away from the tip
  post::write_csv(folder / "probes.csv", probes);
  for (const auto& row : compare(folder.path(), folder / "reference.csv")) CHECK(row.note.empty());
}
