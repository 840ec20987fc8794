// A case that says how well its results are to be known.
#include "cases/driver/targets.hpp"

#include <nlohmann/json.hpp>

#include "cases/driver/run.hpp"
#include "post/files/summary.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using case_text::expect;
using case_text::plain;
using case_text::with_line;

namespace {

/// The plain plate without cracks and spacing; `accuracy`: lines of its table.
std::string unmeshed(const std::string& accuracy, const std::string& analysis = "static") {
  std::string text = with_line(plain, 17, "kind = \"" + analysis + "\"");
  for (const std::string line : {"cracks = [[[-0.3, 0.0], [0.3, 0.0]]]\n", "[discretization]\n", "spacing = 0.05\n"})
    text.erase(text.find(line), line.size());
  if (analysis == "frequencies") {
    text.insert(text.find("thickness"), "density = 1.0\n");
    text.erase(text.find("[[load]]"), text.find("[analysis]") - text.find("[[load]]"));
  }
  return text + "[accuracy]\n" + accuracy + "\n[output]\nfields = []\n";
}

const std::string held = "support[0].edges=['left','right','bottom','top']";

post::Summary run_case(const std::string& text, const std::vector<std::string>& settings = {}) {
  const small_run::TemporaryFolder folder;
  return cases::run(case_text::read(text, settings), {folder / "run", true});
}

}  // namespace

TEST_CASE("targets: errors over results, of reactions over the largest force, of load cases the worst") {
  post::Summary summary;
  auto found = cases::targets_of({.deflection = 0.1, .stress = 0.2, .reactions = 0.3, .frequencies = {}});
  REQUIRE(found.targets.size() == 3);
  summary.extremes = {{"w", {}, -2, 0, {}, {}, 0.1}, {"von_mises", {}, 50, 0, {}, {}}};
  summary.reactions.emplace();
  summary.reactions->supports = {{"left", {}}, {"right", {}}};
  summary.reactions->balance.supports = {{10, 0, 0}, {-40, 0, 0}};
  summary.reactions->errors = {{1, 0, 0}, {2, 0, 0}};
  cases::set_reached(summary, found);
  CHECK(found.targets[0].reached.value() == Approx(0.05));
  CHECK(!found.targets[1].reached);
  CHECK(found.targets[2].reached.value() == Approx(0.05));
  summary.load_cases.resize(2);
  summary.load_cases[0].extremes = {{"w", {}, 1, 0, {}, {}, 0.01}};
  summary.load_cases[1].extremes = {{"w", {}, 0.1, 0, {}, {}, 0.01}};
  cases::set_reached(summary, found);
  CHECK(found.targets[0].reached.value() == Approx(0.1));
  CHECK(!found.targets[2].reached);
}

TEST_CASE("targets: a clamped square reaches what is asked, and its errors hold") {
  constexpr double finest = 0.01;  // whose own errors do not count
  const auto fine = run_case(plain, {held, "geometry.cracks=[]", "discretization.spacing=" + std::to_string(finest)});
  const std::vector<std::string> accuracy{"deflection = 0.02\nreactions = 0.05\nstress = 0.1"};
  const auto summary = run_case(unmeshed(accuracy.front()), {held});
  REQUIRE(summary.targets);
  CHECK(summary.targets->ended_by.empty());
  CHECK(summary.targets->path.size() >= 2);
  CHECK(summary.points == summary.targets->path.back().points);
  CHECK(summary.points < 10000);
  for (const auto& one : summary.targets->targets) CHECK(one.reached.value() <= one.asked);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto &own = summary.extremes[i], &truth = fine.extremes[i];
    CAPTURE(own.quantity, own.value, truth.value, *own.error);
    CHECK(std::abs(own.value - truth.value) <= *own.error);
  }
  CHECK(summary.warnings.empty());
}

TEST_CASE("targets: frequencies, with bonds too, and load cases") {
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    const auto summary = run_case(unmeshed("frequencies = 0.05", "frequencies"),
                                  {held, "discretization.formulation=" + formulation, "analysis.modes=3"});
    REQUIRE(summary.targets);
    CAPTURE(formulation, summary.points, summary.targets->ended_by);
    CHECK(summary.targets->ended_by.empty());
    for (const auto& one : summary.frequencies) CHECK(*one.error <= 0.05 * one.frequency);
  }
  const std::string two =
      "case=[{name='a',load=[{kind='pressure',value=1}]},"
      "{name='b',load=[{kind='point_force',position=[0.3,0.2],value=1}]}]";
  const auto cases = run_case(unmeshed("deflection = 0.05"), {held, "-load", two});
  REQUIRE(cases.load_cases.size() == 2);
  for (const auto& one : cases.load_cases) CHECK(*one.extremes[0].error <= 0.05 * std::abs(one.extremes[0].value));
}

TEST_CASE("targets: what ends the search before is said, with the best results") {
  const auto summary = run_case(unmeshed("deflection = 0.0001\nseconds = 1e-3"), {held});
  REQUIRE(summary.targets);
  CHECK(summary.targets->ended_by == "accuracy.seconds");
  CHECK(summary.targets->outcome() == "accuracy.seconds");
  REQUIRE(summary.warnings.size() == 1);
  CHECK_THAT(summary.warnings[0], Catch::Contains("accuracy not reached, of deflection to 0.0001"));
}

TEST_CASE("targets: their results are written, and the resolved case gives the same again") {
  const small_run::TemporaryFolder folder;
  const auto summary = cases::run(case_text::read(unmeshed("deflection = 0.05"), {held}), {folder / "first", true});
  const auto json = nlohmann::json::parse(small_run::text_of(folder / "first/summary.json"));
  CHECK(json["targets"]["outcome"] == "reached");
  CHECK(json["targets"]["results"][0]["of"] == "deflection");
  CHECK(json["targets"]["results"][0]["accuracy_reached"] <= 0.05);
  CHECK(json["targets"]["path"].size() == summary.targets->path.size());
  const auto again = cases::run(cases::read_case(folder / "first/case.resolved.toml", {}), {folder / "again", true});
  CHECK(again.extremes[0].value == summary.extremes[0].value);
  REQUIRE(again.warnings.size() == 1);
  CHECK_THAT(again.warnings[0], Catch::Contains("[accuracy] finds the lengths of the discretisation: spacing"));
}

TEST_CASE("targets: what makes no sense is refused before anything is computed") {
  const auto with = [](const std::string& lines) { return unmeshed(lines); };
  expect(with(""), ":15", "accuracy", "names no result");
  expect(with("deflection = 0"), ":16", "accuracy.deflection", "[0.0001, 0.5]");
  expect(with("deflections = 0.1"), ":16", "accuracy.deflections", "deflection");
  expect(with("frequencies = 0.1"), ":16", "accuracy.frequencies", "is used in frequencies only");
  expect(with("deflection = 0.1") + "errors = false\n", ":19", "output.errors", "[accuracy]");
  expect(unmeshed("deflection = 0.1", "frequencies"), ":14", "accuracy.deflection", "is used in statics only");
}
