// The thesis' own tests of its formulations in plane strain: shape function conditions, patch tests, eigenmodes.

#include "cases/papers/bodies/galerkin/plane.hpp"
#include "tests/catch.hpp"
#include "tests/dense.hpp"

namespace gs = galerkin_systems;

namespace {

constexpr double rounding = 1e-12;

const gs::Solid patch_solid{100, 0.3}, block_solid{100, 0.4};

/// The square [-1, 1]^2 moved to [0, 2]^2, irregular; the thesis has 1345 points, these are 169.
gs::Body patch_body(gs::Reach reach, double perturbation = 0.3) {
  return gs::body({2, 2, 12, 12, perturbation, reach});
}

/// 20 mm x 10 mm, 20 x 10 cells.
gs::Body block(gs::Reach reach = gs::Reach::cells) {
  return gs::body({20, 10, 20, 10, 0, reach});
}

gs::Norms linear_patch(const gs::Body& b, const gs::Sparse& K, const Eigen::Matrix2Xd& normals) {
  return gs::patch_norms(patch_solid, b, K, normals, gs::linear_field(), {0, 0});
}

gs::Norms quadratic_patch(const gs::Body& b, const gs::Sparse& K) {
  return gs::patch_norms(patch_solid, b, K, b.normals, gs::quadratic_field(), gs::quadratic_body_force(patch_solid));
}

gs::Sparse petrov(const gs::Body& b, const gs::System& test, gs::Petrov kind = gs::Petrov::first) {
  return gs::petrov_stiffness(gs::law(patch_solid), b, gs::moving(b), test, kind);
}

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& K) {
  return dense::eigenvalues(K);
}

/// Largest |sum X (x) G - I| over all samples.
double linear_inconsistency(const gs::Body& b, const gs::System& system) {
  double worst = 0;
  for (const auto& f : system)
    for (const auto& s : f.samples) {
      Eigen::Matrix2d sum = -Eigen::Matrix2d::Identity();
      for (std::size_t i = 0; i < f.nodes.size(); ++i)
        sum += (b.points.col(f.nodes[i]) - b.points.col(f.nodes[0])) * s.gradient.col(Eigen::Index(i)).transpose();
      worst = std::max(worst, sum.cwiseAbs().maxCoeff());
    }
  return worst;
}

/// Bode 5.12: the weights of the difference along the sample's bond, n.G_i xi, must be those of u_j - u_k.
double bond_map_error(const gs::Body& b, const gs::Family& f, const gs::Sample& s) {
  const Eigen::Vector2d X = b.points.col(f.nodes[std::size_t(s.at)]) - b.points.col(f.nodes[0]);
  Eigen::RowVectorXd difference = X.transpose() * s.gradient;
  difference[s.at] -= 1;
  difference[0] += 1;
  return difference.cwiseAbs().maxCoeff();
}

double bond_map_error(const gs::Body& b, const gs::System& system) {
  double worst = 0;
  for (const auto& f : system)
    for (const auto& s : f.samples)
      if (s.at != 0) worst = std::max(worst, bond_map_error(b, f, s));
  return worst;
}

gs::System joined(gs::System a, const gs::System& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    a[k].samples.insert(a[k].samples.end(), b[k].samples.begin(), b[k].samples.end());
  return a;
}

}  // namespace

TEST_CASE(
    "Galerkin shape functions: consistency and bond map survive the correction, integration constraint after it") {
  const gs::Body b = patch_body(gs::Reach::cells);
  const auto unl = gs::moving(b), u1 = gs::linear_static(b), ca = gs::central_average(b);
  const auto corrected_unl = gs::variationally_consistent(b, unl), corrected_u1 = gs::variationally_consistent(b, u1);
  for (const auto& system : {unl, u1, ca, corrected_unl, corrected_u1})
    CHECK(linear_inconsistency(b, system) < rounding);           // measured: 5e-15
  CHECK(bond_map_error(b, gs::moving(b, false)) > 0.1);          // measured: 0.88
  CHECK(bond_map_error(b, unl) < rounding);                      // measured: 4e-16
  CHECK(bond_map_error(b, corrected_unl) < rounding);            // measured: 9e-16
  CHECK(gs::consistency_residual(b, unl) > 0.1 * 2.0 / 12);      // measured: 0.64 spacings
  CHECK(gs::consistency_residual(b, u1) > 0.1 * 2.0 / 12);       // measured: 0.67
  CHECK(gs::consistency_residual(b, ca) < rounding);             // measured: 4e-17
  CHECK(gs::consistency_residual(b, corrected_unl) < rounding);  // measured: 1e-16
  CHECK(gs::consistency_residual(b, corrected_u1) < rounding);   // measured: 1e-16
}

