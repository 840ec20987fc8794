#include "cases/runs/results.hpp"

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/files/sinks.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("results: an instant gives a row of history and of reactions, the largest deflection and no factors") {
  const auto file = read(plain, {"discretization.spacing=0.1"});
  const auto plate = plate::discretise(file.content).plate;
  post::ResultsInMemory written;
  plate::Stopwatch stopwatch;
  cases::Outputs outputs({file.content, {{}, true, &written}}, {std::make_unique<post::MemorySink>(written), "", ""},
                         stopwatch);
  const std::vector<post::TipMethods> none;
  cases::Results results(outputs, *plate, none);
  plate::State state = plate::State::Zero(3, Eigen::Index(plate->points()));
  state(0, 7) = -0.25;
  plate->constraints().impose(state);
  const double strain = plate->strain_energy(state);
  results.sample({0, 0, state, {}, 0, strain, strain, 0, -2 * strain}, true);
  CHECK(results.strain_energy() == strain);
  CHECK(results.external_work() == strain);
  results.finish();
  CHECK(outputs.recorder().history().rows.size() == 1);
  CHECK(outputs.summary().srif.empty());
  REQUIRE(outputs.summary().reactions);
  REQUIRE(!outputs.summary().extremes.empty());
  CHECK(outputs.summary().extremes[0].quantity == "w");
  CHECK(outputs.summary().extremes[0].value == -0.25);
  CHECK(outputs.summary().deflection_over_thickness == 0.25 / file.content.section.thickness);
}
