// Surface nodes beside other corrections at boundaries (Sca23 5).

#include "cases/papers/bodies/competitors.hpp"
#include "cases/papers/bodies/plane.hpp"
#include "tests/catch.hpp"

namespace bb = boundary_bodies;
using bb::Solid;
using plate::FluxRule;

namespace {

struct Problem {
  Solid solid;
  bb::Conditions conditions;
  bb::Field solution;

  Eigen::Array2d percent(const Eigen::VectorXd& u) const {  // Sca23 44
    return 100 * bb::largest_errors(solid, u, solution).array();
  }
  Eigen::Array2d uncorrected() const { return percent(bb::uncorrected(solid, conditions, solution)); }
  Eigen::Array2d position_aware() const {
    const plate::SparseStiffness K = bb::position_aware_stiffness(solid).sparseView();
    return percent(bb::on_nodes(solid, K, conditions, solution));
  }
  Eigen::Array2d mirrors(bool tangential) const {
    return percent(bb::with_mirror_nodes(solid, conditions, tangential));
  }
  Eigen::Array2d differential(bool stress_at_nodes) const {
    return percent(bb::with_differential_operator(solid, conditions, solution, stress_at_nodes));
  }
  Eigen::Array2d surface_nodes(int order, FluxRule rule) const {
    return percent(bb::with_surface_nodes(solid, order, rule, conditions));
  }
};

void check(const Eigen::Array2d& found, double u, double v) {
  CHECK(found[0] == Approx(u).epsilon(0.002));
  CHECK(found[1] == Approx(v).epsilon(0.002));
}

}  // namespace

TEST_CASE("competitors, pulled (Sca23 5): errors of u and v in percent") {
  const Solid s = bb::plane_square(0.3);
  const Problem p{s, bb::pulled(1, 1), bb::pulled_square(0.3)};
  check(p.uncorrected(), 17.26, 12.08);
  check(p.position_aware(), 4.913, 5.553);
  check(p.mirrors(false), 100.0, 18.37);
  check(p.surface_nodes(1, FluxRule::lever), 1.196, 0.5127);
  CHECK(p.mirrors(true).maxCoeff() < 1e-9);        // measured: 2e-11
  CHECK(p.differential(false).maxCoeff() < 1e-8);  // measured: 2e-10
  Problem fitted = p;
  fitted.solid.family = bb::fitted(s.family, s.horizon, s.influence);
  CHECK(fitted.surface_nodes(1, FluxRule::lever).maxCoeff() < 1e-9);  // measured: 5e-12
}

TEST_CASE("competitors, made-up loading (Sca23 4.2 in the plane): errors of u and v in percent") {
  const Solid s = bb::plane_square(0.3);
  const Problem p{s, bb::made(s, 0.3), bb::made_field};
  check(p.uncorrected(), 17.55, 11.11);
  check(p.position_aware(), 10.85, 7.728);
  check(p.mirrors(false), 73.47, 43.91);
  check(p.mirrors(true), 5.193, 10.91);
  check(p.differential(false), 17.57, 31.35);
  check(p.differential(true), 1.784, 2.792);
  check(p.surface_nodes(1, FluxRule::lever), 0.4997, 0.6078);
  check(p.surface_nodes(2, FluxRule::crossing_point), 0.2336, 0.2285);
}

TEST_CASE("competitors: the position-aware solid has the local energy of uniform stretch, at edges and corners too") {
  const Solid s = bb::plane_square(0.3);
  const Eigen::MatrixXd K = bb::position_aware_stiffness(s);
  CHECK((K - K.transpose()).norm() < 1e-12 * K.norm());  // measured: 2e-17
  const Eigen::VectorXd u = bb::at_unknowns(s, bb::pulled_square(0.3)).head(2 * s.body.real);
  CHECK(u.dot(K * u) == Approx(1 - 0.3 * 0.3).epsilon(1e-10));  // stress 1, strain (1 - nu^2) / E
}