TEST_CASE("Galerkin correction V5 as printed, alpha_d Phi_d e_d, breaks the bond map, (I - n n) alpha Phi keeps it") {
  const gs::Body b = patch_body(gs::Reach::cells);
  const auto unl = gs::moving(b);
  const Eigen::Vector2d alpha(1, 0.3), ones(1, 1);
  double printed = 0, kept = 0;
  for (const auto& f : unl) {
    const Eigen::RowVectorXd phi = gs::linear_correction(b, f.nodes).row(0);
    for (const auto& s : f.samples) {
      if (s.at == 0) continue;
      const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - s.bond * s.bond.transpose();
      gs::Sample as_printed = s, as_kept = s;
      as_printed.gradient += Eigen::Vector2d(alpha.asDiagonal() * across * ones) * phi;
      as_kept.gradient += across * alpha * phi;
      printed = std::max(printed, bond_map_error(b, f, as_printed));
      kept = std::max(kept, bond_map_error(b, f, as_kept));
    }
  }
  CHECK(printed > 0.01);   // measured: 0.16
  CHECK(kept < rounding);  // measured: 4e-16
}

TEST_CASE("Galerkin linear patch (Bode 7.1, 7.2): Petrov-Galerkin fails, each correction V1 to V3 passes") {
  const gs::Body b = patch_body(gs::Reach::two_cells);
  const auto u1 = gs::linear_static(b);
  const auto raw = linear_patch(b, petrov(b, u1), b.normals);
  CHECK((raw.L2 > 0.05 && raw.L2 < 0.2));  // measured: 0.083; thesis 0.095
  CHECK((raw.H1 > 0.1 && raw.H1 < 0.5));   // measured: 0.26; thesis 0.23
  for (const auto& correction : {gs::constant_correction, gs::linear_correction}) {
    const auto test = gs::variationally_consistent(b, u1, correction);
    const auto passed = linear_patch(b, petrov(b, test), b.normals);
    CHECK(passed.L2 < rounding);  // measured: 1e-15; thesis 2e-15 V1, 6e-17 V3
    CHECK(passed.H1 < rounding);  // measured: 3e-15; thesis 2e-14 V1, 1e-15 V3
  }
  for (const auto& correction : {gs::constant_correction, gs::second_derivative_correction, gs::linear_correction}) {
    const auto test = gs::variationally_consistent(b, u1, correction, gs::Normals::found);
    const auto passed = linear_patch(b, petrov(b, test), gs::nodal_normals(b, test));
    CHECK(passed.L2 < rounding);  // measured: 2e-15; thesis 8e-16 V2, 8e-17 V3s
    CHECK(passed.H1 < rounding);  // measured: 4e-15; thesis 8e-15 V2, 1e-15 V3s
  }
}

TEST_CASE("Galerkin linear patch (Bode 7.1, 7.2): Bubnov-Galerkin fails, U1 and Unl with V3, V5 pass, PG-CA as it is") {
  for (const auto reach : {gs::Reach::cells, gs::Reach::two_cells}) {
    const gs::Body b = patch_body(reach);
    const auto solve = [&](const gs::System& s) {
      return linear_patch(b, gs::plane_stiffness(patch_solid, b, s), b.normals);
    };
    const auto raw = solve(gs::moving(b));
    CHECK((raw.L2 > 0.01 && raw.L2 < 0.3));       // measured: 0.034, 0.15; thesis 0.0086 with finer points
    CHECK((raw.H1 > 0.1 && raw.H1 < 0.6));        // measured: 0.17, 0.45; thesis 0.13
    CHECK(solve(gs::linear_static(b)).L2 > 0.5);  // measured: 0.81, 3.2
    for (const auto& s : {gs::variationally_consistent(b, gs::moving(b)),
                          gs::variationally_consistent(b, gs::linear_static(b)), gs::central_average(b)}) {
      CHECK(solve(s).L2 < rounding);  // measured: 3e-14; thesis 3e-14
      CHECK(solve(s).H1 < rounding);  // measured: 2e-14; thesis 1e-12
    }
  }
}

TEST_CASE("Galerkin corrections that keep quadratics cannot give the normals of an unevenly spaced edge") {
  for (const double perturbation : {0.0, 0.3}) {
    const gs::Body b = patch_body(gs::Reach::two_cells, perturbation);
    const auto v2 = gs::variationally_consistent(b, gs::linear_static(b), gs::second_derivative_correction);
    const auto v4 = gs::variationally_consistent(b, gs::quadratic_static(b), gs::quadratic_correction);
    for (const double residual : {gs::consistency_residual(b, v2), gs::consistency_residual(b, v4)}) {
      // sum Phi X X = 0 asks that the edges' trapezoidal rule integrate squares; on even spacings the errors cancel
      if (perturbation == 0) CHECK(residual < rounding);  // measured: 1e-14
      if (perturbation > 0) CHECK(residual > 1e-5);       // measured: 7e-5 and 1e-4
    }
  }
}

