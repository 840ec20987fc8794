#include "post/report/printed.hpp"

#include <fmt/format.h>

#include "post/files/summary.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

namespace {

post::Srif printed_factors(std::size_t tip, post::SrifMethod method, double K1, double K2, double K3, double error) {
  post::Srif srif;
  srif.tip = tip, srif.method = method, srif.K1 = K1, srif.K2 = K2, srif.K3 = K3, srif.estimated_error = error;
  return srif;
}

post::Summary summary() {
  post::Summary result;
  result.seconds = {{"total", 1.5}};
  result.srif = {printed_factors(0, post::SrifMethod::domain_integral, 2, 3e-11, -0.5, 0.002),
                 printed_factors(0, post::SrifMethod::opening, 1.3, 0, 0, 0.34),
                 printed_factors(1, post::SrifMethod::domain_integral, 1, 0.5, 1e-5, 0.002)};
  result.srif[2].resolved[2] = false;
  return result;
}

std::size_t place(const std::string& text, const std::string& part) {
  INFO(text);
  const auto found = text.find(part);
  REQUIRE(found != std::string::npos);
  return found;
}

}  // namespace

TEST_CASE("printed: the recommended method of every tip first, the others below as a comparison") {
  const auto text = post::printed(summary(), false, 0.1, "there");
  const auto comparison = place(text, "for comparison");
  CHECK(text.rfind("domain_integral") < comparison);
  CHECK(place(text, "opening") > comparison);
  CHECK(place(text, "34 %  opening   (rough)") > comparison);
  CHECK(text.find("e-11") == std::string::npos);   // noise is 0
  CHECK(text.find("1e-05") == std::string::npos);  // not resolved
  CHECK(text.find("[m]") == std::string::npos);
  CHECK_THAT(text, Catch::EndsWith("results in there\n"));
}

TEST_CASE("printed: the report is named where it was written") {
  const small_run::TemporaryFolder folder;
  const auto path = folder / "report.html";
  CHECK(post::results_in(folder.path()) == "results in " + folder.path().string() + "\n");
  std::ofstream(path) << "page";
  CHECK(post::printed(summary(), false, 0.1, folder.path()).ends_with("; report: " + path.string() + "\n"));
}

TEST_CASE("printed: units of SI, and what is larger than its estimated error is no 0") {
  auto content = summary();
  content.srif[0].K2 = 3e-7, content.srif[0].errors[1] = 1e-7;
  const auto text = post::printed(content, true, 0.1, "there");
  CHECK_THAT(text, Catch::Contains("[N m^1/2]") && Catch::Contains("[N m^-1/2]") && Catch::Contains("3e-07"));
  content.srif.pop_back(), content.srif.erase(content.srif.begin() + 1);
  CHECK(post::printed(content, true, 0.1, "there").find("comparison") == std::string::npos);
}

TEST_CASE("printed: peaks of a motion with their times") {
  auto content = summary();
  CHECK(post::printed(content, false, 0.1, "there").find("over time") == std::string::npos);
  content.peaks = {{"K1", 1, -2.5, 0.125, {}, {}},
                   {"K2", 1, 1e-9, 0.5, {}, {}},
                   {"utilisation", 1, 1e-8, 0.375, {}, {}},
                   {"w", std::nullopt, 0.75, 0.25, geometry::Point(3, 4), {}}};
  const auto text = post::printed(content, false, 0.1, "there");
  CHECK(place(text, "at the end of the duration") < place(text, "largest over time"));
  CHECK_THAT(text, Catch::Contains("-2.5 at t = 0.125") && Catch::Contains("|w|") &&
                       Catch::Contains("0.75 at t = 0.25 at (3, 4)") && Catch::Contains("at t = 0.375\n"));
  CHECK(text.find("at t = 0.5\n") == std::string::npos);  // noise
}

TEST_CASE("printed: the error of a row is of the factors that it has") {
  auto content = summary();
  content.srif = {printed_factors(0, post::SrifMethod::domain_integral, 2, 0.5, 40, 3)};
  content.srif[0].errors = {0.02, 0.05, 120.0};
  CHECK_THAT(post::printed(content, false, 0.1, "there"), Catch::Contains("> 100 %") && Catch::Contains("(rough)"));
  content.srif[0].resolved[2] = false;
  CHECK_THAT(post::printed(content, false, 0.1, "there"), Catch::Contains(" 2.5 %") && !Catch::Contains("(rough)"));
}

