#include <omp.h>

#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

namespace {

double energy(const GalerkinFamilies& families, const Section& s, const State& u) {
  double sum = 0;
  for (std::size_t k = 0; k < families.areas.size(); ++k) sum += family_energy(families, s, k, u);
  return sum;
}

}  // namespace

TEST_CASE("the force of the Galerkin plate is minus the derivative of its energy") {
  for (const auto& cells : gp::scenes()) {
    const GalerkinOperator op(gp::families(cells), gp::section);
    const State u = gp::random_state(op.points(), 1), v = gp::random_state(op.points(), 2);
    Forces force;
    op.internal_force(u, force);
    const double ahead = energy(op.families(), gp::section, u + v), back = energy(op.families(), gp::section, u - v);
    CHECK(-force.cwiseProduct(v).sum() ==
          Approx((ahead - back) / 2).epsilon(1e-11));  // measured: 1e-14; it is quadratic
    CHECK(op.energies(u).sum() == Approx(energy(op.families(), gp::section, u)).epsilon(1e-12));
    CHECK(-force.cwiseProduct(u).sum() == Approx(2 * energy(op.families(), gp::section, u)).epsilon(1e-12));
  }
}

TEST_CASE("any number of threads gives the same force") {
  const GalerkinOperator op(galerkin_families(gp::cells(gp::with_hole(), 0.02, {{{0.8, 0.42}, {1.0, 0.47}}})),
                            gp::section);
  const State u = gp::random_state(op.points(), 4);
  const int before = omp_get_max_threads();
  Forces one, three;
  omp_set_num_threads(1);
  op.internal_force(u, one);
  omp_set_num_threads(3);
  op.internal_force(u, three);
  omp_set_num_threads(before);
  CHECK(one == three);
}
