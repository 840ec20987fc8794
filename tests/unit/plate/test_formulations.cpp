#include "plate/formulations.hpp"

#include <set>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"

TEST_CASE("formulations: what chooses by itself prefers the Galerkin plate, and finds one for all that can be asked") {
  const auto& known = plate::formulations();
  std::set<std::string> names;
  for (const auto* kind : known) names.insert(kind->name);
  CHECK(names.size() == known.size());
  CHECK(known.front()->name == "galerkin");
  CHECK_FALSE(known.front()->offers(plate::Feature::breaking_bonds));
  CHECK(known.back()->offers(plate::Feature::breaking_bonds));
}

TEST_CASE("formulations: edges by layers are the kinds that hold in a layer, symmetry and free edges stay") {
  using enum plate::SupportKind;
  plate::Problem problem;
  problem.section = {1000, 0.3, 0.1};
  problem.outline = geometry::rectangle(0, 0, 1, 1);
  problem.discretization.spacing = 0.125, problem.discretization.formulation = plate::formulations().back();
  problem.loads = {plate::Load{plate::Pressure{.value = 1}}};
  auto by_kind = problem;
  by_kind.supports = {
      {clamped_layer, {"left"}, {}}, {simply_supported_hard_layer, {"top"}, {}}, {symmetry, {"bottom"}, {}}};
  problem.discretization.boundary = plate::EdgeMethod::layer;
  problem.supports = {{clamped, {"left"}, {}}, {simply_supported_hard, {"top"}, {}}, {symmetry, {"bottom"}, {}}};
  const auto state = [](const plate::Problem& one) {
    const auto made = plate::discretise(one);
    CHECK(made.plate->problem().supports.front().kind == clamped_layer);
    return plate::solve_static(*made.plate, made.plate->total_load(), plate::StaticMethod::direct, {}, {})
        .solution.state;
  };
  CHECK(state(problem) == state(by_kind));
}
