// Bodies whose left half is four-noded elements and whose right half is families; the interface's nodes are both's.

#include "cases/papers/bodies/galerkin/tasks.hpp"
#include "tests/catch.hpp"

namespace gs = galerkin_systems;

namespace {

constexpr double rounding = 1e-12;

gs::Norms patch(const char* name) {
  const gs::Solid solid{100, 0.3};
  const gs::Body whole = gs::body({2, 2, 10, 10, 0.3, gs::basis(name).reach});
  const auto own = [&](const gs::Body& b) { return gs::condensed(solid, gs::blocks(solid, b, gs::basis(name))); };
  return gs::patch_norms(solid, whole,
                         gs::coupled(
                             solid, whole, [](const auto& x) { return x.x() < 1; }, own),
                         whole.normals, gs::linear_field(), {0, 0});
}

}  // namespace

TEST_CASE("coupling with elements: halves have opposite normals at the interface, and the whole's area") {
  const gs::Body whole = gs::body({2, 2, 10, 10, 0.3});
  Eigen::Matrix2Xd normals = Eigen::Matrix2Xd::Zero(2, whole.points.cols());
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(whole.points.cols());
  for (const bool left : {true, false}) {
    const auto half = gs::part(whole, [=](const Eigen::Vector2d& x) { return (x.x() < 1) == left; });
    for (std::size_t k = 0; k < half.names.size(); ++k) {
      normals.col(half.names[k]) += half.body.normals.col(Eigen::Index(k));
      areas[half.names[k]] += half.body.areas[Eigen::Index(k)];
    }
  }
  CHECK((normals - whole.normals).norm() < rounding);
  CHECK((areas - whole.areas).norm() < rounding);
}

TEST_CASE(
    "coupling with elements: the linear patch crosses the interface where families are variationally consistent") {
  for (const char* name : {"VC U1", "VC U1SUnl", "VC Unl", "PG-CA", "VC UnlP0", "VC Unl+P1C"}) {
    const auto [L2, H1] = patch(name);
    CAPTURE(name, L2, H1);
    CHECK(std::max(L2, H1) < rounding);  // measured: 6e-15
  }
  for (const char* name : {"U1", "Unl", "UnlP0"}) {
    const auto [L2, H1] = patch(name);
    CAPTURE(name, L2, H1);
    CHECK(L2 > 0.02);  // measured: 0.166, 0.025, 0.032
    CHECK(H1 > 0.1);   // measured: 0.34, 0.11, 0.13
  }
}

TEST_CASE("coupling with elements: a cantilever, elements at its support, converges like its parts") {
  const gs::Solid solid{1000, 0.3};
  const auto task = gs::cantilever();
  const auto exact = gs::quadratic_elements(solid, task, {64, 16});
  const auto error = [&](const char* name, const gs::Grid& grid, bool both) {
    const auto points = gs::placed(task, grid, gs::basis(name).reach);
    const auto own = [&](const gs::Body& b) { return gs::condensed(solid, gs::blocks(solid, b, gs::basis(name))); };
    const auto K = both ? gs::coupled(
                              solid, points.body, [](const auto& x) { return x.x() < 4; }, own)
                        : own(points.body);
    const auto u = gs::solved(K, gs::loads(task, points), gs::supports(task, points));
    return 100 * (u[u.size() - 1] / exact.watched - 1);
  };
  const gs::Grid coarse{16, 4}, fine{32, 8};
  CHECK(std::abs(error("PG-CA", coarse, true)) < 3.5);     // measured: -2.91 %; elements -4.24, PG-CA alone 4.48
  CHECK(std::abs(error("PG-CA", fine, true)) < 1);         // measured: -0.85; elements -1.24, PG-CA 1.30
  CHECK(std::abs(error("VC Unl", coarse, true)) < 0.3);    // measured: -0.15, errors of both signs cancel
  CHECK(std::abs(error("VC Unl", fine, true)) < 0.1);      // measured: 0.05
  CHECK(std::abs(error("VC Unl", fine, false)) > 5);       // measured: 7.6, soft at the support
  CHECK(std::abs(error("VC Unl+P1C", fine, true)) < 0.5);  // measured: 0.38
  CHECK(std::abs(error("VC Unl+P1C", fine, false)) > 8);   // measured: 10.1
}
