#include "plate/edges/extrapolation.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;

namespace {

double polynomial(const Eigen::Vector3d& x, int order) {
  return std::pow(0.7 + 0.11 * x[0] - 0.06 * x[1] + 0.08 * x[2], order);
}

Eigen::VectorXd at_unknowns(const LatticeBody& b, bool surface, int order) {
  Eigen::VectorXd u(b.real + (surface ? int(b.surface.size()) : 0));
  for (int k = 0; k < b.real; ++k) u[k] = polynomial(b.position(k), order);
  for (int s = b.real; s < int(u.size()); ++s) u[s] = polynomial(b.surface_position(s - b.real), order);
  return u;
}

double largest_error(const LatticeBody& b, Centre centre, int order) {
  const Eigen::VectorXd u = extrapolation(b, centre, order) * at_unknowns(b, centre == Centre::surface_node, order);
  double error = 0;
  for (int k = 0; k < b.count(); ++k) error = std::max(error, std::abs(u[k] - polynomial(b.position(k), order)));
  return error;
}

/// A rectangle with edges anywhere between two rows of nodes.
LatticeBody moved_edges() {
  auto nodes = box_body({6, 5}, 0).nodes;
  return lattice_body(2, nodes, 3, [](const LatticeBody::Index&, int axis, int side) {
    return axis == 0 ? (side < 0 ? 0.2 : 0.9) : (side < 0 ? 0.7 : 0.35);
  });
}

}  // namespace

TEST_CASE("extrapolation: exact for polynomials up to its order, at faces, edges and corners") {
  for (const auto& body : {box_body({7}, 3), box_body({6, 5}, 3), box_body({5, 4, 5}, 2), moved_edges()})
    for (const auto centre : {Centre::real_node, Centre::surface_node})
      for (int order = 0; order <= 3; ++order) CHECK(largest_error(body, centre, order) < 1e-11);  // measured: 1.1e-13
}

TEST_CASE("extrapolation: order 1 of a bar, by hand (Sca21 49, ScaDyn 4)") {
  const auto body = box_body({3}, 1);
  const Eigen::MatrixXd real = extrapolation(body, Centre::real_node, 1);
  const Eigen::MatrixXd surface = extrapolation(body, Centre::surface_node, 1);
  REQUIRE(body.nodes[3][0] == -1);
  CHECK((real.row(3) - Eigen::RowVector3d(2, -1, 0)).norm() < 1e-14);
  CHECK((surface.row(3) - Eigen::Matrix<double, 1, 5>(-1, 0, 0, 2, 0)).norm() < 1e-14);
  CHECK((Eigen::MatrixXd(surface_values(body, 1)).row(0) - Eigen::RowVector3d(1.5, -0.5, 0)).norm() < 1e-14);
}

TEST_CASE("extrapolation: beyond an edge only its column, on the diagonal of a corner the mean of both edges") {
  const auto body = box_body({4, 4}, 2);
  const WeightRows rows = extrapolation(body, Centre::surface_node, 1);
  const int beside = body.node({-2, 2, 0}), diagonal = body.node({-1, -1, 0});
  CHECK(Eigen::MatrixXd(rows.row(beside)).cwiseAbs().count() == 2);
  const Eigen::MatrixXd both = rows.row(diagonal);
  const int left = body.real + body.surface_node(0, 0, -1), bottom = body.real + body.surface_node(0, 1, -1);
  CHECK(both(0, left) == Approx(both(0, bottom)));
  CHECK(both.cwiseAbs().count() == 5);  // two surface nodes on each edge and the node of the corner
}

TEST_CASE("extrapolation: several unknowns of a node, each with its own order or all with the same") {
  const auto body = box_body({4, 3}, 2);
  const WeightRows first = extrapolation(body, Centre::surface_node, 1);
  const WeightRows second = extrapolation(body, Centre::surface_node, 2);
  const Eigen::MatrixXd by_node = Eigen::MatrixXd::Random(3, first.cols());  // unknowns x nodes
  const Eigen::MatrixXd same = (for_each_unknown(first, 3) * by_node.reshaped()).reshaped(3, body.count());
  CHECK((same - by_node * first.transpose()).norm() < 1e-13);
  const Eigen::MatrixXd own = (for_each_unknown({second, first, first}) * by_node.reshaped()).reshaped(3, body.count());
  CHECK((own.row(0) - by_node.row(0) * second.transpose()).norm() < 1e-13);
  CHECK((own.bottomRows(2) - same.bottomRows(2)).norm() < 1e-13);
  CHECK_THROWS_AS(for_each_unknown({first, extrapolation(body, Centre::real_node, 1)}), std::invalid_argument);
}

TEST_CASE("extrapolation: refuses an order that the body has too few nodes for") {
  const auto bar = box_body({3}, 2), rectangle = box_body({6, 3}, 2);
  CHECK_NOTHROW(extrapolation(bar, Centre::real_node, 2));
  CHECK_THROWS_AS(extrapolation(bar, Centre::real_node, 3), Refused);
  CHECK_THROWS_AS(surface_values(bar, 3), Refused);
  CHECK_NOTHROW(extrapolation(bar, Centre::surface_node, 3));
  CHECK_THROWS_AS(extrapolation(bar, Centre::surface_node, 4), Refused);
  CHECK_NOTHROW(extrapolation(rectangle, Centre::surface_node, 2));
  CHECK_THROWS_AS(extrapolation(rectangle, Centre::surface_node, 3), Refused);  // at its corners
}
