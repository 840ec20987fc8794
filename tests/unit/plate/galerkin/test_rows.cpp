#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

TEST_CASE("the rows and lists of the Galerkin plate are the sum of its families") {
  auto all = gp::scenes();
  all.push_back(gp::cells(geometry::rectangle(0, 0, 2.5, 1.2), 0.1));  // with rows of points
  all.push_back(gp::cells(geometry::rectangle(0, 0, 3, 2), 0.1, {{{0.7, 1}, {2, 1}}}));
  for (const auto& cells : all)
    for (const double thickness : {0.1, 0.001}) {
      Section section = gp::section;
      section.thickness = thickness;
      const GalerkinOperator op(gp::families(cells), section);
      const Eigen::MatrixXd K = gp::stiffness(op.families(), section);
      CHECK((K - K.transpose()).cwiseAbs().maxCoeff() < 1e-14 * K.cwiseAbs().maxCoeff());
      const State u = gp::random_state(op.points(), 3);
      Forces force, absolute;
      op.internal_force(u, force);
      const double scale = (K * u.reshaped<Eigen::ColMajor>()).cwiseAbs().maxCoeff();
      CHECK((force.reshaped<Eigen::ColMajor>() + K * u.reshaped<Eigen::ColMajor>()).cwiseAbs().maxCoeff() <
            1e-13 * scale);
      CHECK((op.diagonal().reshaped<Eigen::ColMajor>() - K.diagonal()).cwiseAbs().maxCoeff() <
            1e-13 * K.diagonal().maxCoeff());
      const State positive = u.cwiseAbs();
      op.absolute_product(positive, absolute);
      const Eigen::VectorXd least = K.cwiseAbs() * positive.reshaped<Eigen::ColMajor>();
      CHECK((absolute.reshaped<Eigen::ColMajor>() - least).minCoeff() > -1e-12 * least.maxCoeff());
    }
}
