#include "plate/solve/matrices/factor.hpp"

#include <random>
#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using plate::GeneralFactor;

TEST_CASE("general factor: random matrices with weak diagonals that are not symmetric") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  for (const int n : {1, 7, 60, 300}) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, (i + 3) % n, 4 + value(random));  // regular by these, not by the diagonal
      for (int e = 0; e < 3; ++e) entries.emplace_back(i, int(random() % unsigned(n)), value(random));
    }
    Eigen::SparseMatrix<double> A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 1, 2);
    const GeneralFactor factor(A);
    CHECK((factor.solve(A * x) - x).cwiseAbs().maxCoeff() < 1e-12);  // measured: 7e-16
    CHECK(factor.matrix().nonZeros() == A.nonZeros());
    CHECK(factor.bytes() > std::size_t(n) * sizeof(double));
  }
}

TEST_CASE("general factor: singular matrices are refused") {
  CHECK_THROWS_AS(GeneralFactor(Eigen::MatrixXd{{1, 2}, {2, 4}}.sparseView()), plate::NumericalError);
  CHECK_THROWS_AS(GeneralFactor(Eigen::MatrixXd{{1, 0}, {1, 0}}.sparseView(1, 0)), plate::NumericalError);
}
