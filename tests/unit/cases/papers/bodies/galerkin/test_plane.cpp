#include "cases/papers/bodies/galerkin/plane.hpp"

#include "tests/catch.hpp"

namespace gs = galerkin_systems;

namespace {

const gs::Solid stiff_solid{100, 0.3};

/// Largest difference of gradients from difference quotients, and of body forces from the stress's divergence.
std::pair<double, double> mismatch(const gs::Field& field,
                                   const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& body_force) {
  constexpr double step = 1e-5;
  double gradient = 0, force = 0;
  for (const Eigen::Vector2d& x : {Eigen::Vector2d(0.3, 0.4), Eigen::Vector2d(1.7, 0.9), Eigen::Vector2d(1.1, 1.8)}) {
    Eigen::Vector2d divergence = body_force(x);
    for (const int d : {0, 1}) {
      const Eigen::Vector2d to = step * Eigen::Vector2d::Unit(d);
      const Eigen::Vector2d slope = (field.value(x + to) - field.value(x - to)) / (2 * step);
      gradient = std::max(gradient, (slope - field.gradient(x).col(d)).norm());
      const auto stress = [&](const Eigen::Vector2d& at) { return stiff_solid.stress(field.gradient(at)); };
      divergence += (stress(x + to) - stress(x - to)).col(d) / (2 * step);
    }
    force = std::max(force, divergence.norm());
  }
  return {gradient, force};
}

}  // namespace

TEST_CASE("Galerkin thesis, plane: gradients and body forces of the fields are those of their displacements") {
  const auto none = [](const Eigen::Vector2d&) { return Eigen::Vector2d(0, 0); };
  const auto quadratic = [](const Eigen::Vector2d&) { return gs::quadratic_body_force(stiff_solid); };
  const auto manufactured = [](const Eigen::Vector2d& x) { return gs::manufactured_body_force(stiff_solid, x); };
  for (const auto& [gradient, force] : {mismatch(gs::linear_field(), none), mismatch(gs::quadratic_field(), quadratic),
                                        mismatch(gs::manufactured_field(), manufactured)}) {
    CHECK(gradient < 1e-8);
    CHECK(force < 1e-5);  // of 66 to 1300
  }
  CHECK(mismatch(gs::manufactured_field(), none).second > 100);
}

TEST_CASE("Galerkin thesis, plane: norms are 0 of a linear field, and of a constant error its size") {
  const gs::Body b = gs::body({2, 2, 6, 6, 0.3});
  Eigen::VectorXd u(2 * b.points.cols());
  for (Eigen::Index k = 0; k < b.points.cols(); ++k) u.segment<2>(2 * k) = gs::linear_field().value(b.points.col(k));
  const auto exact = gs::field_norms(b, gs::moving(b), u, gs::linear_field());
  CHECK(std::max(exact.L2, exact.H1) < 1e-13);
  const auto off = gs::field_norms(b, gs::moving(b), u.array() + 0.5, gs::linear_field());
  CHECK(off.L2 == Approx(0.5 * std::sqrt(2.0) * 2));
  CHECK(off.H1 < 1e-12);
}

TEST_CASE("Galerkin thesis, plane: unsymmetric equations with given values are those of a dense factor") {
  const gs::Body b = gs::body({1, 1, 4, 4, 0.2, gs::Reach::two_cells});
  const gs::Sparse K =
      gs::petrov_stiffness(gs::law(stiff_solid), b, gs::moving(b), gs::linear_static(b), gs::Petrov::first);
  CHECK((K - gs::Sparse(K.transpose())).norm() > 1e-2 * K.norm());
  Eigen::VectorXd prescribed = gs::nothing_prescribed(K.rows());
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < K.rows(); ++i)
    if (b.points(0, i / 2) == 0)
      prescribed[i] = double(i);
    else
      free.push_back(i);
  const Eigen::VectorXd f = Eigen::VectorXd::LinSpaced(K.rows(), -1, 1);
  const Eigen::VectorXd u = gs::solved_by_lu(K, f, prescribed);
  Eigen::VectorXd held = prescribed;
  for (const Eigen::Index i : free) held[i] = 0;
  const Eigen::MatrixXd dense = K;
  const Eigen::VectorXd rest = (f - dense * held)(free);
  const Eigen::VectorXd inner = Eigen::MatrixXd(dense(free, free)).partialPivLu().solve(rest);
  held(free) = inner;
  CHECK((u - held).norm() < 1e-10 * held.norm());
}
