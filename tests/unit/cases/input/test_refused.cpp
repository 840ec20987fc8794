#include "cases/input/case_file.hpp"

#include "tests/unit/cases/case_text.hpp"

using namespace case_text;
using plate::Subject;

TEST_CASE("refused: what a plate refuses is a problem of the key that it is about, at its place") {
  const auto file = read(plain);
  const auto problems = cases::problems_of(file, {{Subject::support_edges, 0, "a"}, {Subject::rows, 0, "b"}});
  REQUIRE(problems.size() == 2);
  CHECK(problems[0].key == "support[0].edges");
  CHECK(problems[0].place.ends_with(":12"));
  CHECK(problems[1].key == "output.history_every");
  plate::Problem problem;
  problem.loads.resize(4);
  CHECK(cases::key_of({Subject::load_position, 3, ""}, problem) == "load[3].position");
  problem.load_cases = {{"one", {{}}}, {"two", {{}, {}}}};
  CHECK(cases::key_of({Subject::load_position, 0, ""}, problem) == "load[0].position");
  CHECK(cases::key_of({Subject::load_position, 3, ""}, problem) == "case[1].load[1].position");
  CHECK(cases::key_of_load(problem, 0) == "load[0]");
  CHECK(cases::key_of_load(problem, 1) == "case[0].load[0]");
  CHECK(cases::key_of_load(problem, 3) == "case[1].load[1]");
  CHECK_THROWS_AS(cases::unless_refused(file,
                                        []() -> int {
                                          throw plate::Refused({{Subject::modes, 0, "c"}});
                                        }),
                  cases::CaseError);
  CHECK(cases::unless_refused(file, [] { return 7; }) == 7);
}
