#include "plate/galerkin/stretching.hpp"

#include <Eigen/Eigenvalues>

#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

namespace {

Section membrane() {
  Section result = gp::section;
  result.law = PlateLaw::membrane;
  return result;
}

/// All degrees of freedom of both states, as one vector: by points, those of the plate first.
Eigen::VectorXd joined(const State& bending, const State& in_plane) {
  StateByPoints both(3, bending.cols() + in_plane.cols());
  both << bending, in_plane;
  return both.reshaped();
}

Eigen::MatrixXd dense(const PointMatrix& matrix) {
  const auto size = Eigen::Index(3 * matrix.points());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t c = 0; c < matrix.points(); ++c)
    for (auto at = matrix.first[c]; at < matrix.first[c + 1]; ++at) {
      const auto row = Eigen::Index(3 * matrix.row[at]), column = Eigen::Index(3 * c);
      result.block<3, 3>(row, column) = matrix.block[at];
      result.block<3, 3>(column, row) = matrix.block[at].transpose();
    }
  return result;
}

/// Slopes of about a tenth.
State slopes(std::size_t points) {
  return 0.1 * gp::random_state(points, 5);
}

/// A section of two plies that couples, and its plane.
Section cross_ply(PlateLaw law) {
  Section result = gp::section;
  for (const double angle : {10.0, 80.0}) {
    Ply ply;
    static_cast<Orthotropy&>(ply) = {25000, 1000, 0.25, 500, 500, 200, angle};
    ply.thickness = result.thickness / 2;
    result.plies.push_back(ply);
  }
  result.law = law;
  return result;
}

/// Checks forces against differences of the energy, and the stiffness against those of the forces.
void require_derivatives(const GalerkinStretching& stretching, std::size_t points) {
  constexpr double step = 1e-5;
  const State w = slopes(points), u = 0.01 * gp::random_state(points, 7);
  const State dw = gp::random_state(points, 8), du = gp::random_state(points, 9);
  const auto energy = [&](double share) { return stretching.energies(w + share * dw, u + share * du).sum(); };
  Forces on_bending, on_membrane, before_w, before_u, after_w, after_u;
  stretching.internal_force(w, u, on_bending, on_membrane);
  const double work = on_bending.cwiseProduct(dw).sum() + on_membrane.cwiseProduct(du).sum();
  const double slope = (energy(step) - energy(-step)) / (2 * step);
  CHECK(std::abs(slope + work) < 1e-6 * std::abs(slope));
  CHECK(on_membrane.row(0).isZero(0));

  stretching.internal_force(w - step * dw, u - step * du, before_w, before_u);
  stretching.internal_force(w + step * dw, u + step * du, after_w, after_u);
  const Eigen::VectorXd change = (joined(before_w, before_u) - joined(after_w, after_u)) / (2 * step);
  const Eigen::VectorXd product = dense(stretching.stiffness(w, u)) * joined(dw, du);
  INFO("off by " << (product - change).norm() / change.norm());
  CHECK((product - change).norm() < 1e-6 * change.norm());
}

}  // namespace

TEST_CASE("stretching: forces are the derivative of the energy, the stiffness is that of the forces") {
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    const PointSections sections(membrane());
    const GalerkinStretching stretching(families, sections);
    require_derivatives(stretching, families.areas.size());
    Forces on_bending, on_membrane;
    stretching.internal_force(slopes(families.areas.size()), slopes(families.areas.size()), on_bending, on_membrane);
    CHECK(on_bending.bottomRows(2).isZero(0));
  }
}

TEST_CASE("stretching: a section that couples has the derivatives of its energy, and its linear coupling") {
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    const auto points = families.areas.size();
    const PointSections sections(cross_ply(PlateLaw::membrane));
    const auto section = cross_ply(PlateLaw::bending);
    REQUIRE(section.couples());
    const GalerkinStretching coupled(families, sections, galerkin_coupling(families, section)),
        alone(families, sections);
    require_derivatives(coupled, points);
    // without deflections its energy is the product of the matrix of the coupling
    State turned = slopes(points);
    turned.row(0).setZero();
    const State u = gp::random_state(points, 7);
    const double more = (coupled.energies(turned, u) - alone.energies(turned, u)).sum();
    const auto matrix = coupling_matrix(families, section);
    CHECK(more == Approx(turned.cwiseProduct(product(matrix, u)).sum()).epsilon(1e-10));
    Forces on_bending, on_membrane;
    coupled.internal_force(turned, u, on_bending, on_membrane);
    CHECK((on_bending + product(matrix, u)).norm() < 1e-10 * on_bending.norm());
  }
}

