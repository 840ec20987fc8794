#include "plate/bonds/stretching.hpp"

#include <array>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
using geometry::Point;

namespace bond_stretching {

/// The square of side 2 with 10 x 10 points, held all round.
cases::Case held_square(SupportKind kind, InPlane in_plane, bool cracked) {
  auto c = verified_plate::square(0.2);
  c.supports = {verified_plate::held_all_round(kind)};
  c.supports[0].in_plane = in_plane;
  if (cracked) c.cracks = {{{-0.5, 0.05}, {0.5, 0.05}}};
  c.stretches = true;
  return c;
}

std::vector<cases::Case> scenes() {
  using enum SupportKind;
  return {held_square(simply_supported_hard, InPlane::free, false), held_square(simply_supported, InPlane::fixed, true),
          held_square(clamped, InPlane::normal, true), held_square(free, InPlane::tangential, false)};
}

/// Product of a symmetric matrix of points with values of its points.
State product(const PointMatrix& matrix, const State& values) {
  State result = zero_like(values);
  for (std::uint32_t c = 0; c < matrix.points(); ++c)
    for (auto at = matrix.first[c]; at < matrix.first[c + 1]; ++at) {
      const auto row = matrix.row[at];
      result.col(row) += matrix.block[at] * values.col(c);
      if (row != c) result.col(c) += matrix.block[at].transpose() * values.col(row);
    }
  return result;
}

/// w = a . x, u = -a (a . x) / 2: the plate is tilted as a rigid body, moderately.
std::array<State, 2> tilted(const Formulation& plate, const Point& a) {
  State w = zero_state(plate.points()), u = w;
  for (std::size_t k = 0; k < plate.points(); ++k) {
    const double along = a.dot(plate.cloud().positions[k]);
    w(0, Eigen::Index(k)) = along;
    u.col(Eigen::Index(k)) << 0, a.y() * along / 2, -a.x() * along / 2;
  }
  return {w, u};
}

}  // namespace bond_stretching

namespace bs = bond_stretching;
namespace vp = verified_plate;

TEST_CASE("bonds stretch: forces are the derivative of the energy, the stiffness is that of the forces") {
  constexpr double step = 1e-5;
  for (const auto& c : bs::scenes()) {
    const auto plates = discretise(c);
    const auto stretching = plates.membrane->stretching();
    const State w = 0.1 * vp::random_state(*plates.plate, 5), u = 0.01 * vp::random_state(*plates.membrane, 7);
    const State dw = vp::random_state(*plates.plate, 8), du = vp::random_state(*plates.membrane, 9);
    REQUIRE(w.cols() == u.cols());
    const auto energy = [&](double share) { return stretching->energies(w + share * dw, u + share * du).sum(); };
    Forces on_bending, on_membrane, before_w, before_u, after_w, after_u;
    stretching->internal_force(w, u, on_bending, on_membrane);
    const double work = on_bending.cwiseProduct(dw).sum() + on_membrane.cwiseProduct(du).sum();
    const double slope = (energy(step) - energy(-step)) / (2 * step);
    CHECK(std::abs(slope + work) < 1e-7 * std::abs(slope));  // 9e-9
    CHECK(on_bending.bottomRows(2).isZero(0));
    CHECK(on_membrane.row(0).isZero(0));

    stretching->internal_force(w - step * dw, u - step * du, before_w, before_u);
    stretching->internal_force(w + step * dw, u + step * du, after_w, after_u);
    const State change = stacked(before_w - after_w, before_u - after_u) / (2 * step);
    const State by_matrix = bs::product(stretching->stiffness(w, u), stacked(dw, du));
    CHECK((by_matrix - change).norm() < 1e-7 * change.norm());  // 1e-9
  }
}

TEST_CASE("bonds stretch: a flat plate has the energy of its plane, and the geometric stiffness of its forces") {
  for (const auto& c : bs::scenes()) {
    const auto plates = discretise(c);
    const auto& membrane = *plates.membrane;
    const auto stretching = membrane.stretching();
    const State u = 0.01 * vp::random_state(membrane, 7), flat = zero_like(u), w = vp::random_state(*plates.plate, 8);
    CHECK((stretching->energies(flat, u) - membrane.energies(u)).norm() < 1e-12 * membrane.energies(u).norm());
    const State all = bs::product(stretching->stiffness(flat, u), stacked(w, flat));
    const State geometric = bs::product(stretching->geometric_stiffness(u), w);
    State across = zero_like(w);
    across.row(0) = geometric.row(0);
    CHECK((of_plate(all) - across).norm() < 1e-12 * across.norm());
    CHECK(of_plane(all).norm() < 1e-12 * across.norm());
  }
}

TEST_CASE("bonds stretch: a tilted plate has no strain, and a constant slope alone the energy of its strain") {
  const Point a(0.3, -0.2);
  const Eigen::Vector3d strain(a.x() * a.x() / 2, a.y() * a.y() / 2, a.x() * a.y());
  for (const auto& c : bs::scenes()) {
    const auto plates = discretise(c);
    const auto& membrane = *plates.membrane;
    const auto stretching = membrane.stretching();
    const auto [w, u] = bs::tilted(membrane, a);
    const State flat = zero_like(w);
    const auto stiffness = LocalSection(membrane.section()).bending;
    const double sloped = stretching->energies(w, flat).sum(), exact = strain.dot(stiffness * strain) / 2 * 4;
    CHECK(stretching->energies(w, u).sum() < 1e-25 * sloped);  // 1e-31
    // corners of edges that are free in the plane have mixed weights: 0.24 %
    CHECK(std::abs(sloped / exact - 1) < (membrane.fictitious_bonds() == 0 ? 4e-3 : 3e-3));
    const auto forces = stretching->membrane_forces(w, flat);
    REQUIRE(forces.cols() == Eigen::Index(membrane.cloud().plate_points));
    for (Eigen::Index k = 0; k < forces.cols(); ++k)
      CHECK((forces.col(k) - stiffness * strain).norm() < 1e-12 * (stiffness * strain).norm());
  }
}

TEST_CASE(
    "bonds stretch: a plate and its plane share points beyond edges, which have bonds where their own supports say") {
  const auto joined = discretise(bs::held_square(SupportKind::simply_supported_hard, InPlane::free, false));
  CHECK(joined.membrane->points() == joined.plate->points());
  CHECK(joined.membrane->fictitious_bonds() == 0);
  CHECK(joined.plate->fictitious_bonds() > 0);

  auto c = bs::held_square(SupportKind::simply_supported, InPlane::fixed, false);
  const auto soft = discretise(c);
  CHECK(soft.plate->fictitious_bonds() == 0);
  CHECK(soft.membrane->fictitious_bonds() > 0);
  const auto& positions = soft.plate->cloud().positions;
  State w = zero_state(soft.plate->points());
  for (std::size_t k = 0; k < soft.plate->cloud().plate_points; ++k)
    w(0, Eigen::Index(k)) = (1 - std::pow(positions[k].x(), 2)) * (1 - std::pow(positions[k].y(), 2));
  soft.plate->constraints().impose(w);
  for (std::size_t k = soft.plate->cloud().plate_points; k < positions.size(); ++k) {
    const bool corner = positions[k].cwiseAbs().minCoeff() > 1;
    CHECK((w(0, Eigen::Index(k)) < 0) != corner);  // odd beyond edges, even beyond corners
  }

  c.stretches = false;  // without the feature there are no such points
  CHECK(discretise(c).plate->fictitious_points() == 0);
}
