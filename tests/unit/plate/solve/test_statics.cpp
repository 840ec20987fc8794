#include "plate/solve/statics.hpp"

#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/family_weights.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "tests/catch.hpp"
#include "tests/dense.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;

namespace {

/// 5 x 6 points, one support of each way to hold: mirror images, ties, fixed points.
small_plate::Model held() {
  using enum SupportKind;
  return small_plate::model(geometry::rectangle(0, 0, 0.5, 0.6),
                            {{clamped, {"left"}, {}}, {simply_supported, {"right"}, {}}, {pinned, {}, {{0.2, 0.55}}}},
                            small_plate::spaced(0.1));
}

Forces pressure(const small_plate::Model& m) {
  const Load load{Pressure{.value = 2}};
  return nodal_forces(load, m.boundary.cloud, m.outline);
}

/// P (P^T K P)^-1 P^T f with dense matrices.
State dense_solution(const small_plate::Model& m, const Forces& load) {
  const Eigen::MatrixXd K = small_plate::stiffness(m.plate);
  const Eigen::MatrixXd P = small_plate::prolongation(m.boundary.constraints, K.rows());
  State state(3, m.points());
  state.reshaped() = P * dense::solution(dense::folded(K, P), P.transpose() * load.reshaped());
  return state;
}

/// |r| / |load| with |r|^2 = sum r_i^2 / m_i over the free degrees of freedom, m = diag(P^T diag(K) P).
double residual(const small_plate::Model& m, const State& state, const Forces& load) {
  const Eigen::MatrixXd K = small_plate::stiffness(m.plate);
  const Eigen::MatrixXd P = small_plate::prolongation(m.boundary.constraints, K.rows());
  const Eigen::VectorXd diagonal = P.cwiseAbs2().transpose() * K.diagonal(), f = P.transpose() * load.reshaped();
  const Eigen::VectorXd r = f - P.transpose() * (K * state.reshaped());
  return std::sqrt((r.array().square() / diagonal.array()).sum() / (f.array().square() / diagonal.array()).sum());
}

using Solver = StaticSolution (*)(const Operator&, const Constraints&, const Forces&, const StaticOptions&);
StaticSolution with_diagonal(const Operator& plate, const Constraints& constraints, const Forces& load,
                             const StaticOptions& options) {
  return conjugate_gradients(plate, constraints, load, options);
}

/// A multiple of the inverse.
class Dense : public Preconditioner {
public:
  Dense(const small_plate::Model& model, double factor) : model_(model), factor_(factor) {}
  void apply(const Forces& residual, State& result) const override {
    result = factor_ * dense_solution(model_, residual);
  }
  std::size_t bytes() const override { return 0; }

private:
  const small_plate::Model& model_;
  double factor_;
};

constexpr Solver solvers[] = {adaptive_dynamic_relaxation, with_diagonal};

}  // namespace

TEST_CASE("both solvers agree with a dense solution") {
  const auto m = held();
  const Forces load = pressure(m);
  const State expected = dense_solution(m, load);
  CHECK(expected.row(0).maxCoeff() > 0);
  for (const auto solve : solvers) {
    const auto solution = solve(m.plate, m.boundary.constraints, load, {1e-9, 20000, {}});
    CHECK(solution.converged);
    CHECK(solution.stop_reason == "residual below tolerance");
    CHECK((solution.state - expected).norm() < 1e-7 * expected.norm());  // measured: 2e-9
  }
}

TEST_CASE("the residual that stops the solvers is the one that is promised") {
  const auto m = held();
  const Forces load = pressure(m);
  for (const auto solve : solvers) {
    const auto solution = solve(m.plate, m.boundary.constraints, load, {1e-4, 20000, {}});
    CHECK(solution.converged);
    CHECK(solution.residual <= 1e-4);
    CHECK(solution.residual == Approx(residual(m, solution.state, load)).epsilon(1e-6));  // measured: 2e-12
  }
}

TEST_CASE("the solution fulfils the constraints") {
  const auto m = held();
  for (const auto solve : solvers) {
    const auto solution = solve(m.plate, m.boundary.constraints, pressure(m), {1e-6, 20000, {}});
    State again = solution.state;
    m.boundary.constraints.impose(again);
    CHECK(again == solution.state);
  }
}

