// The surface effect of a bar (Sca21 2.2, tables 1, 2, B1): formulas against quadrature and against sums over a
// lattice.

#include "cases/papers/bodies/equilibrium.hpp"
#include "cases/papers/bodies/fractions.hpp"
#include "cases/papers/bodies/surface_effect.hpp"
#include "tests/catch.hpp"

namespace bb = boundary_bodies;

namespace {

/// A bar of four horizons, `ratio` nodes in each; strain 1.
bb::Solid bar(int ratio) {
  return {
      bb::box_body({4 * ratio}, ratio), {0, 0, 1}, bb::family_of(1, ratio), 1.0 / ratio, double(ratio), 1, bb::inverse};
}

}  // namespace

TEST_CASE("surface effect of a bar: tables 1, 2 and B1 of Sca21 are the integrals that they stand for") {
  double worst_volume = 0, worst_flux = 0, worst_load = 0;
  for (double x = 0.025; x < 2.2; x += 0.05) {
    worst_volume =
        std::max(worst_volume, std::abs(bb::integrated_weighted_volume(x) - bb::weighted_volume_near_end(x)));
    worst_flux = std::max(worst_flux, std::abs(bb::integrated_flux(x) - bb::flux_near_end(x)));
    worst_load = std::max(worst_load, std::abs(bb::integrated_load(x) - bb::load_near_end(x)));
  }
  CHECK(worst_volume < 1e-12);  // measured: 4e-16
  CHECK(worst_flux < 1e-12);    // measured: 1e-15
  CHECK(worst_load < 1e-12);    // measured: 8e-15
}

TEST_CASE("surface effect of a bar: 26 % too stiff 0.77 horizons from its end, right at 0.39 horizons") {
  // the load is minus the slope of the flux
  const double highest = bb::place_of(bb::load_near_end, 0, 0.5, 1),
               right = bb::place_of(bb::flux_near_end, 1, 0.1, 0.7);
  CHECK(highest == Approx(0.7715987).epsilon(1e-7));                     // paper: 0.772
  CHECK(bb::flux_near_end(highest) == Approx(1.2628503).epsilon(1e-7));  // paper: 1.263
  CHECK(right == Approx(0.3940308).epsilon(2e-7));                       // paper: 0.394
  CHECK(bb::flux_near_end(1 - 1e-12) == Approx(1.1931472).epsilon(1e-7));
  CHECK(bb::flux_near_end(1 + 1e-12) == Approx(1.1931472).epsilon(1e-7));
  CHECK(bb::flux_near_end(1.5) == Approx(1.0232531).epsilon(1e-7));
  CHECK(bb::flux_near_end(0.5) == Approx(1.1335417).epsilon(1e-7));
  CHECK(bb::load_near_end(0) == Approx(-3.570796).epsilon(1e-6));
  CHECK(bb::load_near_end(1 - 1e-12) == Approx(0.570796).epsilon(1e-6));
  CHECK(bb::integral_in_parts(bb::load_near_end, 0, 2) == Approx(-1).epsilon(1e-9));
}

TEST_CASE("surface effect of a bar: sums over a lattice tend to the integrals, with fictitious nodes it is gone") {
  double before = 0;
  for (const int ratio : {20, 40, 80}) {
    const bb::Solid s = bar(ratio);
    const Eigen::VectorXd strained = bb::at_unknowns(s, [](const Eigen::Vector3d& x) { return x; });
    const plate::SparseStiffness K = bb::uncorrected_stiffness(s);
    const Eigen::VectorXd force = K * strained.head(s.body.real);  // what holds the strain, per node
    double flux_between = 0, error = 0, largest = 0;
    for (int k = 0; k < 2 * ratio; ++k) {
      flux_between -= force[k];  // the flux through the face above node k balances what holds the nodes below it
      error = std::max(error, std::abs(flux_between - bb::flux_near_end((k + 1.0) / ratio)));
      largest = std::max(largest, flux_between);
    }
    CHECK(error < 0.3 / (ratio * ratio));          // measured: 7.0e-4, 1.7e-4, 4.4e-5
    if (before > 0) CHECK(error < 0.26 * before);  // measured: 0.250
    before = error;
    if (ratio == 80) CHECK(largest == Approx(1.2628503).epsilon(5e-5));  // measured: 1.26287
    const Eigen::VectorXd corrected = bb::stiffness(s, plate::Centre::surface_node, 1) * strained;
    CHECK(corrected.head(s.body.real).cwiseAbs().maxCoeff() < 1e-10);    // measured: 2e-14
    CHECK((corrected.tail(2) - Eigen::Vector2d(-1, 1)).norm() < 1e-10);  // measured: 1e-13
  }
}
