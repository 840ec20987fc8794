#include "plate/edges/oblique_edges.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

namespace {

/// Points of the lattice within a circle about (0.2, 0.1), nodes on it.
struct Disc {
  explicit Disc(double radius) {
    std::vector<LatticeBody::Index> places;
    for (int y = -20; y <= 20; ++y)
      for (int x = -20; x <= 20; ++x)
        if ((Point(x, y) - centre).norm() < radius) places.push_back({x, y, 0});
    body = lattice_body(2, places, 3);
    for (int i = 0; i < 30; ++i) {
      const double angle = 0.05 + i * 3.141592653589793 / 15;
      const Point out(std::cos(angle), std::sin(angle));
      nodes.push_back({centre + radius * out, out, 3.141592653589793 / 15 * radius});
    }
  }
  Point centre{0.2, 0.1};
  LatticeBody body;
  std::vector<EdgeNode> nodes;
};
const Sees all = [](const Point&, const Point&) { return true; };

double w(const Point& x) {
  return 1 + x.x() - 2 * x.y() + 3 * x.x() * x.x() - x.x() * x.y() + 0.5 * x.y() * x.y();
}
double theta(const Point& x) {
  return 2 - x.x() + 3 * x.y();
}

}  // namespace

TEST_CASE("oblique expansion: deflections of second and rotations of first order are exact beyond the edges") {
  const Disc disc(5);
  const auto edges = oblique_edges(disc.body, disc.nodes, all);
  Eigen::VectorXd known(3 * (disc.body.real + 30));
  for (int k = 0; k < disc.body.real + 30; ++k) {
    const Point x =
        k < disc.body.real ? Point(disc.body.position(k).head<2>()) : disc.nodes[std::size_t(k - disc.body.real)].at;
    known.segment<3>(3 * k) << w(x), theta(x), -theta(x);
  }
  const Eigen::VectorXd values = oblique_expansion(disc.body, edges) * known;
  double off = 0;
  for (int k = 0; k < disc.body.count(); ++k) {
    const Point x = disc.body.position(k).head<2>();
    off = std::max(off, (values.segment<3>(3 * k) - Eigen::Vector3d(w(x), theta(x), -theta(x))).cwiseAbs().maxCoeff());
  }
  CHECK(off < 1e-11);  // measured: below 1e-12
}

TEST_CASE("oblique expansion: what is not seen is not used, and too little of it is refused") {
  const Disc disc(5);
  const Sees above = [](const Point& from, const Point& to) { return to.y() > 0 || from.y() < 3; };
  const auto edges = oblique_edges(disc.body, disc.nodes, above);
  for (std::size_t s = 0; s < disc.nodes.size(); ++s)
    if (disc.nodes[s].at.y() >= 3)
      for (const int k : edges.deflection[s].nodes)
        if (k < disc.body.real) CHECK(disc.body.position(k).y() > 0);
  CHECK_THROWS_AS(oblique_edges(disc.body, disc.nodes, [](const Point&, const Point&) { return false; }), Refused);
}

TEST_CASE("oblique expansion: nearest values are those of the nearest real node, or the mean of several") {
  const auto body = lattice_body(2, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 2);
  const WeightRows rows = nearest_values(body);
  CHECK(rows.coeff(body.node({3, 0, 0}), body.node({1, 0, 0})) == 1);
  CHECK(rows.coeff(body.node({1, 1, 0}), body.node({1, 0, 0})) == 0.5);
  CHECK(rows.coeff(body.node({1, 1, 0}), body.node({0, 1, 0})) == 0.5);
  CHECK((Eigen::VectorXd(rows * Eigen::Vector3d(1, 1, 1)) - Eigen::VectorXd::Ones(rows.rows())).norm() < 1e-15);
}
