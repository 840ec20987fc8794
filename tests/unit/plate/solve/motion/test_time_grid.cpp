#include "plate/solve/motion/time_grid.hpp"

#include "cases/driver/prepared.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

const std::string moving = with_line(plain, 17, "kind = \"dynamic\"\nduration = 1") + "[output]\n";

plate::TimeGrid grid(const std::vector<std::string>& settings, double limit = 0.01) {
  auto all = settings;
  all.emplace_back("section.density=1");
  return cases::time_grid(read(moving, all), limit);
}

/// The key and the text of what is refused.
std::pair<std::string, std::string> refused(const std::vector<std::string>& settings, double limit = 0.01) {
  try {
    grid(settings, limit);
  } catch (const cases::CaseError& error) {
    REQUIRE(error.problems().size() == 1);
    return {error.problems()[0].key, error.problems()[0].what};
  }
  return {};
}

}  // namespace

TEST_CASE("steps end on the rows of history, below the stable step") {
  const auto usual = grid({});
  CHECK(usual.steps_per_row == 1);
  CHECK(usual.steps == 400);
  CHECK(usual.time_step == 1.0 / 400);
  const auto few = grid({"output.history_every=0.1"});
  CHECK(few.steps_per_row == 11);  // 0.1 / (0.95 0.01), rounded up
  CHECK(few.steps == 110);
  const auto given = grid({"analysis.time_step=0.003", "output.history_every=0.03"});
  CHECK(given.steps == 334);
  CHECK(given.steps_per_row == 10);
  CHECK(grid({"analysis.time_step=0.003", "output.history_every=1e300"}).steps_per_row >= 334);
  CHECK(grid({"analysis.duration=1e-5"}).steps == 400);
}

TEST_CASE("numbers of steps that cannot be counted are refused") {
  CHECK(refused({"analysis.duration=1e300"}).first == "analysis.duration");
  CHECK(refused({"analysis.duration=1e20"}).first == "analysis.duration");
  CHECK(refused({"analysis.duration=5e-324"}).first == "analysis.duration");
  CHECK(refused({"analysis.duration=5e-324", "output.history_every=1"}).first ==
        "analysis.duration");  // one row, but no step
  CHECK(refused({"analysis.time_step=1e-25"}).first == "analysis.time_step");
  CHECK(refused({"output.history_every=1e-12"}).first == "output.history_every");
  CHECK(refused({}, INFINITY).first == "section.density");
  CHECK(refused({}, std::nan("")).first == "section.density");
  CHECK(refused({}, 0).first == "section.density");
  CHECK(refused({"analysis.time_step=1e-25"}).second ==
        "a duration of 1 in steps of 1e-25 is 1e+25 steps: between 1 and 1e+12 can be counted");
}

TEST_CASE("a given time step keeps the distance from the stable one that growth needs") {
  const std::vector<std::string> tips{"growth={fracture_energy=1}"},
      bonds{"growth={fracture_energy=1, criterion=\"bond_energy\"}"};
  const auto with = [](std::vector<std::string> settings, const std::string& step) {
    settings.push_back("analysis.time_step=" + step);
    return refused(settings).first;
  };
  CHECK(with({}, "0.01") == "");
  CHECK(with({}, "0.0101") == "analysis.time_step");
  CHECK(with(tips, "0.009") == "");
  CHECK(with(tips, "0.0091") == "analysis.time_step");
  CHECK(with(bonds, "0.008") == "");
  CHECK(with(bonds, "0.0081") == "analysis.time_step");
}
