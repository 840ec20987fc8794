#include "plate/formulations.hpp"

#include <catch2/catch.hpp>

#include <set>

#include "plate/model/formulation_kind.hpp"

TEST_CASE("formulations: what chooses by itself prefers the Galerkin plate, and finds one for all that can be asked") {
  const auto& known = plate::formulations();
  std::set<std::string> names;
  for (const auto* kind : known) names.insert(kind->name);
  CHECK(names.size() == known.size());
  CHECK(known.front()->name == "galerkin");
  CHECK_FALSE(known.front()->offers(plate::Feature::breaking_bonds));
  CHECK(known.back()->offers(plate::Feature::breaking_bonds));
}
