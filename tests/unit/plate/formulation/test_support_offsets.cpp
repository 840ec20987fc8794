#include "plate/formulation/support_constraints.hpp"

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulations.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point;

TEST_CASE("what supports of every kind hold follows a rigid motion of them") {
  using enum SupportKind;
  for (const auto* kind : formulations())
    for (const auto support : {clamped, simply_supported, simply_supported_hard, clamped_layer, pinned}) {
      if (is_layer(support) && !kind->offers(Feature::layers)) continue;
      auto c = vp::free_plate(geometry::rectangle(-1, -1, 1, 1), 0.2);
      c.discretization.formulation = kind;
      c.supports = {support == pinned ? Support{pinned, {}, {{0.1, 0.1}, {0.5, -0.5}, {-0.7, 0.3}}}
                                      : vp::held_all_round(support)};
      c.loads = {Load{Settlement{.value = 0.3, .slope = {0.2, -0.1}, .from = {0.1, 0}}}};
      const auto plate = vp::assembled(c);
      State rigid = vp::field(
          *plate, [](const Point& x) { return Eigen::Vector3d(0.3 + 0.2 * (x.x() - 0.1) - 0.1 * x.y(), -0.1, -0.2); });
      State held = rigid;
      plate->constraints().impose(held);
      held += total_lift(*plate);
      CAPTURE(kind->name, int(support));
      for (Eigen::Index k = 0; k < held.cols(); ++k)
        for (std::uint32_t i = 0; i < 3; ++i)
          if (plate->constraints().held(dof(k, i))) CHECK(held(i, k) == Approx(rigid(i, k)).margin(1e-12));
    }
}

TEST_CASE("supports that rest have no offsets") {
  Boundary boundary;
  const SupportOffsets none(boundary, {});
  CHECK(none.inside(0, {0, 0}, 0).empty());
}
