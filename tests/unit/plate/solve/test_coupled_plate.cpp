#include "plate/solve/coupled_plate.hpp"

#include <Eigen/Cholesky>

#include "cases/input/case_file.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/errors.hpp"
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

namespace {

/// A pressed square on supports that push up, with an oblique crack that a moment closes.
Discretised pressed_on_supports(const std::string& formulation, bool ribbed,
                                const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings{
      "discretization={spacing=0.1,formulation='" + formulation + "'}", "geometry.cracks=[[[-0.35,-0.12],[0.3,0.17]]]",
      "cracks.contact=true", "support=[{kind='simply_supported',edges=['left','right','bottom','top'],pushes='up'}]",
      "load=[{kind='pressure',value=-1},{kind='edge_moment',edges=['bottom','top'],value=-0.2}]"};
  if (ribbed) settings.emplace_back("stiffener=[{along=[[-0.8,0.6],[0.8,0.7]],bending=0.5,axial=3,eccentricity=0.1}]");
  settings.insert(settings.end(), more.begin(), more.end());
  return discretise(case_text::read(case_text::plain, settings).content);
}

/// Gaps at supports that only push, from a state.
Eigen::VectorXd gaps_of(const Formulation& plate, const PushedPoints& points, const State& state) {
  State imposed = state;
  plate.constraints().impose(imposed);
  const State apart = state - imposed;
  const auto count = Eigen::Index(points.size());
  Eigen::MatrixXd products(count, count);
  Eigen::VectorXd along(count);
  std::vector<State> lifts;
  for (std::size_t i = 0; i < points.size(); ++i) lifts.push_back(points.lift(i));
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& lift = lifts[std::size_t(i)];
    along[i] = lift.cwiseProduct(apart).sum();
    for (Eigen::Index j = 0; j < count; ++j) products(i, j) = lift.cwiseProduct(lifts[std::size_t(j)]).sum();
  }
  return products.ldlt().solve(along);
}

}  // namespace

TEST_CASE("coupled plate: supports that only push and faces that touch are complementary together") {
  const auto [formulation, ribbed] =
      GENERATE(table<std::string, bool>({{"galerkin", false}, {"galerkin", true}, {"ordinary", false}}));
  CAPTURE(formulation, ribbed);
  const auto plates = pressed_on_supports(formulation, ribbed);
  const auto &plate = *plates.plate, &membrane = *plates.membrane;
  const PlateLoads loads{plate.total_load(), membrane.total_load()};
  const auto found = CoupledPlate(plate, membrane).equilibrium(loads, {1e-10, 1000, {}});
  REQUIRE(found.of_both.converged);
  REQUIRE(found.lifted);
  CHECK(found.lifted->share > 0.1);
  CHECK(found.lifted->share < 0.7);
  const PushedPoints points(plate);
  const auto gaps = gaps_of(plate, points, found.bending);
  CHECK(gaps.maxCoeff() == Approx(found.lifted->largest_gap).epsilon(1e-7));
  const FaceRows rows(plate);
  const auto openings = rows.openings(found.bending, found.membrane);
  const auto& faces = found.touching->faces;
  REQUIRE(faces.size() == rows.pairs().size());
  const auto count = Eigen::Index(faces.size());
  Eigen::VectorXd forces(2 * count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (const bool top : {true, false}) {
      const auto& face = faces[std::size_t(i)];
      forces[top ? i : count + i] = (top ? face.force_top : face.force_bottom) * face.length;
    }
  CHECK(forces.maxCoeff() > 0);
  Forces across = loads.across + found.on_bending, in_plane = loads.in_plane + found.on_membrane, internal;
  rows.press(forces, across, in_plane);
  plate.internal_force(found.bending, internal);
  across += internal;
  const auto reactions = points.reactions(across);
  const double force = reactions.cwiseAbs().maxCoeff(), motion = gaps.maxCoeff(), opening = openings.maxCoeff();
  CHECK(reactions.minCoeff() > -1e-8 * force);
  CHECK(gaps.minCoeff() > -1e-8 * motion);
  CHECK(reactions.cwiseProduct(gaps).cwiseAbs().maxCoeff() < 1e-8 * force * motion);
  CHECK(forces.minCoeff() >= 0);
  CHECK(openings.minCoeff() > -1e-7 * opening);
  CHECK(openings.cwiseProduct(forces).cwiseAbs().maxCoeff() < 1e-7 * opening * forces.maxCoeff());
  plate.constraints().fold(across);
  CHECK(across.norm() < 1e-7 * loads.across.norm());
  membrane.internal_force(found.membrane, internal);
  in_plane += internal;
  pinned(membrane).fold(in_plane);
  CHECK(in_plane.norm() < 1e-8 * forces.norm());
  const double work =
      loads.across.cwiseProduct(found.bending).sum() + loads.in_plane.cwiseProduct(found.membrane).sum();
  CHECK(found.strain_energy() == Approx(work / 2).epsilon(1e-7));
}

TEST_CASE("coupled plate: supports that only push, with a crack that stays open, and none that lifts off") {
  const auto formulation = GENERATE(as<std::string>(), "galerkin", "ordinary");
  const auto open = pressed_on_supports(
      formulation, false,
      {"load=[{kind='pressure',value=-1},{kind='edge_traction',edges=['bottom','top'],value=100}]"});
  const PlateLoads loads{open.plate->total_load(), open.membrane->total_load()};
  const auto found = CoupledPlate(*open.plate, *open.membrane).equilibrium(loads, {1e-10, 1000, {}});
  const auto alone =
      solve_static(*open.plate, loads.across, StaticMethod::direct, Preconditioning::automatic, {1e-10, 1000, {}});
  CHECK(found.touching->largest_force() == 0);
  CHECK(found.lifted->share == alone.lifted->share);
  CHECK(found.lifted->largest_gap == Approx(alone.lifted->largest_gap).epsilon(1e-7));
  CHECK((found.bending - alone.solution.state).norm() < 1e-7 * found.bending.norm());
  const auto off = pressed_on_supports(formulation, false, {"load=[{kind='pressure',value=1}]"});
  CHECK_THROWS_AS(CoupledPlate(*off.plate, *off.membrane)
                      .equilibrium({off.plate->total_load(), off.membrane->total_load()}, {1e-10, 1000, {}}),
                  NumericalError);
}
