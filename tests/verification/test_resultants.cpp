// Section forces of solved plates against statics.

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/sections.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

Resultants at_rest(const Formulation& a) {
  const auto solution = vp::solved(a);
  REQUIRE(solution.converged);
  return a.resultants(solution.state);
}

}  // namespace

TEST_CASE("a strip bent by edge moments: Mxx = M, von Mises 6 M / h^2, all else zero in its middle") {
  std::vector<double> bending, stress;
  for (const double spacing : {0.1, 0.05, 0.025}) {
    auto c = vp::free_plate(geometry::rectangle(0, 0, 3, 1), spacing);
    c.discretization.volume_correction = VolumeCorrection::lattice_fitted;
    c.supports = {{SupportKind::pinned, {}, {{0, 0}, {3, 0}, {3, 1}}}};
    c.loads = {Load{EdgeMoment{.edges = {"left", "right"}, .value = 1}}};
    const auto a = vp::assembled(c);
    const auto r = at_rest(*a);
    bending.push_back(0), stress.push_back(0);
    double other = 0, shear = 0;
    std::size_t checked = 0;
    for (std::size_t k = 0; k < a->cloud().plate_points; ++k) {
      const auto& x = a->cloud().positions[k];
      if (std::abs(x.x() - 1.5) > 0.2 || std::abs(x.y() - 0.5) > 0.2) continue;
      ++checked;
      const auto i = Eigen::Index(k);
      const double largest_stress = r.von_mises[i] * c.section.thickness * c.section.thickness / 6;
      bending.back() = std::max(bending.back(), std::abs(r.moments(0, i) - 1));
      stress.back() = std::max(stress.back(), std::abs(largest_stress - 1));
      other = std::max({other, std::abs(r.moments(1, i)), std::abs(r.moments(2, i))});
      shear = std::max(shear, r.shear.col(i).norm());
    }
    REQUIRE(checked == std::size_t(std::lround(0.16 / (spacing * spacing))));
    CHECK(other < 0.03);  // measured: at most 2.0 % with spacing 0.1 (arbitrary horizon 0.7 %), 0.1 % with 0.025
    CHECK(shear < 0.07);  // measured: 4.8 % of M per length at spacing 0.1, 0.1 % at 0.025
  }
  CAPTURE(bending, stress);
  // first order: the corrected families along the free edges are too stiff, as those of a free edge are in Dai et al.
  CHECK(bending[0] < 0.13);                         // measured: 10.0 %
  CHECK(bending[1] < 0.07);                         // measured: 5.3 %
  CHECK(bending[2] < 0.035);                        // measured: 2.7 %
  CHECK(stress[2] < 0.035);                         // measured: 2.8 %
  CHECK(std::log2(bending[0] / bending[1]) > 0.8);  // measured: 0.91
  CHECK(std::log2(bending[1] / bending[2]) > 0.8);  // measured: 0.96
}

TEST_CASE("a strip on two supports under pressure: Qx and Mxx of statics") {
  constexpr double length = 2, pressure = 3;
  auto c = vp::free_plate(geometry::rectangle(0, 0, length, 0.5), 0.05);
  c.discretization.volume_correction = VolumeCorrection::lattice_fitted;
  c.loads = {Load{Pressure{.value = pressure}}};
  for (const auto kind : {SupportKind::simply_supported, SupportKind::simply_supported_hard}) {
    c.supports = {vp::held(kind, {"left", "right"}), vp::held(SupportKind::symmetry, {"bottom", "top"})};
    const auto a = vp::assembled(c);
    const auto r = at_rest(*a);
    double shear = 0, moment = 0, other = 0, along = 0;
    std::size_t checked = 0;
    for (std::size_t k = 0; k < a->cloud().plate_points; ++k) {
      const double x = a->cloud().positions[k].x();
      if (x < 0.4 || x > length - 0.4) continue;
      ++checked;
      const auto i = Eigen::Index(k);
      shear = std::max(shear, std::abs(r.shear(0, i) - pressure * (length / 2 - x)) / (pressure * length / 2));
      moment = std::max(moment, std::abs(r.moments(0, i) / (pressure * x * (length - x) / 2) - 1));
      along = std::max(along, std::abs(r.moments(1, i) / r.moments(0, i) - c.section.poisson));
      other = std::max({other, std::abs(r.shear(1, i)), std::abs(r.moments(2, i))});
    }
    REQUIRE(checked == 24 * 10);
    CAPTURE(int(kind), shear, moment, along, other);
    CHECK(shear < 1e-4);   // measured: 1.5e-8 hard, 3.0e-6 soft
    CHECK(moment < 0.01);  // measured: 4.8e-3 at x = 0.4, second order in the spacing
    CHECK(along < 1e-12);  // measured: 4.4e-15
    CHECK(other < 1e-10);  // measured: 1.9e-13, the solver's residual
  }
}
