#include "plate/solve/statics.hpp"

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

const std::string two_loads = plain + "[[load]]\nkind = \"point_force\"\nvalue = 0.3\nposition = [0.4, 0.5]\n";

std::unique_ptr<plate::Formulation> plate_of(const std::vector<std::string>& settings) {
  return std::move(plate::discretise(read(two_loads, settings).content).plate);
}

}  // namespace

TEST_CASE("static solver: by the factor every load has what it has alone, in bits") {
  for (const char* formulation : {"galerkin", "ordinary"}) {
    const auto plate =
        plate_of({"discretization.spacing=0.1", "discretization.formulation=" + std::string(formulation)});
    plate::StaticSolver solver(*plate, plate::StaticMethod::direct, plate::Preconditioning::automatic);
    for (const auto& load : plate->loads()) {
      const plate::StaticOptions options{1e-10, 1000, {}};
      const auto one = solver(load.forces, options, true);
      const auto alone = plate::solve_static(*plate, load.forces, plate::StaticMethod::direct,
                                             plate::Preconditioning::automatic, options);
      CHECK(one.method == "direct");
      CHECK(one.solution.state == alone.solution.state);
    }
  }
}

TEST_CASE("static solver: conjugate gradients begin at what earlier solutions give") {
  const auto plate = plate_of({"discretization.spacing=0.1", "discretization.formulation=ordinary"});
  const plate::Forces first = plate->loads()[0].forces, second = plate->loads()[1].forces,
                      both = 2 * first - 3 * second;
  plate::StaticSolver solver(*plate, plate::StaticMethod::cg, plate::Preconditioning::diagonal);
  const plate::StaticOptions options{1e-10, 10000, {}};
  const auto a = solver(first, options, true), b = solver(second, options, true), sum = solver(both, options, true);
  CHECK(a.solution.iterations > 20);
  CHECK(b.solution.iterations > 20);
  CHECK(sum.solution.converged);
  CHECK(sum.solution.iterations <= 2);  // measured: 0
  const plate::State expected = 2 * a.solution.state - 3 * b.solution.state;
  CHECK((sum.solution.state - expected).norm() < 1e-8 * expected.norm());  // measured: 1e-12
  const auto again = solver(second, options);
  CHECK(again.solution.iterations <= 2);
  plate::StaticSolver fresh(*plate, plate::StaticMethod::cg, plate::Preconditioning::diagonal);
  const auto alone = fresh(second, options).solution;
  CHECK((b.solution.state - alone.state).norm() < 1e-8 * alone.state.norm());  // measured: 1e-10
}

TEST_CASE("static solver: a plate on soft soil or springs is in equilibrium to rounding") {
  for (const char* formulation : {"galerkin", "ordinary"})
    for (const std::string held :
         {"foundation=[{modulus=1e-9}]", "spring=[{edges=[\"left\",\"top\"],deflection=1e-9}]"}) {
      const auto plate = plate_of(
          {"discretization.spacing=0.1", "-support", held, "discretization.formulation=" + std::string(formulation)});
      const plate::Forces load = plate->total_load();
      plate::StaticSolver solver(*plate, plate::StaticMethod::cg, plate::Preconditioning::automatic);
      const auto solution = solver(load, {1e-8, 10000, {}}).solution;
      REQUIRE(solution.converged);
      plate::Forces pressed = plate::zero_like(load);
      plate->boundary().elastic_supports.add_force(solution.state, pressed);
      CAPTURE(formulation, held);
      double force = 0, moment = 0;
      for (Eigen::Index k = 0; k < load.cols(); ++k) {
        const auto x = plate->cloud().positions[std::size_t(k)];
        const auto sum = (load + pressed).col(k);
        force += sum[0], moment += x.x() * sum[0] - sum[2];
      }
      const double size = load.row(0).sum();
      CHECK(std::abs(force) < 1e-8 * size);
      CHECK(std::abs(moment) < 1e-8 * size);
      const auto [rigid, rest] = plate::split_load(*plate, load);
      CHECK((solution.state - rigid).cwiseAbs().maxCoeff() < 1e-4 * rigid.cwiseAbs().maxCoeff());
      CHECK(std::abs(rest.row(0).sum()) < 1e-9 * size);
    }
  const auto held = plate_of({"discretization.spacing=0.1", "foundation=[{modulus=1}]"});
  CHECK(plate::split_load(*held, held->total_load()).rigid.cols() == 0);
}

TEST_CASE("static solver: the nearest sum of states leaves a residual that none of them feels") {
  const auto plate = plate_of({"discretization.spacing=0.2", "discretization.formulation=ordinary"});
  std::vector<plate::State> states;
  std::vector<plate::Forces> forces(2);
  for (const auto& load : plate->loads()) states.push_back(load.forces);
  for (auto& state : states) plate->constraints().impose(state);
  for (std::size_t i = 0; i < 2; ++i) plate->internal_force(states[i], forces[i]);
  const plate::Forces load = plate->total_load();
  CHECK_FALSE(plate::nearest({}, {}, load, plate->constraints()));
  plate::Forces residual;
  plate->internal_force(*plate::nearest(states, forces, load, plate->constraints()), residual);
  residual += load;
  for (const auto& state : states)
    CHECK(std::abs(state.cwiseProduct(residual).sum()) < 1e-10 * std::abs(state.cwiseProduct(load).sum()));
}
