// Three pins hold a plate as three hands would: what each carries follows from equilibrium, wherever among the points
// they stand.
#include <Eigen/LU>

#include "plate/formulation/boundary.hpp"
#include "plate/formulations.hpp"
#include "plate/solve/statics.hpp"
#include "post/report/reactions.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point;

namespace {

Load growing_pressure(double value, const Point& gradient) {
  return {Pressure{.value = value, .gradient = gradient}};
}

Load force(double value, const Point& at) {
  return {PointForce{.position = at, .value = value}};
}

/// Forces of the pins along w.
std::vector<double> reactions(const cases::Case& c, std::size_t pins) {
  const auto plate = vp::assembled(c);
  const auto state =
      solve_static(*plate, plate->total_load(), StaticMethod::direct, Preconditioning::automatic, {1e-11, 200000, {}})
          .solution.state;
  const post::Supports supports(plate->boundary());
  Forces internal;
  plate->internal_force(state, internal);
  const auto balance =
      supports.balance(plate->constraints().on_held(internal), supports.applied(plate->total_load()), nullptr, state);
  std::vector<double> result;
  for (std::size_t i = balance.supports.size() - pins; i < balance.supports.size(); ++i)
    result.push_back(balance.supports[i].force);
  return result;
}

}  // namespace

TEST_CASE("three pins carry what equilibrium says, wherever they stand among the points") {
  constexpr double side = 2, pressure = 1, at_point = -0.7;
  const Point gradient(0.4, -0.3), where(0.33, -0.21);
  for (const auto* kind : formulations())
    for (const auto& [dx, dy] : {std::pair(0.0, 0.0), {0.03, 0.013}, {0.05, 0.0}, {0.049, 0.049}, {-0.02, 0.04}}) {
      auto c = vp::free_plate(geometry::rectangle(-side / 2, -side / 2, side / 2, side / 2), 0.1);
      c.discretization.formulation = kind;
      c.section = vp::section;
      const Point shift(dx, dy);
      const std::vector<Point> pins{Point(-0.55, -0.45) + shift, Point(0.65, -0.35) + shift,
                                    Point(-0.15, 0.65) + shift};
      c.supports = {{SupportKind::pinned, {}, pins}};
      c.loads = {growing_pressure(pressure, gradient), force(at_point, where)};
      // force and moments of the loads: the pressure's gradient turns the plate by its second moment of area
      const double area = side * side, second = area * side * side / 12;
      const Eigen::Vector3d loads = Eigen::Vector3d(pressure * area, second * gradient.x(), second * gradient.y()) +
                                    at_point * Eigen::Vector3d(1, where.x(), where.y());
      Eigen::Matrix3d arms;
      for (int i = 0; i < 3; ++i) arms.col(i) << 1, pins[std::size_t(i)].x(), pins[std::size_t(i)].y();
      const Eigen::Vector3d expected = -arms.inverse() * loads;
      const auto found = reactions(c, 3);
      CAPTURE(kind->name, dx, dy);
      for (std::size_t i = 0; i < 3; ++i)
        CHECK(found[i] == Approx(expected[Eigen::Index(i)]).epsilon(0).margin(1e-8));  // measured: below 1e-10
    }
}
