#include "tests/unit/plate/galerkin_plate.hpp"

#include <random>

#include "plate/galerkin/stiffness.hpp"

namespace galerkin_plate {

geometry::Tessellation cells(const geometry::Outline& outline, double spacing,
                             const std::vector<geometry::Polyline>& cracks, const geometry::Grading& grading) {
  return geometry::tessellation(outline, geometry::crack_paths(outline, cracks, 1e-9), spacing, {}, grading);
}

geometry::Tessellation perturbed(geometry::Tessellation cells, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-share, share);
  std::vector<char> fixed(cells.positions.size(), 0);
  for (const auto& border : cells.borders) fixed[border.from] = fixed[border.to] = 1;
  for (std::size_t k = 0; k < fixed.size(); ++k)
    if (!fixed[k]) geometry::move(cells, k, cells.units.spacing * geometry::Point(uniform(random), uniform(random)));
  for (const auto& [a, b, c, d] : cells.squares) {
    cells.triangles.push_back({a, b, c});
    cells.triangles.push_back({a, c, d});
  }
  cells.squares.clear();
  return cells;
}

geometry::Outline with_hole() {
  auto outline = geometry::rectangle(0, 0, 1.2, 0.8);
  outline.holes.push_back(geometry::Circle{{0.63, 0.42}, 0.17, "hole0"});
  return outline;
}

plate::GalerkinFamilies families(const geometry::Tessellation& cells) {
  return cells.squares.empty() ? plate::moved_galerkin_families(cells) : plate::galerkin_families(cells);
}

std::vector<geometry::Tessellation> scenes() {
  const auto plain = geometry::rectangle(0, 0, 1.2, 0.8);
  return {cells(plain, 0.1),
          perturbed(cells(plain, 0.1), 0.3),
          cells(with_hole(), 0.1),
          cells(plain, 0.1, {{{0.3, 0.4}, {0.8, 0.4}}}),
          cells(plain, 0.1, {{{0, 0.13}, {0.5, 0.41}, {0.9, 0.4}}, {{0.6, 0.41}, {0.7, 0.7}}}),
          perturbed(cells(with_hole(), 0.1, {{{0.8, 0.42}, {1.0, 0.42}}}), 0.1),
          cells(with_hole(), 0.1, {{{0.8, 0.42}, {1.0, 0.42}}}, {0.03, 0.05, 0.3})};
}

plate::State random_state(std::size_t points, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return plate::State::NullaryExpr(3, Eigen::Index(points), [&] { return uniform(random); });
}

plate::State bent(const geometry::Tessellation& cells, double kx, double ky, double kxy) {
  plate::State u(3, Eigen::Index(cells.positions.size()));
  for (Eigen::Index k = 0; k < u.cols(); ++k) {
    const auto& x = cells.positions[std::size_t(k)];
    const double psi_x = kx * x.x() + kxy * x.y(), psi_y = ky * x.y() + kxy * x.x();
    u.col(k) << (kx * x.x() * x.x() + ky * x.y() * x.y()) / 2 + kxy * x.x() * x.y(), psi_y, -psi_x;
  }
  return u;
}

Eigen::MatrixXd stiffness(const plate::GalerkinFamilies& families, const plate::Section& s) {
  const auto points = Eigen::Index(families.areas.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * points, 3 * points);
  for (std::size_t k = 0; k < families.areas.size(); ++k) {
    const auto own = plate::family_stiffness(families, s, k);
    std::vector<Eigen::Index> dof;
    for (Eigen::Index c = 0; c < 3; ++c) dof.push_back(Eigen::Index(3 * k) + c);
    for (const auto& bond : families.families[k])
      for (Eigen::Index c = 0; c < 3; ++c) dof.push_back(Eigen::Index(3 * bond.neighbour) + c);
    K(dof, dof) += own;
  }
  return K;
}

}  // namespace galerkin_plate
