// Eigenfrequencies: closed forms, rigid motions, dense eigenvalues.
#include "plate/solve/motion/frequencies.hpp"

#include <algorithm>
#include <numbers>

#include "plate/bonds/rows/lattice_operator.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/small_plate.hpp"
#include "tests/verification/exact.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

FrequencySolution solved(const cases::Case& c, const Formulation& a, std::size_t modes) {
  FrequencyOptions options;
  options.modes = modes;
  options.tolerance = 1e-6;
  options.shift = shift_of(c.section, 2);
  return frequencies(a, a.constraints(), a.mass(), options);
}

/// Frequencies of the dense eigenproblem P^T K P q = omega^2 P^T M P q.
Eigen::VectorXd by_dense_matrices(const cases::Case& c, const Formulation& a) {
  const auto& constraints = a.constraints();
  const Eigen::MatrixXd K = small_plate::stiffness(*a.breaking()), P = small_plate::prolongation(constraints, K.rows());
  Forces all = Forces::Zero(3, vp::size(a));
  const double h = c.section.thickness, rho = c.section.density;
  for (Eigen::Index k = 0; k < all.cols(); ++k)
    if (a.boundary().active[std::size_t(k)])
      all.col(k) = rho * h * a.cloud().areas[std::size_t(k)] * Eigen::Vector3d(1, h * h / 12, h * h / 12);
  const Eigen::MatrixXd M = P.transpose() * all.reshaped().asDiagonal() * P;
  return dense::eigenvalues(dense::folded(K, P), M).cwiseMax(0).cwiseSqrt() / (2 * std::numbers::pi);
}

}  // namespace

TEST_CASE("frequencies of a rectangle with hard supports") {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 2, 1.5), 0.05);
  c.section.thickness = 0.2;
  c.supports = {vp::held_all_round(SupportKind::simply_supported_hard)};
  const auto a = vp::assembled(c);
  const auto found = solved(c, *a, 6);
  std::vector<double> exact;
  for (int m = 1; m <= 5; ++m)
    for (int n = 1; n <= 5; ++n) exact.push_back(exact::natural_frequency(c.section, 2, 1.5, m, n));
  std::sort(exact.begin(), exact.end());
  REQUIRE(found.modes.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CAPTURE(i, found.modes[i].frequency, exact[i], found.modes[i].residual);
    CHECK(found.modes[i].frequency == Approx(exact[i]).epsilon(0.01));  // measured: +0.31 % to +0.62 %
    CHECK(found.modes[i].residual < 1e-4);  // measured: 1e-7; a tenth of it is the linear solver's
    CHECK(found.modes[i].shape.row(0).maxCoeff() == Approx(1));
    CHECK(found.modes[i].shape.row(0).minCoeff() >= -1 - 1e-9);
  }
}

TEST_CASE("a free plate has three rigid motions and no more, a square one its double frequencies") {
  const auto c = vp::square(0.125);
  const auto a = vp::assembled(c);
  const auto found = solved(c, *a, 10);
  const Eigen::VectorXd all = by_dense_matrices(c, *a);
  CHECK(all[6] == Approx(all[7]).epsilon(1e-9));
  for (std::size_t i = 0; i < 10; ++i) {
    CAPTURE(i, found.modes[i].frequency, all[Eigen::Index(i)], found.modes[i].residual);
    if (i < 3)
      CHECK(found.modes[i].frequency < 1e-5 * all[3]);  // measured: 8e-8; rounding
    else
      CHECK(found.modes[i].frequency ==
            Approx(all[Eigen::Index(i)]).epsilon(1e-9));  // measured: all ten digits printed
  }
}

TEST_CASE("a plate cut in two has six rigid motions") {
  auto c = vp::square(0.125);
  c.cracks = {{{-1, 0.125}, {1, 0.125}}};
  const auto a = vp::assembled(c);
  const auto found = solved(c, *a, 8);
  const Eigen::VectorXd all = by_dense_matrices(c, *a);
  CHECK(found.modes[5].frequency < 1e-5 * all[6]);
  CHECK(found.modes[6].frequency == Approx(all[6]).epsilon(1e-9));
  CHECK(found.modes[7].frequency == Approx(all[7]).epsilon(1e-9));
}

TEST_CASE("frequencies of a plate that nothing holds: few iterations, and those of a free square") {
  // NAFEMS FV12: sqrt(D / rho h) / (2 pi a^2) times 13.468, 19.596, 24.270, 34.801 twice, 61.093 (thin)
  for (const auto* kind : {&galerkin, &ordinary}) {
    auto c = vp::free_plate(geometry::rectangle(0, 0, 10, 10), 0.5);
    c.discretization.formulation = kind;
    c.section = {200e9, 0.3, 0.05, 5.0 / 6, 8000};
    const auto a = vp::assembled(c);
    FrequencyOptions options;
    options.modes = 8, options.shift = shift_of(c.section, 10);
    const auto inverse = a->inverse_of_shifted(options.shift);
    REQUIRE(inverse);
    options.preconditioner = inverse.get();
    const auto found = frequencies(*a, a->constraints(), a->mass(), options);
    CAPTURE(kind->name, found.iterations, found.solutions);
    CHECK(found.iterations < (kind == &galerkin ? 3 : 45) * found.solutions);  // measured: 1 and 36 times
    for (std::size_t i = 0; i < 3; ++i) CHECK(found.modes[i].frequency < 1e-3);
    if (kind == &ordinary) continue;  // bonds of a plate a tenth of a spacing thick are too stiff
    const double exact[]{1.6217, 2.3596, 2.9225, 4.1904, 4.1904};
    for (std::size_t i = 0; i < 5; ++i) CHECK(found.modes[i + 3].frequency == Approx(exact[i]).epsilon(0.05));
  }
}

TEST_CASE("frequencies of bonds are the same in any direction") {
  const auto first = [](double degrees) {
    const Eigen::Rotation2Dd turned(degrees * std::numbers::pi / 180);
    const auto place = [&](const geometry::Point& x) -> geometry::Point { return turned * x; };
    auto c = vp::free_plate(geometry::placed(geometry::rectangle(-0.5, -0.5, 0.5, 0.5), place, 1), 0.025);
    c.discretization.formulation = &ordinary;
    c.section.thickness = 0.05;
    c.supports = {vp::held_all_round(SupportKind::simply_supported)};
    const auto a = vp::assembled(c);
    return solved(c, *a, 1).modes.front().frequency;
  };
  const double straight = first(0);
  for (const double degrees : {10, 23, 45}) {
    CAPTURE(degrees, straight);
    CHECK(first(degrees) == Approx(straight).epsilon(0.0025));  // measured: 0.09, 0.09, 0.18 %
  }
}