TEST_CASE("stretching: a flat plate has the energy of its plane, and the geometric stiffness of its forces") {
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    const PointSections sections(membrane());
    const GalerkinStretching stretching(families, sections);
    const auto points = families.areas.size();
    const State flat = zero_state(points), u = 0.01 * gp::random_state(points, 7);
    for (std::size_t k = 0; k < points; ++k) {
      const double own = family_energy(families, sections[k], k, u);
      CHECK(std::abs(stretching.energies(flat, u)[Eigen::Index(k)] - own) < 1e-12 * own);
    }
    const Eigen::MatrixXd all = dense(stretching.stiffness(flat, u)),
                          geometric = dense(stretching.geometric_stiffness(u));
    const auto size = geometric.rows();
    CHECK((all.topLeftCorner(size, size) - geometric).norm() < 1e-12 * geometric.norm());
    CHECK(all.bottomLeftCorner(size, size).norm() < 1e-12 * all.norm());
  }
}

TEST_CASE("stretching: held heat has the stiffness of the membrane forces that the free strains would need") {
  // heat that is the same everywhere, held: the forces of minus the displacements that it would give freely
  constexpr double free = 0.02;
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    const PointSections sections(membrane());
    const GalerkinStretching stretching(families, sections);
    const auto points = families.areas.size();
    State pressed = zero_state(points);
    for (std::size_t k = 0; k < points; ++k)
      pressed.col(Eigen::Index(k)) << 0, free * cells.positions[k].y(), -free * cells.positions[k].x();
    const Eigen::MatrixXd held = dense(
                              stretching.stiffness_of_heat(Eigen::VectorXd::Constant(Eigen::Index(points), free))),
                          expected = dense(stretching.geometric_stiffness(pressed));
    CHECK((held - expected).norm() < 1e-10 * expected.norm());
    // of one point alone: half its product with deflections is the energy of the squares of its slope
    Eigen::VectorXd one = Eigen::VectorXd::Zero(Eigen::Index(points));
    one[Eigen::Index(points / 2)] = free;
    const State w = gp::random_state(points, 3);
    const auto stretch = stretching.stretch(w);
    const LocalSection& section = sections[points / 2];
    const double stored =
        -families.areas[points / 2] * free *
        (section.bending * Eigen::Vector3d(1, 1, 0)).dot(stretch.strains.col(Eigen::Index(points / 2)));
    CHECK(w.cwiseProduct(product(stretching.stiffness_of_heat(one), w)).sum() / 2 == Approx(stored).epsilon(1e-10));
  }
}

TEST_CASE("stretching: a plate that is tilted and moves as a rigid body has no strain") {
  // w = a . x, u = -a (a . x) / 2: moderate rotations
  const Eigen::Vector2d a(0.3, -0.2);
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    const PointSections sections(membrane());
    const GalerkinStretching stretching(families, sections);
    State w = zero_state(cells.positions.size()), u = w;
    for (std::size_t k = 0; k < cells.positions.size(); ++k) {
      const double along = a.dot(cells.positions[k]);
      const Eigen::Vector2d moved = -a * along / 2;
      w(0, Eigen::Index(k)) = along;
      u.col(Eigen::Index(k)) << 0, -moved.y(), moved.x();
    }
    Forces on_bending, on_membrane;
    stretching.internal_force(w, u, on_bending, on_membrane);
    const double size = stretching.energies(w, zero_like(u)).sum();
    CHECK(stretching.energies(w, u).sum() < 1e-20 * size);
    CHECK(stretching.membrane_forces(w, u).cwiseAbs().maxCoeff() <
          1e-12 * stretching.membrane_forces(w, zero_like(u)).cwiseAbs().maxCoeff());
    const auto stretch = stretching.stretch(w);
    for (Eigen::Index k = 0; k < stretch.strains.cols(); ++k)
      CHECK((stretch.strains.col(k) - Eigen::Vector3d(a.x() * a.x() / 2, a.y() * a.y() / 2, a.x() * a.y())).norm() <
            1e-12);
  }
}
