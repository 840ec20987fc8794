// What all summaries say alike: factors at the faces, cracks that would grow, deflections beyond the theory.
#include "post/report/conclusion.hpp"

#include "plate/model/problem.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "post/report/reactions.hpp"
#include "tests/catch.hpp"

namespace {

const plate::Section concluded_section{1, 0.3, 0.1, 5.0 / 6, 0};

post::Srif factor_of(std::size_t tip, double K1) {
  post::Srif srif;
  srif.tip = tip, srif.K1 = K1;
  srif.errors = {0.01, 0.01, 0.01};
  return srif;
}

post::Summary concluded(double deflection, bool si, std::optional<double> toughness) {
  post::SrifOptions options;
  options.toughness = toughness;
  const std::optional<post::SrifOptions> given = options;
  const post::Table history{{"time", "max_abs_w"}, {{0.0, 0.0}, {0.5, deflection}, {1.0, deflection / 2}}};
  post::Summary summary;
  post::conclude(summary,
                 {concluded_section, given, si, history, {}, {factor_of(0, 1), factor_of(0, 50), factor_of(1, -2)}});
  return summary;
}

}  // namespace

TEST_CASE("conclusion: deflections beyond half a thickness are warned of in SI units, and stated in all") {
  for (const double w : {0.0, 0.049, 0.051, 4e7})
    for (const bool si : {false, true}) {
      const auto summary = concluded(w, si, std::nullopt);
      CHECK(*summary.deflection_over_thickness == Approx(w / 0.1));
      CHECK(summary.warnings.size() == (si && w > 0.05 ? 1 : 0));
    }
  CHECK_THAT(concluded(6e7, true, std::nullopt).warnings.at(0),
             Catch::Contains("largest deflection is 6e+08 x thickness"));
  const std::optional<post::SrifOptions> none;
  post::Summary frequencies;
  post::conclude(frequencies, {concluded_section, none, true, {{"time", "max_abs_w"}, {}}, {}, {}});
  CHECK_FALSE(frequencies.deflection_over_thickness);
  CHECK_FALSE(frequencies.reactions);
}

TEST_CASE("conclusion: an estimate of the error of linear theory takes the place of the limit of deflections") {
  const post::Table history{{"time", "max_abs_w"}, {{0.0, 0.2}}};
  const std::optional<post::SrifOptions> none;
  for (const auto& [off, words] :
       std::vector<std::pair<double, std::string>>{{0.049, ""},
                                                   {0.354, "linear theory overstates deflections by about 35 %"},
                                                   {-0.2, "linear theory understates deflections by about 20 %"}})
    for (const bool si : {false, true}) {
      post::Summary summary;
      summary.linear_theory_off = off;
      post::conclude(summary, {concluded_section, none, si, history, {}, {}});
      CHECK(post::error_of_linear_theory(summary.linear_theory_off) == words);
      CHECK(summary.warnings == (si && !words.empty() ? std::vector<std::string>{words + "; set `nonlinear` = true"}
                                                      : std::vector<std::string>()));
    }
}

TEST_CASE("conclusion: tips that reach the toughness by their recommended method, or at any time of a motion") {
  auto summary = concluded(0, false, 1500.0);  // K_I = 1063, 2127
  REQUIRE(summary.faces.size() == 3);
  CHECK(*summary.faces[2].utilisation == Approx(std::sqrt(M_PI) * 600 * 2 / 1500));
  CHECK(
      post::tips_that_grow(summary) ==
      std::vector<std::string>{"tip 1: the equivalent K is 1.42 times the toughness: the crack grows; set loads below "
                               "0.71 of these"});
  CHECK(post::tips_that_grow(concluded(0, false, std::nullopt)).empty());
  summary.peaks = {{"K1", 0, 7, 0, {}, {}}, {"utilisation", 0, 1, 0.25, {}, {}}, {"utilisation", 1, 0.99, 0.5, {}, {}}};
  CHECK(post::tips_that_grow(summary) ==
        std::vector<std::string>{"tip 0: the equivalent K is 1 times the toughness at t = 0.25: the crack grows; set "
                                 "loads below 1 of these"});
}

TEST_CASE("conclusion: point supports that sink in are named, by the reaction and the plate about them") {
  plate::Problem problem;
  problem.section = concluded_section, problem.outline = geometry::rectangle(0, 0, 1, 1);
  const auto said = [&](const geometry::Point& at, double force, const std::string& name = "pin1") {
    post::ReactionSummary reactions;
    reactions.supports = {{"left", {}}, {name, at}};
    reactions.largest = {{0, 100}, {0, force}};
    return post::sinking_supports(reactions, problem, 1);
  };
  const double S = concluded_section.shear_stiffness(),
               force = 0.02 * 2 * std::acos(-1.0) * S / std::log(2.0);  // 2 % inside
  REQUIRE(said({0.5, 0.5}, force).size() == 1);
  CHECK_THAT(said({0.5, 0.5}, force)[0], Catch::Contains("pin1 is a single point: deflections grow by 2 %"));
  CHECK_THAT(said({0.5, 0}, force)[0], Catch::Contains("4 %"));
  CHECK_THAT(said({1, 1}, -force)[0], Catch::Contains("8 %"));
  CHECK(said({0.5, 0.5}, force / 10).empty());
  CHECK(said({0.5, 0.5}, force, "spring0").empty());
  CHECK(post::sinking_supports({}, problem, 1).empty());
}

TEST_CASE("conclusion: reactions that rounding leaves beside soft hubs are told, with a stiffness that is enough") {
  plate::Problem problem;
  problem.supports = {{plate::SupportKind::clamped, {"left"}, {}}, {plate::SupportKind::hub, {"hole0"}, {}}};
  post::ReactionSummary reactions;
  reactions.largest_residual = 4e-3;
  CHECK(post::unbalanced_hubs(reactions, problem).empty());
  problem.supports[1].k_w = 1e-3;
  const auto said = post::unbalanced_hubs(reactions, problem);
  REQUIRE(said.size() == 1);
  CHECK_THAT(said[0],
             Catch::Contains("balance the loads to 0.4 % only") && Catch::Contains("k_w = 0.4 or more in `support 1`"));
  reactions.largest_residual = 1e-4;
  CHECK(post::unbalanced_hubs(reactions, problem).empty());
}
