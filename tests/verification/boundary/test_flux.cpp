// The surface effect of a bar (Sca21 2.2, tables 1, 2, B1): formulas against quadrature and against sums over a
// lattice.

#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"
#include "tests/verification/boundary/fractions.hpp"

namespace bb = boundary_bodies;

namespace {

// Lengths over the horizon, x from the end of the bar; tau over E strain; b over E strain / horizon.

/// Sca21, table 1.
double weighted_volume(double x) {
  return x < 1 ? (x * x + 1) / 2 : 1;
}

/// Sca21, table 2 (28, 29).
double flux(double x) {
  if (x < 1) return 2 * (1 - 2 * x) * std::atan(x) + std::log(x * x + 1) + x * x / 2 + std::numbers::pi * x / 2;
  const double y = x - 1;
  return x > 2 ? 1
               : 2 * y * std::atan(y) - std::log((y * y + 1) / 2) - y * y / 2 + (1 - std::numbers::pi / 2) * y + 0.5;
}

/// Sca21, table B1.
double load(double x) {
  const double y = x - 1, quarter = std::numbers::pi / 2;
  if (x < 1) return 4 * std::atan(x) + 2 * y / (x * x + 1) - x - quarter;
  return x > 2 ? 0 : -2 * std::atan(y) + x - 2 + quarter;
}

/// Gauss, four points on each of `count` parts.
double integral(const std::function<double(double)>& f, double from, double to, int count = 40) {
  constexpr std::array<double, 2> at{0.339981043584856, 0.861136311594053},
      weight{0.652145154862546, 0.347854845137454};
  const double half = (to - from) / (2 * count);
  double sum = 0;
  for (int i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      for (const double side : {-1.0, 1.0}) sum += weight[k] * half * f(from + half * (2 * i + 1 + side * at[k]));
  return sum;
}

/// In parts that end where the weighted volume has its kink.
double in_parts(const std::function<double(double)>& f, double from, double to) {
  return from < 1 && to > 1 ? integral(f, from, 1) + integral(f, 1, to) : integral(f, from, to);
}

/// A bar of four horizons, `ratio` nodes in each; strain 1.
bb::Solid bar(int ratio) {
  return {edge_bodies::box_body({4 * ratio}, ratio),
          {0, 0, 1},
          bb::family_of(1, ratio),
          1.0 / ratio,
          double(ratio),
          1,
          bb::inverse};
}

}  // namespace

TEST_CASE("surface effect of a bar: tables 1, 2 and B1 of Sca21 are the integrals that they stand for") {
  double worst_volume = 0, worst_flux = 0, worst_load = 0;
  for (double x = 0.025; x < 2.2; x += 0.05) {
    const auto reach = [x](const auto& f) { return in_parts(f, std::max(0.0, x - 1), x) + in_parts(f, x, x + 1); };
    worst_volume =
        std::max(worst_volume, std::abs(reach([x](double y) { return std::abs(y - x); }) - weighted_volume(x)));
    const auto pull = [](double a, double b) { return 1 / weighted_volume(a) + 1 / weighted_volume(b); };
    const double crossing = in_parts(  // Sca21 24
        [&](double a) { return in_parts([&](double b) { return pull(a, b); }, x, a + 1); }, std::max(0.0, x - 1), x);
    worst_flux = std::max(worst_flux, std::abs(crossing - flux(x)));
    const double force = in_parts([&](double b) { return pull(x, b); }, x, x + 1) -
                         in_parts([&](double a) { return pull(x, a); }, std::max(0.0, x - 1), x);
    worst_load = std::max(worst_load, std::abs(-force - load(x)));
  }
  CHECK(worst_volume < 1e-12);  // measured: 4e-16
  CHECK(worst_flux < 1e-12);    // measured: 1e-15
  CHECK(worst_load < 1e-12);    // measured: 8e-15
}

TEST_CASE("surface effect of a bar: 26 % too stiff 0.77 horizons from its end, right at 0.39 horizons") {
  double low = 0.5, high = 1;  // the load is minus the slope of the flux
  while (high - low > 1e-12) (load((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  CHECK(low == Approx(0.7715987).epsilon(1e-7));        // paper: 0.772
  CHECK(flux(low) == Approx(1.2628503).epsilon(1e-7));  // paper: 1.263
  low = 0.1, high = 0.7;
  while (high - low > 1e-12) (flux((low + high) / 2) < 1 ? low : high) = (low + high) / 2;
  CHECK(low == Approx(0.3940308).epsilon(2e-7));  // paper: 0.394
  CHECK(flux(1 - 1e-12) == Approx(1.1931472).epsilon(1e-7));
  CHECK(flux(1 + 1e-12) == Approx(1.1931472).epsilon(1e-7));
  CHECK(flux(1.5) == Approx(1.0232531).epsilon(1e-7));
  CHECK(flux(0.5) == Approx(1.1335417).epsilon(1e-7));
  CHECK(load(0) == Approx(-3.570796).epsilon(1e-6));
  CHECK(load(1 - 1e-12) == Approx(0.570796).epsilon(1e-6));
  CHECK(in_parts(load, 0, 2) == Approx(-1).epsilon(1e-9));
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
      error = std::max(error, std::abs(flux_between - flux((k + 1.0) / ratio)));
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
