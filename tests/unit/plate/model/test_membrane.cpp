#include "plate/model/membrane.hpp"

#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

namespace {

Support support(SupportKind kind, std::optional<InPlane> in_plane = {}) {
  Support result;
  result.kind = kind, result.edges = {"left"}, result.in_plane = in_plane;
  return result;
}

}  // namespace

TEST_CASE("a problem in its plane: supports by what they hold there, loads that act there, nothing elastic") {
  Problem problem;
  using enum SupportKind;
  problem.supports = {support(clamped),
                      support(symmetry),
                      support(in_plane),
                      support(clamped, InPlane::tangential),
                      support(simply_supported, InPlane::normal),
                      support(symmetry, InPlane::free)};
  problem.loads = {Load{Pressure{.value = 1}}, Load{EdgeTraction{.edges = {"left"}, .value = 2}}};
  problem.foundations.emplace_back().modulus = 1;
  CHECK(loaded_in_plane(problem));
  const auto found = membrane_of(problem);
  std::vector<SupportKind> kinds;
  for (const auto& one : found.supports) kinds.push_back(one.kind);
  CHECK(kinds == std::vector{free, symmetry, clamped, simply_supported_hard, symmetry, free});
  CHECK(found.section.law == PlateLaw::membrane);
  CHECK(found.foundations.empty());
  CHECK(found.loads[0].as<BodyForce>()->vector == Point(0, 0));  // the pressure does nothing there
  CHECK(found.loads[1].as<EdgeTraction>()->value == 2);
  problem.loads.pop_back();
  CHECK_FALSE(loaded_in_plane(problem));
}

TEST_CASE("beams act in the plane by their axial stiffness, and couple where they are eccentric") {
  Problem problem;
  Stiffener bends, pulls, rib;
  bends.bending = 1, bends.eccentricity = 0.1;
  pulls.axial = 2, pulls.mass = 3;
  rib.axial = 4, rib.eccentricity = -0.1;
  problem.stiffeners = {bends, pulls};
  CHECK_FALSE(problem.coupled());
  CHECK_FALSE(has_plane(problem));
  CHECK(warnings_about_axial_stiffness(problem).size() == 1);
  problem.stiffeners.push_back(rib);
  CHECK(warnings_about_axial_stiffness(problem).empty());
  CHECK(problem.coupled());
  CHECK(has_plane(problem));
  const auto in_plane = membrane_of(problem).stiffeners, between = coupling_of(problem).stiffeners;
  REQUIRE(in_plane.size() == 2);
  CHECK(in_plane[0].axial == 2);
  CHECK(in_plane[0].mass == 0);
  REQUIRE(between.size() == 1);
  CHECK(between[0].axial == 4);
}

TEST_CASE("a section in its plane: forces by strains, no shear and no layer") {
  Section section{200, 0.25, 0.1};
  const LocalSection bent(section);
  section.law = PlateLaw::membrane;
  const LocalSection stretched(section);
  CHECK(stretched.bending.isApprox(12 / (0.1 * 0.1) * bent.bending));
  CHECK(stretched.shear.isZero(0));
  CHECK(stretched.top.isApprox(stretched.bending / 0.1));
  CHECK(section.at({0, 0}).law == PlateLaw::membrane);
  CHECK(section.shear_stiffness() == 0);
  CHECK(std::isinf(section.layer()));
}

TEST_CASE("a traction on an edge: along its normal, along it, or of a tensor") {
  const Point n(0, 2);
  CHECK(EdgeTraction{{}, 3, 0.5}.on(n) == Point(-1, 6));
  EdgeTraction uniform;
  uniform.tensor = {1, 2, 4};
  CHECK(uniform.on(n) == Point(8, 4));
}
