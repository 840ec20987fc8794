#include "cases/driver/prepared.hpp"

#include "cases/driver/run.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "post/files/summary.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using case_text::plain;
using case_text::probed_motion;

TEST_CASE("Lanczos vectors: a plate that nothing holds is refused") {
  std::string text = probed_motion("method = \"lanczos\"\n");
  text.replace(text.find("kind = \"clamped\""), 16, "kind = \"free\"");
  const small_run::TemporaryFolder folder;
  CHECK_THROWS_WITH(cases::run(case_text::read(text), {folder.path(), true}),
                    Catch::Contains("needs a plate that supports hold"));
  CHECK(std::filesystem::is_empty(folder.path()));
  // graded points take steps then, where the case states nothing
  text.erase(text.find("method = \"lanczos\"\n"), 19);
  const auto summary = cases::run(case_text::read(text, {"discretization.tip_spacing=0.04", "analysis.duration=0.01"}),
                                  {folder.path(), true});
  CHECK(summary.analysis.method == "central_difference");
}

TEST_CASE(
    "stiffness damping: Lanczos vectors are chosen where they are to be had, else many steps are told of, or it "
    "relaxes") {
  const std::vector<std::string> damped{"analysis.damping={mass=0, stiffness=0.2}", "discretization.spacing=0.1"};
  const cases::Prepared motion(case_text::read(probed_motion(), damped));
  CHECK(motion.file.content.analysis.method == cases::Analysis::Method::lanczos);
  const auto with = [&](const std::string& more) {
    auto all = damped;
    all.push_back(more);
    return case_text::read(probed_motion(), all).content.analysis.method;
  };
  CHECK(with("analysis.safety=0.9") == cases::Analysis::Method::central_difference);
  CHECK(with("analysis.method=central_difference") == cases::Analysis::Method::central_difference);
  CHECK(with("discretization.formulation=ordinary") == cases::Analysis::Method::central_difference);
  CHECK(with("analysis.damping={mass=0.2, stiffness=0}") == cases::Analysis::Method::central_difference);
  auto steps = damped;
  steps.push_back("analysis.method=central_difference"), steps.push_back("analysis.damping={mass=0, stiffness=20}");
  const cases::Prepared many(case_text::read(probed_motion(), steps));
  CHECK(many.steps->grid.steps > 100000);
  CHECK_THAT(many.warnings.back(), Catch::Contains("shortens the stable step"));
  steps.back() = "analysis.damping={mass=0, stiffness=0.01}";
  const cases::Prepared relaxing(case_text::read(probed_motion(), steps));
  steps.back() = "analysis.damping={mass=1, stiffness=0}";
  const cases::Prepared undamped(case_text::read(probed_motion(), steps));
  CHECK(relaxing.steps->limit == Approx(undamped.steps->limit / 2));
  CHECK(relaxing.steps->grid.relaxation == Approx(0.01 / 3));
  CHECK_THAT(relaxing.warnings.back(), Catch::Contains("set analysis.time_step"));
}

TEST_CASE("damping ratios on graded points take at most twice the steps, where exact damping would take far more") {
  const auto motion = [](const std::string& damping) {
    std::vector<std::string> settings{"discretization.spacing=0.1", "discretization.tip_spacing=0.02",
                                      "analysis.method=central_difference"};
    if (!damping.empty()) settings.push_back("analysis.damping=" + damping);
    return cases::Prepared(case_text::read(probed_motion(), settings));
  };
  const auto undamped = motion(""), damped = motion("{ratio=[0.02, 0.02], frequencies=[0.2, 2.0]}");
  const double free = undamped.steps->limit, exact = plate::stable_step(free, *damped.file.content.analysis.damping);
  CAPTURE(free, exact, damped.steps->limit, undamped.steps->grid.steps, damped.steps->grid.steps);
  CHECK(exact < free / 3);
  CHECK(damped.steps->grid.relaxation > 0);
  CHECK(damped.steps->limit == Approx(free / 2));
  CHECK(damped.steps->grid.steps > undamped.steps->grid.steps);
  CHECK(damped.steps->grid.steps <= 2 * undamped.steps->grid.steps + 2);
}

