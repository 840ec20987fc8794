#include "post/report/cost_model.hpp"

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/solve/analysis.hpp"
#include "post/files/summary.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

bool has(const std::vector<post::ScenePart>& parts, const std::string& name) {
  return std::ranges::any_of(parts, [&](const auto& part) { return part.name.starts_with(name); });
}

}  // namespace

TEST_CASE("scene: what a run does not use is not there") {
  const auto c = read(plain, {"discretization.spacing=0.1"}).content;
  const auto plate = plate::discretise(c).plate;
  const auto bare = post::scene(*plate, c.analysis, {false, false}),
             all = post::scene(*plate, c.analysis, {true, true});
  CHECK(has(bare, "conjugate gradients"));
  CHECK_FALSE(has(bare, "central differences"));
  CHECK_FALSE(has(bare, "intensity factors"));
  CHECK(has(all, "intensity factors"));
  CHECK(all.back().bytes_per_point > bare.back().bytes_per_point);  // fields for ParaView
}

TEST_CASE("scene: what is known of a run before it") {
  const auto c = read(plain, {"discretization.spacing=0.1", "discretization.formulation=ordinary"}).content;
  const auto plate = plate::discretise(c).plate;
  const auto summary = post::about(*plate, c.analysis, {});
  CHECK(summary.formulation == "ordinary");
  CHECK(summary.points == 400);
  CHECK(summary.bonds == plate->bonds());
  CHECK(summary.horizon == Approx(0.3015));
  CHECK(summary.analysis.kind == plate::Analysis::Kind::static_);
}
