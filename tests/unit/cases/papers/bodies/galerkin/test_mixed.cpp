#include "cases/papers/bodies/galerkin/mixed.hpp"

#include "tests/catch.hpp"

namespace gs = galerkin_systems;

TEST_CASE("Galerkin thesis, mixed: solutions with pressures are those of the condensed stiffness") {
  const gs::Solid solid{1, 0.49};
  const gs::Body b = gs::body({1, 1, 4, 4, 0.2});
  for (const char* name : {"VC Unl", "VC UnlP0", "VC Unl+P1C"}) {
    const auto blocks = gs::blocks(solid, b, gs::basis(name));
    Eigen::VectorXd load = Eigen::VectorXd::LinSpaced(blocks.points, 0, 1), held = gs::nothing_prescribed(load.size());
    for (Eigen::Index i = 0; i < held.size(); ++i)
      if (b.points(0, i / 2) == 0) held[i] = 0;
    const auto whole = gs::solution(solid, blocks, load, held).u;
    const auto own = gs::solved(gs::condensed(solid, blocks), load, held);
    CAPTURE(name);
    CHECK((whole - own).norm() < 1e-9 * own.norm());
  }
  const auto plain = gs::blocks(solid, b, gs::basis("VC Unl"));
  const auto sum = gs::plane_stiffness(solid, b, gs::basis("VC Unl").system(b));
  CHECK((gs::condensed(solid, plain) - sum).norm() < 1e-13 * sum.norm());
}

TEST_CASE("Galerkin thesis, mixed: inf-sup values without a field of pressure are those of one pressure per sample") {
  // U1 has one sample per family: its divergence there is a constant pressure
  const gs::Basis with_field{"U1P0", gs::Reach::cells, gs::linear_static, gs::Pressure::constant};
  for (const double perturbation : {0.0, 0.3}) {
    const auto field = gs::inf_sup(with_field, gs::Reach::cells, 4, perturbation);
    const auto none = gs::inf_sup(gs::basis("U1"), gs::Reach::cells, 4, perturbation);
    CHECK(none.value == Approx(field.value).epsilon(1e-6));
  }
}

TEST_CASE("Galerkin thesis, mixed: an unknown basis is told") {
  CHECK_THROWS_AS(gs::basis("U3"), std::out_of_range);
}
