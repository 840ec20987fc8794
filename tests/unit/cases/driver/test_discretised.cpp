#include "cases/driver/prepared.hpp"

#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

/// The problems of a case that reads: of its plate.
template <typename Make>
std::vector<cases::Problem> refused(const Make& make) {
  try {
    make();
  } catch (const cases::CaseError& error) {
    return error.problems();
  }
  return {};
}

const std::string growing =
    with_line(plain, 7, "cracks = [[[-0.95, 0.0], [0.3, 0.0]]]") + "[growth]\nfracture_energy = 1\n";

}  // namespace

TEST_CASE("discretised: what the plate refuses and probes without points are told together, with their keys") {
  auto file =
      read(plain, {"discretization.formulation=ordinary", "discretization.spacing=0.1", "support[0].kind=free"});
  file.content.output.probes["far"] = {3, 3};
  file.content.output.probes["here"] = {0.5, 0.5};
  const auto found = refused([&] { cases::discretised(file); });
  REQUIRE(found.size() == 2);
  CHECK(found[0].key == "support");
  CHECK_THAT(found[0].what, Catch::Contains("the plate is not held"));
  CHECK(found[1].key == "output.probes.far");
}

TEST_CASE("discretised: more points than the machine can hold are refused before any is made") {
  const auto found = refused([&] { cases::discretised(read(plain, {"discretization.spacing=1e-7"})); });
  REQUIRE(found.size() == 1);
  CHECK(found[0].key == "discretization.spacing");
}

TEST_CASE("growing tips: one without a ring is refused at rest, and stays in motion") {
  std::vector<std::string> warnings;
  const auto check = [&](const std::vector<std::string>& overrides) {
    return refused([&] {
      const auto file = read(growing, overrides);
      cases::check_growing_tips(file, *cases::discretised(file).plate, warnings);
    });
  };
  const auto found = check({});
  REQUIRE(found.size() == 1);
  CHECK(found[0].key == "growth");
  CHECK_THAT(found[0].what, Catch::Contains("tip at (-0.95, 0)"));
  CHECK(warnings.empty());
  CHECK(check({"analysis={kind=\"dynamic\",duration=1}", "section.density=1", "discretization.formulation=ordinary"})
            .empty());
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains("it stays where it is"));
  CHECK(check({"growth.criterion=bond_energy"}).empty());  // bonds need no rings
}
