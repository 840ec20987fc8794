#include "plate/galerkin/stretched_stiffeners.hpp"

#include "plate/galerkin/stretching.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

namespace {

Problem with_ribs() {
  Problem problem;
  for (const double eccentricity : {0.0, 0.08}) {
    Stiffener rib;
    rib.along = {{0.13, 0.21 + eccentricity}, {0.61, 0.43}};
    rib.axial = 30, rib.eccentricity = eccentricity;
    problem.stiffeners.push_back(rib);
  }
  return problem;
}

}  // namespace

TEST_CASE("stretched stiffeners: forces are the derivative of the energy, the stiffness is that of the forces") {
  constexpr double step = 1e-5;
  Section membrane = gp::section;
  membrane.law = PlateLaw::membrane;
  const PointSections sections(membrane);
  std::size_t crossed = 0;
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    const auto points = families.areas.size();
    const auto elements = axial_elements(with_ribs(), cells);
    crossed += elements.size();
    const StretchedStiffeners both(std::make_unique<GalerkinStretching>(families, sections), elements);
    const State w = 0.1 * gp::random_state(points, 5), u = 0.01 * gp::random_state(points, 7);
    const State dw = gp::random_state(points, 8), du = gp::random_state(points, 9);
    const auto energy = [&](double share) { return both.energies(w + share * dw, u + share * du).sum(); };
    const auto forces = [&](double share) {
      State moved = State(3, Eigen::Index(2 * points));
      Forces on_bending, on_membrane;
      both.internal_force(w + share * dw, u + share * du, on_bending, on_membrane);
      moved << on_bending, on_membrane;
      return moved;
    };
    State direction(3, Eigen::Index(2 * points));
    direction << dw, du;
    const double slope = (energy(step) - energy(-step)) / (2 * step);
    CHECK(std::abs(slope + forces(0).cwiseProduct(direction).sum()) < 1e-6 * std::abs(slope));
    const Forces change = (forces(-step) - forces(step)) / (2 * step);
    const Forces product = plate::product(both.stiffness(w, u), direction);
    CHECK((product - change).norm() < 1e-6 * change.norm());
  }
  CHECK(crossed > 20);
}
