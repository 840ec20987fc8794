#include <catch2/catch.hpp>
#include <csignal>

#include "cases/driver/run.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/summary.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder, small_run::text_of;

TEST_CASE("quasi-static memory: a growth that goes on writes what one writes that was never ended") {
  for (const auto& by :
       {std::vector<std::string>{"growth={fracture_energy=1,max_advances=2}"},
        {"growth={criterion=\"bond_energy\",fracture_energy=1,max_advances=2,control=\"equilibrium\"}"}}) {
    auto overrides = by;
    overrides.insert(overrides.end(), {"discretization.spacing=0.1", "geometry.cracks=[[[-1.0,0.0],[-0.1,0.0]]]",
                                       "output.fields=[]", "output.checkpoint_every=1e-9"});
    const auto file = case_text::read(case_text::plain, overrides);
    const TemporaryFolder folder;
    cases::run(file, {folder / "whole", true});
    {
      const plate::StopOnSignals guard;
      std::raise(SIGTERM);
      CHECK_THROWS_AS(cases::run(file, {folder / "ended", true}), plate::Interrupted);
    }
    REQUIRE(std::filesystem::exists(folder / "ended/checkpoint"));
    cases::run(file, {folder / "ended", true, nullptr, true});
    for (const char* name : {"growth.csv", "tips.csv", "history.csv", "cracks.csv", "srif.csv"}) {
      INFO(name);
      CHECK(text_of(folder / "ended" / name) == text_of(folder / "whole" / name));
    }
    CHECK_FALSE(std::filesystem::exists(folder / "ended/checkpoint"));
  }
}
