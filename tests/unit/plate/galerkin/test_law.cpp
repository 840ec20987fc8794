#include "plate/galerkin/families.hpp"

#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

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

TEST_CASE("Galerkin law: shear is scaled by the thickness, or by the bending beside shear that is softer") {
  constexpr double square = 0.09;  // of the spacing
  const auto& s = gp::section;
  LocalSection section(s);
  const double own = s.thickness * s.thickness, scaled = own / (own + 0.05 * square);
  CHECK(GalerkinStiffness(section, square).shear(0, 0) == scaled * section.shear(0, 0));
  section.shear.setZero();  // as of a plate in its plane
  CHECK(GalerkinStiffness(section, square).shear.isZero());
  // D (1 - nu) is the least stiffness against bending
  for (const double shear : {1e-3, 1e-6}) {
    LocalSection soft(s);
    soft.shear *= shear;
    const double length = 4.8 * s.bending_stiffness() * (1 - s.poisson) / soft.shear(0, 0);
    CHECK(GalerkinStiffness(soft, square).shear(1, 1) ==
          Approx(length / (length + 0.05 * square) * soft.shear(1, 1)).epsilon(1e-12));
    CHECK(GalerkinStiffness(soft, square).shear(1, 1) > 0.99 * soft.shear(1, 1));
  }
}

TEST_CASE(
    "Galerkin law: constant curvature and constant shear have the plate's energy, the shear of thin plates less") {
  const auto& s = gp::section;
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    double area = 0, softened = 0, bending = 0, shear = 0;
    State sheared = State::Zero(3, Eigen::Index(cells.positions.size()));
    for (std::size_t k = 0; k < cells.positions.size(); ++k)
      sheared(0, Eigen::Index(k)) = 3 * cells.positions[k].x() - 4 * cells.positions[k].y();
    const State bent = gp::bent(cells, 1, -2, 0.5);
    for (std::size_t k = 0; k < cells.positions.size(); ++k) {
      area += families.areas[k];
      const double h = s.thickness;
      softened += families.areas[k] * h * h / (h * h + 0.05 * families.square(k));
      bending += family_energy(families, s, k, bent), shear += family_energy(families, s, k, sheared);
    }
    // D / 2 (kx^2 + ky^2 + 2 nu kx ky + 2 (1 - nu) kxy^2)
    CHECK(bending ==
          Approx(area * s.bending_stiffness() / 2 * (5 - 4 * s.poisson + (1 - s.poisson) / 2)).epsilon(1e-11));
    CHECK(shear == Approx(softened * s.shear_stiffness() * 25 / 2).epsilon(1e-11));  // measured: 1e-14
  }
}
