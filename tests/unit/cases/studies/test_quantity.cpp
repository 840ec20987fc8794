#include "post/report/quantity.hpp"

#include "post/report/curve_plot.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/finished_run.hpp"

using finished_run::FinishedRun, small_run::TemporaryFolder;

TEST_CASE("quantities are found at the last time of a run") {
  const FinishedRun run;
  CHECK(run.value({"K1", 0}) == 0.5);  // of two methods the first
  CHECK(run.value({"F1", 0}) == 0.25);
  CHECK(run.value({"K3", 1}) == -2.0);
  CHECK(run.value({"w", {}, "7"}) == 5.0);
  CHECK(run.value({"theta_x", {}, "7"}) == 6.0);
  CHECK(run.value({"w", {}, "b"}) == 7.0);
  CHECK(run.value({"strain_energy"}) == 11.0);
  CHECK_FALSE(run.value({"K1", 2}));
  CHECK_FALSE(run.value({"F2", 0}));
  CHECK_FALSE(run.value({"F3", 1}));
  CHECK_FALSE(run.value({"w", {}, "c"}));
  CHECK_FALSE(run.value({"theta_x", {}, "b"}));
  const TemporaryFolder empty;
  CHECK_FALSE(post::value({"strain_energy"}, run.summary, empty.path()));
}

TEST_CASE("of several methods the one that is named counts") {
  const FinishedRun run;
  CHECK(run.value({"K1", 0, {}, "domain_integral"}) == 0.5);
  CHECK(run.value({"K1", 0, {}, "series_fit"}) == 99.0);
  CHECK_FALSE(run.value({"K1", 1, {}, "series_fit"}));
  CHECK(post::lack({"K1", 1, {}, "series_fit"}, run.summary) == "tip 1 has no method series_fit, but domain_integral");
  CHECK(post::lack({"F2", 0, {}, "series_fit"}, run.summary) == "the results have no F2 of tip 0 by series_fit");
  CHECK(post::lack({"K1", 7, {}, "series_fit"}, run.summary) == "the results have no K1 of tip 7 by series_fit");
  CHECK(post::lack({"strain_energy"}, run.summary) == "the results have no strain_energy");
}

TEST_CASE("a history has the rows of its probe, or of its tip and method") {
  const FinishedRun run;
  const auto history = [&](const post::Quantity& quantity) { return post::history(quantity, run.folder.path()); };
  CHECK(history({"w", {}, "b"}).y == std::vector<double>{3, 7});
  CHECK(history({"w", {}, "b"}).t == std::vector<double>{0, 1});
  CHECK(history({"theta_x", {}, "b"}).y == std::vector<double>{4});  // what is not finite is left out
  CHECK(history({"K1", 0}).y == std::vector<double>{0.5, 1});
  CHECK(history({"K1", 0, {}, "series_fit"}).y == std::vector<double>{99, 198});
  CHECK(history({"strain_energy"}).y == std::vector<double>{0, 11});
  CHECK(history({"K1", 9}).t.empty());
  CHECK(history({"w", {}, "c"}).t.empty());
  const TemporaryFolder empty;
  CHECK(post::history({"w", {}, "b"}, empty.path()).t.empty());
}

TEST_CASE("every quantity has a description and a kind of place") {
  for (const auto& name : post::quantity_names()) {
    CHECK_FALSE(post::described(name).empty());
    CHECK_THAT("tip probe mode ", Catch::Contains(post::kind_of_place(name) + (name == "strain_energy" ? "" : " ")));
  }
  CHECK(post::si_unit("F1").empty());
  CHECK(post::si_unit("w") == "m");
}

TEST_CASE("factors in the plane and displacements u and v are quantities of runs that have them") {
  FinishedRun run;
  CHECK_FALSE(run.value({"N1", 0}));
  CHECK_FALSE(post::estimated_error({"N1", 0}, run.summary));
  CHECK(post::history({"N1", 0}, run.folder.path()).t.empty());
  CHECK_FALSE(run.value({"u", {}, "7"}));
  run.summary.srif[0].membrane = post::MembraneFactors{{3, 4}, {0.5, {}}, {true, false}, {}};
  CHECK(run.value({"N1", 0}) == 3.0);
  CHECK(post::estimated_error({"N1", 0}, run.summary) == 0.5);
  CHECK_FALSE(run.value({"N2", 0}));  // not resolved
  CHECK_FALSE(run.value({"N1", 1}));
  post::Table srifs;
  post::append(srifs, 0, run.summary.srif);
  post::write_csv(run.folder / "srif.csv", srifs);
  CHECK(post::history({"N1", 0}, run.folder.path()).y == std::vector<double>{3});
  post::write_csv(run.folder / "probes.csv", {{"time", "probe", "w", "u", "v"}, {{0.0, "7", 1.0, 2.0, 5.0}}});
  CHECK(run.value({"v", {}, "7"}) == 5.0);
}