TEST_CASE("Galerkin quadratic patch (Bode 7.4-7.6): only the second-order correction of PPG2 U2 passes") {
  const gs::Body b = patch_body(gs::Reach::two_cells);
  const auto u1 = gs::linear_static(b);
  const auto raw = quadratic_patch(b, petrov(b, u1));
  CHECK((raw.L2 > 0.1 && raw.L2 < 0.3));  // measured: 0.165; thesis 0.176
  CHECK((raw.H1 > 0.2 && raw.H1 < 0.6));  // measured: 0.376; thesis 0.366
  const auto first = quadratic_patch(b, petrov(b, gs::variationally_consistent(b, u1)));
  CHECK((first.L2 > 1e-4 && first.L2 < raw.L2 / 10));  // measured: 0.011; thesis 6e-4
  CHECK((first.H1 > 1e-3 && first.H1 < raw.H1 / 10));  // measured: 0.027; thesis 0.019
  const auto test = gs::second_order_consistent(b, u1);
  const auto K = gs::petrov_stiffness(gs::law(patch_solid), b, gs::quadratic_static(b), test, gs::Petrov::second);
  const auto second = quadratic_patch(b, K);
  CHECK(second.L2 < rounding);  // measured: 4e-16; thesis 7e-16
  CHECK(second.H1 < rounding);  // measured: 2e-15; thesis 1e-14
}

TEST_CASE("Galerkin eigenmodes of a free block: three zero modes, spurious low ones in U1 and masters alone") {
  const gs::Body b = block(), wide = block(gs::Reach::two_cells);
  const auto u1 = gs::variationally_consistent(b, gs::linear_static(b));
  const auto unl = gs::variationally_consistent(b, gs::moving(b)), ca = gs::central_average(b);
  const auto values = [&](const gs::System& s) { return eigenvalues(gs::plane_stiffness(block_solid, b, s)); };
  const auto elements = values(gs::bilinear(b));
  const auto check_zero = [](const Eigen::VectorXd& v) {
    CHECK(v.head(3).cwiseAbs().maxCoeff() / v.tail(1)[0] < 1e-13);  // measured: 1e-15
    CHECK(v[3] / v.tail(1)[0] > 1e-6);                              // measured: 2e-5 U1, the others 5e-4
  };
  for (const auto& s : {unl, gs::moving(b), gs::variationally_consistent(wide, gs::moving(wide)),
                        ca + gs::bond_residuals(b, ca, 0.5, 1), 0.5 * u1 + 0.5 * unl, u1 + gs::implicit_gradients(b)}) {
    const auto v = values(s);
    check_zero(v);
    // in good agreement at low stiffness
    for (Eigen::Index i = 3; i < 10; ++i) CHECK(std::abs(v[i] / elements[i] - 1) < 0.15);  // measured: 0.135, U1SUnl
    CHECK((v.array() < elements[19]).count() < 35);  // measured: 19 to 24, U1SIG 32; elements 19
  }
  const auto v = values(u1);
  check_zero(v);
  CHECK(v[3] / elements[3] < 0.01);                          // measured: 0.007
  CHECK((v.array() < 0.9 * elements[3]).count() > 30);       // measured: 40; thesis: the 100th is the first sound one
  CHECK((v.array() < elements[19]).count() > 150);           // measured: 188, elements 19
  CHECK((values(ca).array() < elements[19]).count() > 100);  // measured: 137
}

TEST_CASE("Galerkin families: energetic modes, 3 of U1, 9 of U2 and U1SIG, all but the rigid ones of Unl") {
  const auto energetic = [](const gs::Family& f) {
    const auto v = eigenvalues(gs::family_stiffness(block_solid, f));
    return (v.array() > 1e-10 * v.tail(1)[0]).count();
  };
  for (const auto reach : {gs::Reach::cells, gs::Reach::two_cells}) {
    const gs::Body b = gs::body({20, 10, 20, 10, 0.3, reach});
    const std::size_t k = 5 * 21 + 10;
    const Eigen::Index nodes = reach == gs::Reach::cells ? 9 : 25;
    CHECK(energetic(gs::linear_static(b)[k]) == 3);
    CHECK(energetic(joined(gs::linear_static(b), gs::implicit_gradients(b))[k]) == 9);
    CHECK(energetic(gs::quadratic_static(b)[k]) == 9);  // on boundaries 3 x 3 points would not determine it
    CHECK(energetic(gs::moving(b)[k]) == 2 * nodes - 3);
  }
}
