#include "cases/studies/study_files.hpp"

#include <nlohmann/json.hpp>

#include "cases/studies/ledger.hpp"
#include "tests/catch.hpp"

namespace {

cases::StudyRow study_row(const std::vector<std::string>& labels, double error, double seconds, double reference = 2) {
  cases::StudyRow result;
  result.labels = labels;
  result.quantity = "K1", result.place = "tip 0";
  result.computed = reference * (1 + error), result.reference = reference;
  result.seconds = seconds, result.outcome = cases::RunOutcome::done;
  return result;
}

}  // namespace

TEST_CASE("advice: the fastest way to one percent, from the front alone") {
  // 0.05 by adr is beaten by cg in both; 0.025 by cg is the first to 1 %
  const cases::StudyTable study{
      {"spacing", "solver"},
      {study_row({"0.1", "cg"}, 0.1, 0.1), study_row({"0.05", "adr"}, -0.05, 0.9), study_row({"0.05", "cg"}, 0.04, 0.3),
       study_row({"0.025", "cg"}, -0.008, 1.2), study_row({"0.0125", "cg"}, 0.001, 5)}};
  const auto ways = cases::front(study);
  REQUIRE(ways.size() == 4);
  for (std::size_t i = 1; i < ways.size(); ++i) {
    CHECK(ways[i].seconds > ways[i - 1].seconds);
    CHECK(ways[i].error < ways[i - 1].error);
  }
  const auto said = cases::advice(study);
  REQUIRE(said.size() == 1);
  CHECK(said[0] == "for 1 % of K1 at tip 0 take spacing 0.025, solver cg, 1.2 s (error 0.8 %)");
}

TEST_CASE("advice: a way counts by the worst of all problems, and only with an error for each") {
  cases::StudyTable study{{"load", "spacing"}, {}};
  for (const std::string load : {"pressure", "moment"}) {
    const double reference = load == "pressure" ? 1 : 3;
    study.rows.push_back(study_row({load, "0.1"}, load == "pressure" ? 0.001 : 0.06, 0.1, reference));
    study.rows.push_back(study_row({load, "0.05"}, 0.02, load == "pressure" ? 1 : 1.5, reference));
  }
  study.rows.push_back(study_row({"pressure", "0.025"}, 0.001, 0.01, 1));  // the other load has failed
  const auto ways = cases::front(study);
  REQUIRE(ways.size() == 2);
  CHECK(ways[0].labels == std::vector<std::pair<std::string, std::string>>{{"spacing", "0.1"}});
  CHECK(ways[0].error == Approx(0.06));
  CHECK(ways[1].seconds == 1.5);
  CHECK(cases::advice(study)[0] == "nothing here has K1 at tip 0 to 1 %; the most exact, 2 %, is spacing 0.05, 1.5 s");
}

TEST_CASE("advice: none without references") {
  cases::StudyTable study{{"spacing"}, {study_row({"0.1"}, 0, 1)}};
  study.rows[0].reference.reset();
  CHECK(cases::advice(study).empty());
  const auto json = nlohmann::json::parse(cases::to_json("t", study));
  CHECK(json["advice"].empty());
  CHECK(json["outcomes"]["done"] == 1);
}
