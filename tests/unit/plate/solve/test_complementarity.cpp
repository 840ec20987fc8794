#include "plate/solve/complementarity.hpp"

#include <random>

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using namespace plate;

namespace {

struct System {
  Eigen::MatrixXd C;
  Eigen::VectorXd c;
};

/// A positive matrix and a vector of both signs.
System random_system(Eigen::Index size, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd root(size, size);
  Eigen::VectorXd c(size);
  for (auto& one : root.reshaped()) one = normal(generator);
  for (auto& one : c) one = normal(generator);
  return {root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size), c};
}

}  // namespace

TEST_CASE("complementarity: one of x and C x + c is zero, and none is negative") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto [C, c] = random_system(30, seed);
    const Complementarity found(C, c);
    CHECK((found.rest - C * found.x - c).norm() < 1e-10 * c.norm());
    CHECK(found.x.minCoeff() >= 0);
    CHECK(found.rest.minCoeff() > -1e-10);
    CHECK(found.x.cwiseProduct(found.rest).cwiseAbs().maxCoeff() < 1e-10);
    CHECK(found.x.maxCoeff() > 0);
  }
}

TEST_CASE("complementarity: rows that are kept stay closed, with x of any sign") {
  const auto [C, c] = random_system(12, 5);
  std::vector<char> kept(12, 0);
  kept[2] = kept[7] = 1;
  const Complementarity found(C, c, kept);
  for (Eigen::Index i = 0; i < 12; ++i) {
    if (kept[std::size_t(i)]) {
      CHECK(std::abs(found.rest[i]) < 1e-10);
    } else {
      CHECK(found.x[i] >= 0);
      CHECK(found.rest[i] > -1e-10);
    }
  }
  const Complementarity all(C, c, std::vector<char>(12, 1));
  CHECK((C * all.x + c).norm() < 1e-10 * c.norm());
  CHECK(all.x.minCoeff() < 0);
}

TEST_CASE("complementarity: a matrix that is not positive is refused") {
  Eigen::MatrixXd C = -Eigen::MatrixXd::Identity(3, 3);
  CHECK_THROWS_AS(Complementarity(C, Eigen::Vector3d(-1, -1, -1)), NumericalError);
}

TEST_CASE("complementarity: gaps beside forces, of which each moves the other against itself") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    auto [C, c] = random_system(30, seed);
    const Eigen::MatrixXd beside = random_system(30, seed + 100).C.topRightCorner(12, 18);
    C.topRightCorner(12, 18) = -beside, C.bottomLeftCorner(18, 12) = beside.transpose();
    const Complementarity found(C, c, {}, Complementarity::Shape::mixed);
    CHECK((found.rest - C * found.x - c).norm() < 1e-9 * c.norm());
    CHECK(found.x.minCoeff() >= 0);
    CHECK(found.rest.minCoeff() > -1e-9);
    CHECK(found.x.cwiseProduct(found.rest).cwiseAbs().maxCoeff() < 1e-9);
  }
}
