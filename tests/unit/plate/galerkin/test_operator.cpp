#include <omp.h>
#include <catch2/catch.hpp>

#include "plate/galerkin/resultants.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

namespace {

double energy(const GalerkinFamilies& families, const Section& s, const State& u) {
  double sum = 0;
  for (std::size_t k = 0; k < families.areas.size(); ++k) sum += family_energy(families, s, k, u);
  return sum;
}

}  // namespace

TEST_CASE("the force of the Galerkin plate is minus the derivative of its energy") {
  for (const auto& cells : gp::scenes()) {
    const GalerkinOperator op(gp::families(cells), gp::section);
    const State u = gp::random_state(op.points(), 1), v = gp::random_state(op.points(), 2);
    Forces force;
    op.internal_force(u, force);
    const double ahead = energy(op.families(), gp::section, u + v), back = energy(op.families(), gp::section, u - v);
    CHECK(-force.cwiseProduct(v).sum() ==
          Approx((ahead - back) / 2).epsilon(1e-11));  // measured: 1e-14; it is quadratic
    CHECK(op.energies(u).sum() == Approx(energy(op.families(), gp::section, u)).epsilon(1e-12));
    CHECK(-force.cwiseProduct(u).sum() == Approx(2 * energy(op.families(), gp::section, u)).epsilon(1e-12));
  }
}

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

TEST_CASE("any number of threads gives the same force") {
  const GalerkinOperator op(galerkin_families(gp::cells(gp::with_hole(), 0.02, {{{0.8, 0.42}, {1.0, 0.47}}})),
                            gp::section);
  const State u = gp::random_state(op.points(), 4);
  const int before = omp_get_max_threads();
  Forces one, three;
  omp_set_num_threads(1);
  op.internal_force(u, one);
  omp_set_num_threads(3);
  op.internal_force(u, three);
  omp_set_num_threads(before);
  CHECK(one == three);
}

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

TEST_CASE("only rigid motions cost no energy, whatever the thickness and Poisson's ratio") {
  for (const auto& cells : gp::scenes())
    for (const double thickness : {0.1, 0.001})
      for (const double nu : {-0.5, 0.0, 0.3, 0.49}) {
        Section section = gp::section;
        section.thickness = thickness, section.poisson = nu;
        const Eigen::MatrixXd K = gp::stiffness(gp::families(cells), section);
        // scaled to a unit diagonal: rotations and deflections are of one size
        const Eigen::VectorXd scale = K.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::VectorXd values = dense::eigenvalues(dense::scaled(K, scale));
        const double largest = values[values.size() - 1];
        INFO("thickness " << thickness << ", nu " << nu << ", fourth " << values[3] / largest);
        CHECK(values[0] > -1e-13 * largest);
        CHECK(values[2] < 1e-12 * largest);  // measured: 1e-15
        CHECK(values[3] > 1e-7 * largest);   // measured: 2e-6 for the thin plates
      }
}