TEST_CASE("too few iterations: not converged, and said") {
  const auto m = held();
  for (const auto solve : solvers) {
    std::size_t calls = 0;
    const StaticOptions options{1e-9, 7, [&](std::size_t, double) { ++calls; }};
    const auto solution = solve(m.plate, m.boundary.constraints, pressure(m), options);
    CHECK_FALSE(solution.converged);
    CHECK(solution.iterations == 7);
    CHECK(solution.stop_reason == "not converged in 7 iterations");
    CHECK(calls > 0);
  }
}

TEST_CASE("no load: nothing moves") {
  const auto m = held();
  for (const auto solve : solvers) {
    const auto solution = solve(m.plate, m.boundary.constraints, Forces::Zero(3, m.points()), {});
    CHECK(solution.converged);
    CHECK(solution.state.norm() == 0);
    CHECK_FALSE(solution.stop_reason.empty());
  }
}

TEST_CASE("a load that is not a number is an error with its iteration") {
  const auto m = held();
  Forces load = pressure(m);
  load(0, 10) = std::numeric_limits<double>::quiet_NaN();
  for (const auto solve : solvers) CHECK_THROWS_AS(solve(m.plate, m.boundary.constraints, load, {}), NumericalError);
}

TEST_CASE("the solution does not depend on the units") {
  // lengths in millimetres, forces in newtons unchanged: E 1e-6 times, pressure 1e-6 times, w 1e3 times
  const auto solve = [](double unit, Solver solver) {
    auto d = small_plate::spaced(0.1 * unit);
    const auto outline = geometry::rectangle(0, 0, 0.5 * unit, 0.4 * unit);
    auto section = small_plate::section;
    section.young /= unit * unit;
    section.thickness *= unit;
    auto cloud = geometry::lattice(outline, d.spacing);
    const auto cells = geometry::to_lattice(outline, cloud.units);
    auto b = boundary(std::move(cloud), cells, {{SupportKind::clamped, {"left", "right"}, {}}}, d);
    auto families = geometry::families(b.cloud, d.horizon(), sees(b, cells, d.horizon_ratio));
    auto shapes = bond_shapes(families.vectors(), section, d);
    const auto kinds = family_kinds(families, b.cloud.areas, b.active);
    auto weights = position_aware(families, shapes, b.cloud.areas, b.active, kinds, section).weights;
    const FamilyOperator op(std::move(families), std::move(shapes), b.cloud.areas, std::move(weights));
    const Load load{Pressure{.value = 2 / (unit * unit)}};
    auto solution = solver(op, b.constraints, nodal_forces(load, b.cloud, outline), {1e-8, 20000, {}});
    CHECK(solution.converged);
    solution.state.row(0) /= unit;
    return solution;
  };
  for (const auto solver : solvers) {
    const auto metres = solve(1, solver), millimetres = solve(1000, solver);
    CHECK((metres.state - millimetres.state).norm() < 1e-7 * metres.state.norm());  // measured: 4e-16
    CHECK(metres.iterations == Approx(double(millimetres.iterations)).margin(2));
  }
}

TEST_CASE("refined: an inverse that is nearly exact ends at the dense solution, one that is not is said not to") {
  const auto m = held();
  const Forces load = pressure(m);
  const State expected = dense_solution(m, load);
  const auto by = [&](double factor) {
    return refined(m.plate, m.boundary.constraints, load, {1e-9, 20, {}}, Dense(m, factor));
  };
  const auto solution = by(1.001);
  CHECK(solution.converged);
  CHECK(solution.iterations > 1);
  CHECK((solution.state - expected).norm() < 1e-7 * expected.norm());  // measured: 1e-9
  CHECK(!by(0.1).converged);
  CHECK(by(0.1).stop_reason == "the factor of the plate does not solve it");
  CHECK(refined(m.plate, m.boundary.constraints, 0 * load, {1e-9, 20, {}}, Dense(m, 1)).converged);
}
