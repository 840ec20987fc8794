#include "plate/solve/coupled_plate.hpp"

#include "cases/input/case_file.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace plate;

namespace {

/// A plate with an eccentric rib, pressed and pulled.
Discretised ribbed_and_pulled(double eccentricity) {
  return discretise(
      case_text::read(case_text::plain,
                      {"discretization.formulation=galerkin", "discretization.spacing=0.1", "geometry.cracks=[]",
                       "stiffener=[{ along = [[-0.8, 0.1], [0.8, 0.1]], bending = 0.5, axial = 3, eccentricity = " +
                           std::to_string(eccentricity) + " }]",
                       "load=[{ kind = 'pressure', value = 0.1 }, { kind = 'body_force', vector = [0.3, -0.2] }]"})
          .content);
}

}  // namespace

TEST_CASE("coupled plate: equilibrium of all forces, energy of half the work, more by eccentricity of either sign") {
  double side = 0;
  for (const double eccentricity : {0.2, -0.2}) {
    const auto plates = ribbed_and_pulled(eccentricity);
    const auto &plate = *plates.plate, &membrane = *plates.membrane;
    const PlateLoads loads{plate.total_load(), membrane.total_load()};
    const auto found = CoupledPlate(plate, membrane).equilibrium(loads, {1e-10, 1000, {}});
    REQUIRE(found.of_both.converged);
    const double work =
        loads.across.cwiseProduct(found.bending).sum() + loads.in_plane.cwiseProduct(found.membrane).sum();
    CHECK(found.strain_energy() == Approx(work / 2).epsilon(1e-8));
    Forces left;
    plate.internal_force(found.bending, left);
    left += loads.across + found.on_bending;
    plate.constraints().fold(left);
    CHECK(left.norm() < 1e-8 * loads.across.norm());
    CHECK(std::abs(found.coupling_energy) > 1e-5 * found.strain_energy());
    if (side != 0) CHECK(found.coupling_energy != Approx(side));
    side = found.coupling_energy;
  }
}

TEST_CASE("coupled plate: next to no eccentricity leaves bending and stretching alone") {
  const auto plates = ribbed_and_pulled(1e-9);
  const auto &plate = *plates.plate, &membrane = *plates.membrane;
  const auto found =
      CoupledPlate(plate, membrane).equilibrium({plate.total_load(), membrane.total_load()}, {1e-12, 1000, {}});
  const auto bent = static_solution(plate, {}, {1e-12, 100000, {}}).solution.state;
  CHECK((found.bending - bent).norm() < 1e-6 * bent.norm());
  CHECK(std::abs(found.coupling_energy) < 1e-6 * found.strain_energy());
}

TEST_CASE("coupled plate: large deflections of a ribbed plate have the derivatives of their energy") {
  constexpr double step = 1e-5;
  for (const double eccentricity : {0.2, 0.0}) {
    const auto plates = ribbed_and_pulled(eccentricity);
    const auto stretching = plates.membrane->stretching();
    const auto points = Eigen::Index(plates.plate->points());
    const State w = 0.1 * State::Random(3, points), dw = State::Random(3, points), du = State::Random(3, points);
    State u = 0.01 * State::Random(3, points);
    const auto energy = [&](double share) { return stretching->energies(w + share * dw, u + share * du).sum(); };
    const auto forces = [&](double share) {
      Forces on_bending, on_membrane;
      stretching->internal_force(w + share * dw, u + share * du, on_bending, on_membrane);
      return stacked(on_bending, on_membrane);
    };
    const double slope = (energy(step) - energy(-step)) / (2 * step);
    CHECK(slope == Approx(-forces(0).cwiseProduct(stacked(dw, du)).sum()).epsilon(1e-6));
    const State change = (forces(-step) - forces(step)) / (2 * step);
    const State found = product(stretching->stiffness(w, u), stacked(dw, du));
    CHECK((found - change).norm() < 1e-6 * change.norm());
    // without deflections, forces are those of the linear plane and of the coupling
    State turned = w;
    turned.row(0).setZero();
    Forces on_bending, on_membrane, linear;
    stretching->internal_force(turned, u, on_bending, on_membrane);
    plates.membrane->internal_force(u, linear);
    if (eccentricity != 0) linear -= product(plates.plate->coupling(), turned);
    CHECK((on_membrane - linear).norm() < 1e-10 * linear.norm());
    stretching->internal_force(w, zero_like(u), on_bending, on_membrane);
    CHECK((stretching->stretch(w).forces - on_membrane).norm() < 1e-12 * on_membrane.norm());
  }
}
