#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
namespace gp = galerkin_plate;

TEST_CASE("the families of the Galerkin plate obey Gauss's theorem for constants and linear functions") {
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    const auto residuals = consistency_residuals(families, cells);
    CHECK(residuals.first < 1e-13);   // measured: 5e-16
    CHECK(residuals.second < 1e-13);  // measured: 1e-15
  }
}

TEST_CASE("their gradients are exact for linear functions") {
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    for (std::size_t k = 0; k < families.areas.size(); ++k) {
      Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
      const auto family = families.families[k];
      for (std::size_t i = 0; i < family.size(); ++i)
        sum += families.families.vectors()[family[i].vector_id] * families.of(k)[i].gradient.transpose();
      const double off = (sum - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff();
      CHECK(off < 1e-13);
    }
  }
}

TEST_CASE("inside the lattice the gradients are a third from the axes and a twelfth from the diagonals") {
  const auto families = galerkin_families(gp::cells(geometry::rectangle(0, 0, 1, 1), 0.1));
  const std::size_t middle = 5 * 11 + 5;
  REQUIRE(families.kind[middle] == 0);
  CHECK(families.areas[middle] == Approx(0.01));
  const auto family = families.families[middle];
  REQUIRE(family.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) {
    const geometry::Point x = families.families.vectors()[family[i].vector_id] / 0.1;
    const bool axis = std::abs(x.norm() - 1) < 1e-9;
    const geometry::Point wanted = x / 0.1 * (axis ? 1.0 / 3 : 1.0 / 12);
    CHECK((families.of(middle)[i].gradient - wanted).norm() < 1e-12);
    CHECK(families.of(middle)[i].share == Approx(0.01 / 8));
  }
}

TEST_CASE("areas and shares of bonds add up to the plate") {
  for (const auto& cells : gp::scenes()) {
    const auto families = gp::families(cells);
    double area = 0, shares = 0, around = 0;
    for (std::size_t k = 0; k < families.areas.size(); ++k) {
      area += families.areas[k];
      for (std::size_t i = 0; i < families.families[k].size(); ++i) shares += families.of(k)[i].share;
    }
    for (const auto& border : cells.borders) {
      const auto &a = cells.positions[border.from], &b = cells.positions[border.to];
      around += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    CHECK(area == Approx(around).epsilon(1e-12));
    CHECK(shares == Approx(area).epsilon(1e-12));
  }
}
