#include "plate/model/nodal_forces.hpp"

#include "geometry/lattice/cloud.hpp"
#include "plate/model/loads.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

TEST_CASE("a force that moves keeps its size and its place, and acts between its ends alone") {
  const auto cloud = geometry::lattice(geometry::rectangle(0, 0, 2, 1), 0.1);
  const Load load{PointForce{.value = -3, .path = {{0, 0.3}, {1, 0.3}, {1.8, 0.9}}, .speed = 2}};
  const auto moving = moving_forces(load, cloud);
  CHECK(moving.stations.back().time == Approx(1));
  for (const double time : {0.0, 0.123, 0.5, 0.77, 1.0}) {
    const Forces forces = moving.whole(time, cloud.size());
    const Point x = time <= 0.5 ? Point(2 * time, 0.3) : Point(1 + 1.6 * (time - 0.5), 0.3 + 1.2 * (time - 0.5));
    double sum = 0, moment_x = 0, moment_y = 0;
    for (Eigen::Index k = 0; k < forces.cols(); ++k) {
      const auto& at = cloud.positions[std::size_t(k)];
      sum += forces(0, k), moment_x += forces(1, k) + at.y() * forces(0, k);
      moment_y += forces(2, k) - at.x() * forces(0, k);
    }
    CHECK(sum == Approx(-3));
    CHECK(moment_x == Approx(-3 * x.y()));
    CHECK(moment_y == Approx(3 * x.x()).margin(1e-9));
  }
  for (const double time : {-0.1, 1.1}) CHECK(moving.whole(time, cloud.size()).isZero(0));
}

TEST_CASE("a part that is pressed moves as a whole") {
  const auto cloud = geometry::lattice(geometry::rectangle(0, 0, 2, 1), 0.1);
  const Load load{Pressure{
      .value = 5, .patch = geometry::Circle{{0.5, 0.5}, 0.2, ""}, .path = {{0.5, 0.5}, {1.5, 0.5}}, .speed = 1}};
  const auto moving = moving_forces(load, cloud);
  for (const double time : {0.0, 0.31, 1.0}) {
    const Forces forces = moving.whole(time, cloud.size());
    CHECK(forces.row(0).sum() == Approx(5 * 0.04 * std::acos(-1.0)).epsilon(1e-6));
  }
}
