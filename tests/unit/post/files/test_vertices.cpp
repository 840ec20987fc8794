#include "post/files/frame.hpp"

#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

TEST_CASE("vertices: corners have what their sources give them, by the weights that are wanted") {
  auto mesh = small_run::mesh();
  mesh.corners = {{{3, 4}, {{1, 1.5, 0.25}, {4, -0.5, 0.75}}}, {{8, 9}, {}}};
  const auto places = post::vertices(mesh);
  REQUIRE(places.size() == 8);
  CHECK(places[4] == mesh.positions[4]);
  CHECK(places[6] == geometry::Point(3, 4));
  const Eigen::MatrixXd values = Eigen::MatrixXd::Random(2, 6);
  const auto linear = post::at_vertices(mesh, values, &plate::Mesh::Source::linear);
  REQUIRE(linear.cols() == 8);
  CHECK(linear.leftCols(6) == values);
  CHECK((linear.col(6) - (1.5 * values.col(1) - 0.5 * values.col(4))).norm() < 1e-15);
  CHECK(linear.col(7).norm() == 0);  // nothing to take it from
  const auto mean = post::at_vertices(mesh, values, &plate::Mesh::Source::mean);
  CHECK((mean.col(6) - (0.25 * values.col(1) + 0.75 * values.col(4))).norm() < 1e-15);
}
