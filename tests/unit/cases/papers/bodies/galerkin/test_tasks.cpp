#include "cases/papers/bodies/galerkin/tasks.hpp"

#include "tests/catch.hpp"

namespace gs = galerkin_systems;

namespace {

const gs::Solid pulled_solid{100, 0.3};

gs::Sparse unl_stiffness(const gs::Body& b) {
  return gs::condensed(pulled_solid, gs::blocks(pulled_solid, b, gs::basis("VC Unl")));
}

}  // namespace

TEST_CASE("Galerkin thesis, tasks: the infinite plate with a hole is in equilibrium, free at the hole, of its stress") {
  constexpr double step = 1e-5;
  for (const double angle : {0.1, 0.8, 1.4}) {
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    CHECK((gs::hole_stress(ray) * ray).norm() < 1e-14);
    CHECK((gs::hole_stress(1e6 * ray) - Eigen::Matrix2d{{1, 0}, {0, 0}}).norm() < 1e-11);
    const Eigen::Vector2d x = 1.7 * ray;
    Eigen::Vector2d divergence(0, 0);
    Eigen::Matrix2d H;
    for (const int d : {0, 1}) {
      const Eigen::Vector2d to = step * Eigen::Vector2d::Unit(d);
      divergence += (gs::hole_stress(x + to) - gs::hole_stress(x - to)).col(d) / (2 * step);
      H.col(d) =
          (gs::hole_displacement(pulled_solid, x + to) - gs::hole_displacement(pulled_solid, x - to)) / (2 * step);
    }
    CHECK(divergence.norm() < 1e-8);
    CHECK((pulled_solid.stress(H) - gs::hole_stress(x)).norm() < 1e-8);
  }
  CHECK(gs::hole_stress({0, 1})(0, 0) == Approx(3));
}

TEST_CASE("Galerkin thesis, tasks: the quarter with a hole has its area, its forces and a half of elements") {
  const auto task = gs::plate_with_hole();
  const auto points = gs::placed(task, {16, 16}, gs::Reach::cells);
  CHECK(points.body.areas.sum() == Approx(16 - std::acos(-1) / 4).epsilon(1e-3));  // chords for arcs
  const auto f = gs::loads(task, points);
  Eigen::Vector2d sum(0, 0);
  for (Eigen::Index k = 0; k < points.places.cols(); ++k) sum += f.segment<2>(2 * k);
  double across = 0;  // what the other quarter pulls with, sigma_xx at x = 0, and sigma_yy at y = 0
  for (int i = 0; i < 3000; ++i) across += gs::hole_stress({0, 1 + (i + 0.5) / 1000})(0, 0) / 1000;
  CHECK(sum.x() == Approx(across).epsilon(5e-3));
  CHECK(std::ranges::count_if(points.body.cells, [&](const auto& cell) {
          return gs::beyond_hole(points.body.points(Eigen::all, cell).rowwise().mean());
        }) == 128);
}

TEST_CASE("Galerkin thesis, tasks: families beside elements hold rigid motions, and their sum is symmetric") {
  const gs::Body whole = gs::body({2, 1, 8, 4, 0.3});
  const gs::Sparse K = gs::coupled(
      pulled_solid, whole, [](const auto& x) { return x.x() < 1; }, unl_stiffness);
  Eigen::VectorXd rigid(K.rows());
  for (Eigen::Index k = 0; k < whole.points.cols(); ++k)
    rigid.segment<2>(2 * k) << 1 - whole.points(1, k), 2 + whole.points(0, k);
  CHECK((K * rigid).norm() < 1e-12 * K.norm());
  CHECK((K - gs::Sparse(K.transpose())).norm() < 1e-13 * K.norm());
  const gs::Sparse alone = unl_stiffness(whole);
  CHECK((K - alone).norm() > 0.1 * K.norm());
}
