#include "cases/papers/bodies/galerkin/systems.hpp"

#include "tests/catch.hpp"

namespace gs = galerkin_systems;

TEST_CASE("Galerkin thesis, systems: least-norm solutions of singular matrices are those of a dense factor") {
  for (const double perturbation : {0.0, 0.3}) {
    // (1, x, y) are in the left null space
    const gs::Body b = gs::body({1, 1, 6, 6, perturbation});
    const Eigen::Index n = b.points.cols();
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& family : b.families) {
      const auto phi = gs::linear_correction(b, family);
      for (std::size_t i = 0; i < family.size(); ++i)
        entries.emplace_back(family[i], family[0], phi(0, Eigen::Index(i)));
    }
    gs::Sparse M(n, n);
    M.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd inside = M * Eigen::VectorXd::LinSpaced(n, -1, 2).cwiseAbs2();
    const auto dense = Eigen::MatrixXd(M).completeOrthogonalDecomposition();
    CHECK(dense.rank() < n);
    const Eigen::VectorXd x = gs::least_norm(M, inside);
    CHECK((M * x - inside).norm() < 1e-13 * inside.norm());
    CHECK((x - dense.solve(inside)).norm() < 1e-9 * x.norm());
    const Eigen::VectorXd outside = inside + 0.1 * Eigen::VectorXd::Ones(n);  // no solution: least squares
    CHECK((gs::least_norm(M, outside) - x).norm() < 1e-6 * x.norm());
  }
}

TEST_CASE("Galerkin thesis, systems: what is fixed on the surface are all factors or those along the normal") {
  const gs::Body b = gs::body({2, 1, 8, 4, 0.3, gs::Reach::two_cells});
  const auto residuals = [&](gs::Normals normals) {
    const auto system = gs::variationally_consistent(b, gs::linear_static(b), gs::linear_correction, normals);
    return Eigen::Matrix2Xd(gs::nodal_normals(b, system) - b.normals);
  };
  const auto given = residuals(gs::Normals::given), found = residuals(gs::Normals::found),
             across = residuals(gs::Normals::found_across);
  const auto largest = [](double before, double value) { return std::max(before, std::abs(value)); };
  double inside = 0, along = 0, over = 0, both = 0;
  for (Eigen::Index k = 0; k < b.points.cols(); ++k) {
    const Eigen::Vector2d x = b.points.col(k);
    const bool side = x.x() == 0 || x.x() == 2, end = x.y() == 0 || x.y() == 1;
    if (!side && !end) inside = largest(largest(inside, across.col(k).norm()), found.col(k).norm());
    if (side && !end) along = largest(along, across(1, k)), over = largest(over, across(0, k));
    if (side && !end) both = largest(both, found(1, k));
  }
  CHECK(given.norm() < 1e-12);
  CHECK(inside < 1e-12);
  CHECK(along < 1e-12);
  CHECK(over > 1e-3);
  CHECK(both > 1e-3);
}

TEST_CASE("Galerkin thesis, systems: equations with given values") {
  gs::Sparse K(3, 3);
  K.coeffRef(0, 0) = K.coeffRef(2, 2) = 1, K.coeffRef(1, 1) = 2;
  K.coeffRef(0, 1) = K.coeffRef(1, 0) = K.coeffRef(1, 2) = K.coeffRef(2, 1) = -1;
  Eigen::VectorXd prescribed = gs::nothing_prescribed(3);
  prescribed[0] = 5;
  const Eigen::VectorXd u = gs::solved(K, Eigen::Vector3d(0, 0, 2), prescribed);
  CHECK((u - Eigen::Vector3d(5, 7, 9)).norm() < 1e-14);
}