TEST_CASE("accuracy in motion: a plate that nothing holds and one that is to take steps are refused") {
  const auto found = case_text::problems(probed_motion(), {"srif.accuracy=0.05", "analysis.method=central_difference"});
  REQUIRE(found.size() == 1);
  CHECK(found[0].key == "srif.accuracy");
  CHECK_THAT(found[0].what, Catch::Contains("Lanczos vectors"));

  std::string free = probed_motion();
  free.replace(free.find("kind = \"clamped\""), 16, "kind = \"free\"");
  const small_run::TemporaryFolder folder;
  CHECK_THROWS_WITH(cases::run(case_text::read(free, {"srif.accuracy=0.05"}), {folder / "free", true}),
                    Catch::Contains("supports hold"));
  CHECK_FALSE(std::filesystem::exists(folder / "free"));
}

TEST_CASE("prepared: a motion has its steps, none above the stable one, and methods where factors are wanted") {
  const std::vector<std::string> coarse{"discretization.spacing=0.1", "analysis.method=central_difference"};
  const cases::Prepared motion(case_text::read(probed_motion(), coarse));
  REQUIRE(motion.steps);
  CHECK(motion.steps->limit > 0);
  CHECK(motion.steps->grid.time_step <= motion.steps->limit);
  CHECK(motion.steps->grid.time_step * double(motion.steps->grid.steps) == Approx(0.4));
  CHECK(motion.tip_methods.size() == 2);
  CHECK(motion.plate->held());
  auto asks = coarse;
  asks.push_back("analysis.time_step=1");
  try {
    const cases::Prepared refused(case_text::read(probed_motion(), asks));
    FAIL("it was taken");
  } catch (const cases::CaseError& error) {
    REQUIRE(error.problems().size() == 1);
    CHECK(error.problems()[0].key == "analysis.time_step");
  }
  const cases::Prepared still(case_text::read(plain, {"discretization.spacing=0.1"}));
  CHECK_FALSE(still.steps);
  CHECK(still.tip_methods.empty());
}

TEST_CASE("prepared: a load so fast that steps miss points is told, with a speed at which they do not") {
  const auto said = [](const std::string& speed) {
    const cases::Prepared motion(
        case_text::read(probed_motion(),
                        {"discretization.spacing=0.1", "geometry.cracks=[]", "-srif",
                         "load=[{kind='point_force', value=1, path=[[-0.5, 0.0], [0.5, 0.0]], speed=" + speed + "}]"}));
    return std::ranges::count_if(motion.warnings,
                                 [](const auto& one) { return one.find("load[0].speed = ") != one.npos; });
  };
  CHECK(said("1e9") == 1);
  CHECK(said("1") == 0);
}

TEST_CASE("prepared: reactions of a damped motion balance its loads from the start on") {
  const std::string stiffness = GENERATE("0.0", "0.01");  // the second relaxes
  std::string text = probed_motion("damping = { mass = 5.0, stiffness = " + stiffness + " }\n");
  text.replace(text.find("kind = \"clamped\""), 16, "kind = \"simply_supported\"");
  const small_run::TemporaryFolder folder;
  const auto summary =
      cases::run(case_text::read(text, {"discretization.spacing=0.1", "discretization.formulation=ordinary", "-srif",
                                        "geometry.cracks=[]", "support[0].edges=['left','right','bottom','top']",
                                        "initial.velocity='cos(1.5*x)*cos(1.5*y)'", "analysis.duration=0.4"}),
                 {folder.path(), true});
  REQUIRE(summary.reactions);
  CHECK(summary.reactions->largest_residual < 1e-10);  // measured: 3e-14; 0.014 before at the start
}
