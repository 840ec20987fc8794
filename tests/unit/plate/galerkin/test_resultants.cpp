#include "plate/galerkin/results.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

TEST_CASE("constant curvature has its moments, no shear, and no force but on the border") {
  for (const auto& cells : gp::scenes())
    for (const Eigen::Vector3d& k : {Eigen::Vector3d(1, 0, 0), {0, 1, 0}, {0, 0, 1}}) {
      const auto families = gp::families(cells);
      const State u = gp::bent(cells, k[0], k[1], k[2]);
      const auto r = resultants(u, families, gp::section);
      const double D = gp::section.bending_stiffness(), nu = gp::section.poisson;
      // tension on z > 0 where psi falls: M = -D (...)
      const Eigen::Vector3d wanted = -D * Eigen::Vector3d(k[0] + nu * k[1], k[1] + nu * k[0], (1 - nu) * k[2]);
      CHECK((r.moments.colwise() - wanted).cwiseAbs().maxCoeff() < 1e-11 * D);
      CHECK(r.shear.cwiseAbs().maxCoeff() < 1e-11 * D / 0.1);
      Forces force, edge = Forces::Zero(3, u.cols());
      GalerkinOperator(families, gp::section).internal_force(u, force);
      for (const auto& border : cells.borders) {
        const geometry::Point along = cells.positions[border.to] - cells.positions[border.from];
        const geometry::Point half(along.y() / 2, -along.x() / 2);
        const geometry::Point m(wanted[0] * half.x() + wanted[2] * half.y(),
                                wanted[2] * half.x() + wanted[1] * half.y());
        for (const auto p : {border.from, border.to}) edge.col(p) += Eigen::Vector3d(0, -m.y(), m.x());
      }
      CHECK((force + edge).cwiseAbs().maxCoeff() < 1e-11 * edge.cwiseAbs().maxCoeff());
    }
}
