#include "post/files/summary.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "plate/solve/analysis.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"

using nlohmann::ordered_json;

namespace {

post::Srif srif() {
  post::Srif srif;
  srif.tip = 1;
  srif.position = {0.3, -0.5};
  srif.method = post::SrifMethod::displacement_extrapolation;
  srif.K1 = 0.1;
  srif.K2 = 2;
  srif.K3 = 3;
  srif.F1 = 0.25;
  srif.samples = 12;
  return srif;
}

std::vector<std::string> names(const ordered_json& json) {
  std::vector<std::string> result;
  for (const auto& item : json.items()) result.push_back(item.key());
  return result;
}

}  // namespace

TEST_CASE("summary.json: an estimate of the error of linear theory stands beside the deflection") {
  post::Summary summary;
  summary.deflection_over_thickness = 2, summary.linear_theory_off = 0.5;
  CHECK(ordered_json::parse(post::to_json(summary))["sanity"] ==
        ordered_json{{"deflection_over_thickness", 2}, {"linear_theory_off", 0.5}});
}

TEST_CASE("summary.json: a combination with large deflections is marked as no sum of states") {
  post::Summary summary;
  summary.load_cases = {{"a"}, {"b", {{"a", 2}}}};
  const auto cases = [&] { return ordered_json::parse(post::to_json(summary))["load_cases"]; };
  for (const auto& one : cases()) CHECK_FALSE(one.contains("superposed"));
  for (auto& one : summary.load_cases) one.large_deflections = true;
  CHECK_FALSE(cases()[0].contains("superposed"));
  CHECK(cases()[1]["superposed"] == false);
}

TEST_CASE("summary.json has the fields of its contract in their order") {
  post::Summary summary;
  summary.title = "plate \xC3\xA9 \xFF";  // an e with an accent, and a byte that is not UTF-8
  summary.bonds = 123456789012;
  summary.analysis.kind = plate::Analysis::Kind::static_;
  summary.analysis.iterations = 7;
  summary.analysis.residual = 1e-7;
  summary.seconds = {{"solve", 1.5}, {"total", 2.0}};
  summary.energy = {{"strain", std::numeric_limits<double>::quiet_NaN()}};
  summary.scene = {post::ScenePart{"plate", "solve", 128, 0.9}};
  summary.srif = {srif()};
  summary.warnings = {"first"};
  const auto json = ordered_json::parse(post::to_json(summary));

  CHECK(names(json) ==
        std::vector<std::string>{"title",   "units",    "outcome",           "formulation",       "formulation_reason",
                                 "points",  "bonds",    "fictitious_points", "fictitious_bonds",  "spacing",
                                 "horizon", "analysis", "seconds",           "peak_memory_bytes", "srif",
                                 "energy",  "scene",    "warnings",          "version",           "digest"});
  CHECK(json["title"] == "plate \xC3\xA9 \xEF\xBF\xBD");
  CHECK(json["bonds"] == 123456789012);
  CHECK(names(json["analysis"]) == std::vector<std::string>{"kind", "method", "iterations", "residual", "stop_reason"});
  CHECK(json["analysis"]["iterations"] == 7);
  CHECK(json["seconds"] == ordered_json{{"solve", 1.5}, {"total", 2.0}});
  CHECK(json["energy"]["strain"].is_null());
  CHECK(json["scene"][0] == ordered_json{{"name", "plate"}, {"bytes_per_point", 128.0}, {"time_share", 0.9}});
  CHECK(names(json["srif"][0]) == std::vector<std::string>{"tip", "x", "y", "method", "K1", "K2", "K3", "F1",
                                                           "overlaps_at", "fit_residual", "samples"});
  CHECK(json["srif"][0]["K1"] == 0.1);
  CHECK(json["warnings"] == ordered_json{"first"});
}

TEST_CASE("empty lists of a summary stay lists") {
  const auto json = ordered_json::parse(post::to_json({}));
  CHECK(json["srif"].is_array());
  CHECK(json["warnings"].is_array());
  CHECK(json["energy"].is_object());
}

TEST_CASE("a row of srif.csv fits its columns") {
  post::Table table;
  post::append(table, 0.5, {srif(), srif()});
  CHECK(table.columns == post::srif_columns());
  REQUIRE(table.rows.size() == 2);
  const auto cell = [&](const std::string& name) { return table.rows[1].at(table.column(name)); };
  REQUIRE(table.rows[1].size() == table.columns.size());
  CHECK((cell("time") == post::Cell(0.5)));
  CHECK((cell("tip") == post::Cell(1.0)));
  CHECK((cell("y") == post::Cell(-0.5)));
  CHECK((cell("method") == post::Cell("displacement_extrapolation")));
  CHECK((cell("K3") == post::Cell(3.0)));
  CHECK((cell("F1") == post::Cell(0.25)));
  CHECK((cell("F2") == post::Cell()));
  CHECK((cell("samples") == post::Cell(12.0)));
}

TEST_CASE("peak memory counts what was touched, in bytes") {
  constexpr std::size_t bytes = 64 << 20;
  const std::vector<char> touched(bytes, 'x');
  CHECK(touched.back() == 'x');
  CHECK(post::peak_memory_bytes() > bytes);
  CHECK(post::peak_memory_bytes() < 100 * bytes);
}
