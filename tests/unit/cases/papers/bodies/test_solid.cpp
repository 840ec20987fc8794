#include "cases/papers/bodies/solid.hpp"

#include "cases/papers/bodies/boxes.hpp"
#include "cases/papers/bodies/plane.hpp"
#include "tests/catch.hpp"

namespace bb = boundary_bodies;

TEST_CASE("solid: stiffness without corrections is symmetric, and no rigid motion needs a force, in every dimension") {
  const Eigen::Matrix3d W{{0, -0.2, 0.5}, {0.2, 0, -0.3}, {-0.5, 0.3, 0}};
  for (const auto& body : {bb::plane_square(0.3, 7), bb::elastic_box({4, 3, 5}, 0.1)}) {
    const plate::SparseStiffness K = bb::uncorrected_stiffness(body);
    const plate::SparseStiffness T = K.transpose();
    CHECK((K - T).norm() < 1e-12 * K.norm());
    const bool plane = body.dimension() == 2;
    const auto motion = [&](const Eigen::Vector3d& x) {
      return Eigen::Vector3d(Eigen::Vector3d(1, 2, 3) +
                             (plane ? Eigen::Vector3d(-x[1], x[0], 0) : Eigen::Vector3d(W * x)));
    };
    const Eigen::VectorXd u = bb::at_unknowns(body, motion).head(K.rows());
    CHECK((K * u).cwiseAbs().maxCoeff() < 1e-12 * K.norm());
    CHECK((K * Eigen::VectorXd::LinSpaced(K.rows(), 0, 1)).cwiseAbs().maxCoeff() > 1e-6 * K.norm());
  }
}
