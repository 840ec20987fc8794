#include "plate/formulation/mechanisms.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

/// What is said of a square with these supports and cracks; the subject first.
std::vector<std::string> said(std::vector<Support> supports, std::vector<geometry::Polyline> cracks = {}) {
  auto c = vp::square(0.2);
  c.supports = std::move(supports), c.cracks = std::move(cracks);
  std::vector<std::string> result;
  for (const auto& one : loose(*vp::assembled(c)))
    result.push_back((one.subject == Subject::support ? "support: " : "cracks: ") + one.what);
  return result;
}

const Support clamped = vp::held(SupportKind::clamped, {"left"});

}  // namespace

TEST_CASE("held: a plate is held by an edge, or by three pins that are not on one line") {
  CHECK(said({clamped}).empty());
  CHECK(said({{SupportKind::pinned, {}, {{-0.9, -0.9}, {0.9, -0.9}, {0.1, 0.9}}}}).empty());
  for (const auto& [supports, modes] :
       {std::pair{std::vector<Support>{}, "in 3 of 3 ways"},
        {std::vector<Support>{{SupportKind::pinned, {}, {{0.1, 0.1}}}}, "in 2 of 3 ways"},
        {std::vector<Support>{{SupportKind::pinned, {}, {{-0.9, 0.1}, {0.1, 0.1}, {0.9, 0.1}}}}, "in 1 of 3 ways"},
        {std::vector<Support>{vp::held(SupportKind::symmetry, {"left"})}, "in 2 of 3 ways"}}) {
    const auto found = said(supports);
    REQUIRE(found.size() == 1);
    CHECK_THAT(found[0],
               Catch::StartsWith("support: the plate is not held: the piece of 100 points") && Catch::Contains(modes));
  }
}

TEST_CASE("held: a piece that cracks cut off is told apart from what is held") {
  const auto found = said({clamped}, {{{0, -1}, {0, 1}}});
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], Catch::StartsWith("cracks: cracks cut the plate: the piece of 50 points"));
  CHECK(said({clamped, vp::held(SupportKind::simply_supported, {"right"})}, {{{0, -1}, {0, 1}}}).size() == 1);
  CHECK(said({clamped, vp::held(SupportKind::clamped, {"right"})}, {{{0, -1}, {0, 1}}}).empty());
}

TEST_CASE("held: a ligament one row of points wide is a hinge for what the load turns about it, and is told of") {
  auto c = vp::square(0.2);
  c.supports = {clamped}, c.cracks = {{{0, -1}, {0, 0.88}}};  // the uppermost row connects
  const auto plate = vp::assembled(c);
  const auto found = loose(*plate);
  REQUIRE(found.size() == 1);
  CHECK(found[0].subject == Subject::cracks);
  CHECK_THAT(found[0].what, Catch::Contains("is a hinge") && Catch::Contains("the part of 50 points"));
  const auto warnings = warnings_about_mechanisms(*plate);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::StartsWith("1 motion without resistance: the part of 50 points"));
  CHECK(warnings_about_mechanisms(*vp::assembled(vp::square(0.2))).empty());
}
