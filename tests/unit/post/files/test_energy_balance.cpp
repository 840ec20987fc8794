#include "post/files/result_checks.hpp"

#include "cases/driver/prepared.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/statics.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("numbers that are not finite do not pass, and are named") {
  CHECK_NOTHROW(post::require_finite({{"work", 1e308}, {"strain energy", -0.0}}, "at step 3"));
  CHECK_THROWS_WITH(post::require_finite({{"work", 1}, {"strain energy", INFINITY}}, "at step 3"),
                    Catch::Contains("strain energy is inf at step 3"));
  CHECK_THROWS_AS(post::require_finite({{"work", std::nan("")}}, ""), plate::NumericalError);

  post::Srif one;
  one.method = post::SrifMethod::domain_integral;
  CHECK_NOTHROW(post::require_finite(std::vector{one}, ""));
  one.K2 = std::nan("");
  CHECK_THROWS_WITH(post::require_finite(std::vector{one}, "at step 3"),
                    Catch::Contains("K2 is nan by domain_integral at the tip at (0, 0) at step 3"));
  one.K2 = 0, one.G = INFINITY;
  CHECK_THROWS_AS(post::require_finite(std::vector{one}, ""), plate::NumericalError);

  const auto plate = cases::discretised(read(plain, {"discretization.spacing=0.2", "geometry.cracks=[]"})).plate;
  plate::State state = plate::State::Ones(3, 7);
  CHECK_NOTHROW(post::require_finite(state, "", *plate));
  state(2, 4) = std::nan("");
  CHECK_THROWS_WITH(post::require_finite(state, "in equilibrium", *plate),
                    Catch::Contains("point 4 is not finite in equilibrium"));
  state(2, 4) = -INFINITY;
  CHECK_THROWS_AS(post::require_finite(state, "", *plate), plate::NumericalError);
}

TEST_CASE("the energy of a plate is the work of its loads") {
  using post::EnergyBalance;
  EnergyBalance moves(EnergyBalance::Plate::moves);
  moves.check({0, -0.5, 0}, "");  // half a step before the start
  moves.check({1, -0.5 + 1e-10, 0}, "");
  moves.check({5, 4.5, 5.001}, "");
  moves.check({0, -0.46, 0}, "");  // nearly all taken back
  CHECK_THROWS_AS(moves.check({0, -0.56, 0}, ""), plate::NumericalError);
  CHECK_THROWS_WITH(moves.check({5.1, 4.6, 5}, "at step 7"),
                    Catch::Contains("energy of 5.1 at step 7, but the loads have done a work of 5:"));
  EnergyBalance grows(EnergyBalance::Plate::grows);
  grows.check({1, 0, 0}, "");
  grows.check({5, 0, 1}, "");  // bonds take energy with them
  CHECK_THROWS_AS(grows.check({5, 0, 1}, ""), plate::NumericalError);
  EnergyBalance rests(EnergyBalance::Plate::rests);
  rests.check({1, 1, 1.001}, "");
  CHECK_THROWS_AS(rests.check({1, 1, 1.02}, ""), plate::NumericalError);
  CHECK_THROWS_AS(EnergyBalance(EnergyBalance::Plate::rests).check({1e-300, 1e-300, 0}, ""), plate::NumericalError);
}

TEST_CASE("a plate under a load moves") {
  std::vector<std::string> warnings;
  const auto passes = [&](const std::vector<std::string>& settings) {
    const auto file = read(plain, settings);
    const auto plate = cases::discretised(file).plate;
    const auto load = plate->total_load();
    const auto state = plate::static_solution(*plate, file.content.analysis, {1e-6, 10000, {}}).solution.state;
    warnings.clear();
    post::require_motion(*plate, {load}, state, load.cwiseProduct(state).sum() / 2, warnings);
    return warnings.empty();
  };
  const std::string coarse = "discretization.spacing=0.2", whole = "geometry.cracks=[]";
  CHECK(passes({coarse, whole}));
  CHECK(passes({coarse, whole, "load[0].value=1e-120"}));
  CHECK_THROWS_AS(passes({coarse, whole, "load[0].value=1e-150"}), plate::NumericalError);
  CHECK_THROWS_WITH(passes({coarse, whole, "load[0].value=1e-170"}),
                    Catch::Contains("nothing has moved although loads act"));
  CHECK_FALSE(passes({coarse, whole, "discretization.formulation=galerkin",
                      "load=[{kind=\"line_load\",along=[[-1,-1],[-1,1]],value=1}]"}));  // along a clamped edge
  CHECK_THAT(warnings.at(0), Catch::Contains("no load reaches"));
}

TEST_CASE("a plate under loads that cancel stays at rest, with a word") {
  const auto file = read(plain, {"discretization.spacing=0.2", "geometry.cracks=[]",
                                 "load=[{kind=\"pressure\",value=1},{kind=\"pressure\",value=-1}]"});
  const auto plate = cases::discretised(file).plate;
  const auto result = plate::static_solution(*plate, file.content.analysis, {1e-6, 10000, {}});
  CHECK(post::is_zero(result.solution.state, *plate));
  std::vector<std::string> warnings;
  post::require_motion(*plate, post::forces_of(*plate), result.solution.state, 0, warnings);
  CHECK_THAT(warnings.at(0), Catch::Contains("the loads cancel"));
}