TEST_CASE("printed: whether K3 is nothing depends on K3 times the thickness, not on the unit of length") {
  auto content = summary();
  content.srif = {printed_factors(0, post::SrifMethod::domain_integral, 2, 1, 5e-5, 0.002)};
  content.srif[0].errors = {0.002, 0.002, 1e-3};
  for (const double thickness : {0.01, 0.1, 1.0}) {
    content.srif[0].K3 = 1e-7 / thickness;  // 5e-8 of K1
    CHECK_THAT(post::printed(content, false, thickness, "there"),
               !Catch::Contains(fmt::format("{:g}", 1e-7 / thickness)));
    content.srif[0].K3 = 1e-3 / thickness;
    CHECK_THAT(post::printed(content, false, thickness, "there"),
               Catch::Contains(fmt::format("{:g}", 1e-3 / thickness)));
  }
}

TEST_CASE(
    "printed: factors at the faces in SI units or with a toughness, reactions with their balance, the deflection") {
  auto content = summary();
  const plate::Section section{1, 0.3, 0.1, 5.0 / 6, 0};
  for (const auto& srif : content.srif) content.faces.push_back(post::at_faces(srif, section, std::nullopt));
  CHECK(post::printed(content, false, 0.1, "there").find("K_I") == std::string::npos);
  CHECK_THAT(post::printed(content, true, 0.1, "there"),
             Catch::Contains("[Pa m^1/2]") && Catch::Contains("2126.9") && !Catch::Contains("toughness"));
  content.toughness = 4000;
  for (std::size_t i = 0; i < 3; ++i) content.faces[i] = post::at_faces(content.srif[i], section, 4000.0);
  CHECK_THAT(post::printed(content, false, 0.1, "there"), Catch::Contains("0.532") && Catch::Contains("of toughness"));

  content.reactions = post::ReactionSummary{
      {{"left", {}}, {"pin0", geometry::Point(1, 2)}}, 0, {{{-3, 0, 0}, {1e-12, 0, 0}}, {3, 0, 0}, {}, 2e-9}, 2e-9, {}};
  CHECK_THAT(post::printed(content, true, 0.1, "there"),
             Catch::Contains("reactions along w [N]: left -3, pin0 0; loads 3; balanced to 2.0e-09"));
  content.analysis.iterations = 7, content.membrane = post::MembraneSummary{};
  content.membrane->reactions = {{"left", {-3, 1e-12}}}, content.membrane->largest_displacement = 0.5;
  CHECK_THAT(post::printed(content, true, 0.1, "there"),
             Catch::Contains("reactions in the plane [N]: left (-3, 0); largest displacement there 0.5 m") &&
                 !Catch::Contains("loaded in its plane alone"));
  content.membrane.reset();
  CHECK_THAT(post::printed(content, false, 0.1, "there"), !Catch::Contains("multipliers"));
  content.multipliers = 0.123;
  CHECK_THAT(post::printed(content, false, 0.1, "there"),
             Catch::Contains("multipliers add forces of 0.12 of the loads"));
  content.deflection_over_thickness = 0.4;
  CHECK_THAT(post::printed(content, false, 0.1, "there"), !Catch::Contains("x thickness"));
  content.deflection_over_thickness = 6e8;
  CHECK_THAT(post::printed(content, false, 0.1, "there"), Catch::Contains("6e+08 x thickness"));
  CHECK_THAT(post::printed(content, true, 0.1, "there"), !Catch::Contains("x thickness"));  // a warning says it
  content.linear_theory_off = 0.354;
  CHECK_THAT(post::printed(content, false, 0.1, "there"),
             Catch::Contains("linear theory overstates deflections by about 35 %") && !Catch::Contains("x thickness"));
  CHECK_THAT(post::printed(content, true, 0.1, "there"), !Catch::Contains("linear theory"));
}
