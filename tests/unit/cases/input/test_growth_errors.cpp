// What of a growth cannot be: the words of the program are those of tests/unit/cases/input.
#include "cases/input/validation.hpp"

#include <set>

#include "fracture/growth/growth.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "post/factors/srif.hpp"
#include "tests/catch.hpp"

namespace {

plate::Problem cracked() {
  plate::Problem problem;
  problem.outline.outer.vertices = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  problem.outline.outer.edge_names = {"bottom", "right", "top", "left"};
  problem.cracks = {{{-0.3, 0}, {0.3, 0}}};
  return problem;
}

std::set<std::string> with_error(const fracture::Growth& growth, const std::set<std::string>& given,
                                 const std::optional<post::SrifOptions>& srif = {}) {
  std::set<std::string> keys;
  for (const auto& error : cases::errors_in_growth(cracked(), {}, growth, srif,
                                                   [&](const std::string& key) { return given.contains(key); }))
    keys.insert(error.key);
  return keys;
}

}  // namespace

TEST_CASE("growth faults: each is told by the key that it is about") {
  using Keys = std::set<std::string>;
  fracture::Growth growth;
  CHECK(with_error(growth, {"growth.fracture_energy"}).empty());
  CHECK(with_error(growth, {}) == Keys{"growth.fracture_energy"});
  growth.unstable = fracture::Growth::Unstable::move;
  CHECK(with_error(growth, {"growth.fracture_energy"}) == Keys{"growth.duration", "section.density"});
  growth.unstable = fracture::Growth::Unstable::jump;
  growth.max_length = 0.5;
  CHECK(with_error(growth, {"growth.fracture_energy"}) == Keys{"growth.max_length"});
  growth.max_length.reset();
  post::SrifOptions srif;
  srif.methods = {post::SrifMethod::series_fit};
  CHECK(with_error(growth, {"growth.fracture_energy"}, srif) == Keys{"srif.methods"});
}
