#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

const std::vector<std::string> moving{"analysis.kind=dynamic", "analysis.duration=1", "section.density=2"};

std::vector<std::string> with_motion(std::vector<std::string> more) {
  more.insert(more.begin(), moving.begin(), moving.end());
  return more;
}

const std::string hit = "[impact]\nposition = [0.3, 0.2]\nmass = 2\nvelocity = -3\nstiffness = 50\n";

}  // namespace

TEST_CASE("damping is given by mass and stiffness, or by ratios at two frequencies") {
  const auto read_damping = [](const std::string& text) {
    return *read(plain, with_motion({"analysis.damping=" + text})).content.analysis.damping;
  };
  CHECK(read_damping("{ mass = 2, stiffness = 0.5 }").stiffness == 0.5);
  const auto d = read_damping("{ ratio = [0.01, 0.01], frequencies = [1, 3] }");
  CHECK(d.mass > 0);
  CHECK(d.stiffness > 0);
  const auto file = read(plain, with_motion({"analysis.damping={ ratio = [0.01, 0.02], frequencies = [1, 3] }"}));
  const auto again = read(cases::resolved_toml(file.content)).content;
  CHECK(again.analysis.damping->mass == file.content.analysis.damping->mass);
  CHECK(read(plain, moving).content.analysis.damping == std::nullopt);
  const auto refused = [](const std::string& text, const std::string& what, std::vector<std::string> more = {}) {
    more.insert(more.begin(), "analysis.damping=" + text);
    const auto found = problems(plain, with_motion(more));
    INFO(text);
    REQUIRE(found.size() == 1);
    CHECK_THAT(found[0].what, Catch::Contains(what));
  };
  refused("{ mass = -1 }", "-1 given");
  refused("{ mass = 0 }", "damps nothing");
  refused("{ ratio = [0.1, 0.1] }", "belong together");
  refused("{ ratio = [0.1, 0.1], frequencies = [3, 1] }", "must be above the first");
  refused("{ ratio = [0.1, 0.1], frequencies = [1, 3], mass = 1 }", "one pair or the other");
  refused("{ ratio = [0.001, 0.9], frequencies = [1, 2] }", "none may be negative");
  refused("{ stiffness = 1e-6 }", "choose \"double\"",
          {"analysis.precision=mixed", "discretization.formulation=ordinary"});
  CHECK(problems(plain, {"analysis.damping={ mass = 1 }"}).size() == 1);  // statics
}

TEST_CASE("a motion may begin by itself or by an impact, without loads") {
  auto bare = plain;
  bare.erase(bare.find("[[load]]"), bare.find("[analysis]") - bare.find("[[load]]"));
  CHECK(problems(bare, moving).size() == 1);  // nothing loads the plate
  CHECK(problems(bare + "[initial]\ndeflection = \"0.1 * x\"\n", moving).empty());
  CHECK(problems(bare + hit, moving).empty());
  const auto file = read(bare + hit + "[initial]\nvelocity = -2.5\n", moving);
  const auto again = read(cases::resolved_toml(file.content)).content;
  CHECK(again.initial->velocity.text() == "-2.5");
  CHECK(again.impact->stiffness == 50);
  CHECK(again.impact->velocity == -3);
  const auto refused = [&](const std::string& text, const std::string& what, std::vector<std::string> more = {}) {
    const auto found = problems(text, with_motion(more));
    INFO(text);
    REQUIRE(found.size() == 1);
    CHECK_THAT(found[0].what, Catch::Contains(what));
  };
  refused(bare + "[initial]\ndeflection = \"0.1 * z\"\n", "\"z\"");
  refused(plain + "[initial]\ndeflection = 1\n", "another deflection", {"analysis.start=equilibrium"});
  refused(bare + "[initial]\nvelocity = 1\n", "nothing loads the plate", {"analysis.start=equilibrium"});
  refused(bare + hit, "must lie inside", {"impact.position=[3, 0]"});
  refused(bare + hit, "would stay", {"impact.velocity=0"});
  refused(bare + hit, "must be a number > 0", {"impact.mass=0"});
  refused(bare + hit, "bounce off", {"analysis.method=lanczos"});
  refused(bare + hit, "knocked out", {"growth.fracture_energy=1", "growth.fallen=freeze"});
  CHECK(problems(plain + hit).size() == 1);  // statics
}
