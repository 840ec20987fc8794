#include "plate/galerkin/families.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/cells/cells_part.hpp"

namespace plate {
namespace {

using geometry::Point;
using geometry::Tessellation;

/// Area times the gradients of the three hat functions of a triangle.
std::array<Point, 3> area_gradients(const std::array<Point, 3>& x) {
  std::array<Point, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point side = x[(i + 2) % 3] - x[(i + 1) % 3];
    result[i] = Point(-side.y(), side.x()) / 2;
  }
  return result;
}

std::array<Point, 3> corners(const Tessellation& cells, const Tessellation::Triangle& at) {
  return {cells.local[at[0]], cells.local[at[1]], cells.local[at[2]]};
}

/// Area of a triangle, by the gradients of its corners.
double area_by(const std::array<Point, 3>& gradients, const Tessellation& cells, const Tessellation::Triangle& at) {
  return gradients[2].dot(cells.local[at[2]] - cells.local[at[0]]);
}

/// Calls visit(triangle, share) for the triangles and for the halves of squares along both diagonals, of which each
/// counts half.
template <typename Visit>
void for_triangles(const Tessellation& cells, const Visit& visit) {
  for (const auto& [a, b, c, d] : cells.squares)
    for (const auto& triangle : {Tessellation::Triangle{a, b, c}, {a, c, d}, {a, b, d}, {b, c, d}})
      visit(triangle, 0.5);
  for (const auto& triangle : cells.triangles) visit(triangle, 1.0);
}

/// Points with four squares about them.
std::vector<char> inside_lattice(const Tessellation& cells) {
  std::vector<char> squares(cells.local.size(), 0);
  for (const auto& square : cells.squares)
    for (const auto k : square) ++squares[k];
  for (char& count : squares) count = count == 4;
  return squares;
}

/// Kind 0 for points inside the lattice whose neighbours are there too, a kind of its own for any other.
void number_kinds(GalerkinFamilies& result, const std::vector<char>& inside) {
  std::uint32_t count = 1;
  std::size_t regular_bonds = 0;
  for (std::size_t k = 0; k < inside.size(); ++k) {
    bool regular = inside[k];
    for (const auto& bond : result.families[k]) regular = regular && inside[bond.neighbour];
    result.kind.push_back(regular ? 0 : count++);
    if (regular) regular_bonds = result.families[k].size();
  }
  result.first = {0, regular_bonds};
  for (std::size_t k = 0; k < inside.size(); ++k)
    if (result.kind[k] > 0) result.first.push_back(result.first.back() + result.families[k].size());
  result.bonds.assign(result.first.back(), {Point(0, 0), 0});
}

/// Sets the squares of the spacing: twice the mean area of the triangles about each point, as on a lattice of the
/// spacing there.
void find_squares(GalerkinFamilies& result, const Tessellation& cells) {
  std::vector<double> count(cells.local.size(), 0);
  for (const auto& triangle : cells.triangles)
    for (const auto k : triangle) ++count[k];
  for (std::size_t k = 0; k < count.size(); ++k) result.own_square.push_back(6 * result.areas[k] / count[k]);
}

GalerkinFamilies weighted(geometry::Families families, const Tessellation& cells, const std::vector<char>& inside) {
  GalerkinFamilies result;
  result.families = std::move(families);
  const auto points = cells.local.size();
  number_kinds(result, inside);
  constexpr auto none = std::uint32_t(-1);
  std::uint32_t example = none;  // of kind 0
  for (std::uint32_t k = 0; k < points && example == none; ++k)
    if (result.kind[k] == 0) example = k;

  result.areas.assign(points, 0);
  result.spacing_square = cells.units.spacing * cells.units.spacing;
  for_triangles(cells, [&](const Tessellation::Triangle& triangle, double share) {
    const auto gradients = area_gradients(corners(cells, triangle));
    const double area = area_by(gradients, cells, triangle);
    for (const auto k : triangle) {
      result.areas[k] += share * area / 3;
      if (result.kind[k] == 0 && k != example) continue;
      auto* const bonds = result.bonds.data() + result.first[result.kind[k]];
      for (std::size_t i = 0; i < 3; ++i)
        if (triangle[i] != k) bonds[result.families[k].find(triangle[i])].gradient += share / 3 * gradients[i];
    }
  });
  for (std::uint32_t k = 0; k < points; ++k) {
    if (result.kind[k] == 0 && k != example) continue;
    auto* const bonds = result.bonds.data() + result.first[result.kind[k]];
    const auto family = result.families[k];
    double around = 0;
    for (const auto& bond : family) around += result.areas[bond.neighbour];
    for (std::size_t i = 0; i < family.size(); ++i) {
      bonds[i].gradient /= result.areas[k];
      bonds[i].share = result.areas[k] * result.areas[family[i].neighbour] / around;
    }
  }
  if (cells.graded) find_squares(result, cells);
  return result;
}

/// The first point with squares all about it and its neighbours, and the families about it.
std::optional<std::pair<GalerkinFamilies, std::uint32_t>> first_of_lattice(const Tessellation& whole) {
  const auto inside = inside_lattice(whole);
  std::vector<char> beside(inside.size(), 0), wanted(inside.size(), 0);
  for (const auto& square : whole.squares)
    if (!std::ranges::all_of(square, [&](auto k) { return inside[k] != 0; }))
      for (const auto k : square) beside[k] = 1;
  std::uint32_t first = 0;
  while (first < inside.size() && (!inside[first] || beside[first])) ++first;
  if (first == inside.size()) return std::nullopt;
  wanted[first] = 1;
  const auto about = geometry::cells_about(whole, std::move(wanted));
  const auto place = std::ranges::find(about.number, first) - about.number.begin();
  return std::pair(galerkin_families(about.cells), std::uint32_t(place));
}

}  // namespace

GalerkinFamilies galerkin_families(const Tessellation& cells, const Tessellation& whole) {
  auto result = galerkin_families(cells);
  auto found = first_of_lattice(whole);
  if (!found) return result;
  result.of_all = std::make_shared<const GalerkinFamilies>(std::move(found->first)),
  result.point_of_all = found->second;
  if (std::ranges::find(result.kind, 0u) != result.kind.end())
    std::copy_n(result.of_all->of(result.point_of_all), result.first[1], result.bonds.begin());
  return result;
}

std::optional<LatticeFamily> lattice_family(const GalerkinFamilies& families) {
  if (families.of_all) return LatticeFamily{families.of_all.get(), families.point_of_all};
  const auto first = std::ranges::find(families.kind, 0u);
  if (first == families.kind.end()) return std::nullopt;
  return LatticeFamily{&families, std::uint32_t(first - families.kind.begin())};
}

std::vector<double> areas_of(const Tessellation& cells) {
  std::vector<double> result(cells.local.size(), 0);
  for_triangles(cells, [&](const Tessellation::Triangle& triangle, double share) {
    const double area = area_by(area_gradients(corners(cells, triangle)), cells, triangle);
    for (const auto k : triangle) result[k] += share * area / 3;
  });
  return result;
}

GalerkinFamilies galerkin_families(const Tessellation& cells) {
  return weighted(geometry::cell_families(cells), cells, inside_lattice(cells));
}

GalerkinFamilies moved_galerkin_families(const Tessellation& cells) {
  return weighted(geometry::exact_cell_families(cells), cells, std::vector<char>(cells.local.size(), 0));
}

ConsistencyResiduals consistency_residuals(const GalerkinFamilies& families, const Tessellation& cells,
                                           const std::vector<char>& own) {
  const auto points = Eigen::Index(cells.local.size());
  Eigen::Matrix2Xd first = Eigen::Matrix2Xd::Zero(2, points);
  Eigen::Matrix4Xd second = Eigen::Matrix4Xd::Zero(4, points);
  const auto tensor = [](const Point& a, const Point& b) {
    return Eigen::Vector4d(a.x() * b.x(), a.x() * b.y(), a.y() * b.x(), a.y() * b.y());
  };
  for (std::size_t k = 0; k < cells.local.size(); ++k) {
    const auto family = families.families[k];
    const auto* bonds = families.of(k);
    const double area = families.areas[k];
    for (std::size_t i = 0; i < family.size(); ++i) {
      const auto [member, vector] = family[i];
      first.col(member) += area * bonds[i].gradient;
      first.col(Eigen::Index(k)) -= area * bonds[i].gradient;
      second.col(member) -= area * tensor(families.families.vectors()[vector], bonds[i].gradient);  // X_k - x_i
    }
    second.col(Eigen::Index(k)) += area * Eigen::Vector4d(1, 0, 0, 1);
  }
  for (const auto& border : cells.borders) {
    const Point along = cells.local[border.to] - cells.local[border.from], normal(along.y(), -along.x());
    first.col(border.from) -= normal / 2, first.col(border.to) -= normal / 2;
    second.col(border.from) -= tensor(along / 6, normal), second.col(border.to) -= tensor(-along / 6, normal);
  }
  for (std::size_t k = 0; k < own.size(); ++k)
    if (!own[k]) first.col(Eigen::Index(k)).setZero(), second.col(Eigen::Index(k)).setZero();
  const double h = cells.units.spacing;
  return {first.cwiseAbs().maxCoeff() / h, second.cwiseAbs().maxCoeff() / (h * h)};
}

namespace {

/// Stiffness against equal curvatures over that against opposite ones, at most 1: (1 + nu) / (1 - nu) where nu < 0.
/// There the residuals of bonds, which are mostly of the second kind, would hide a field that is mostly of the first.
double softness(const Eigen::Matrix3d& bending) {
  const double sum = bending(0, 0) + bending(1, 1), mixed = 2 * bending(0, 1);
  return std::min(1.0, (sum + mixed) / (sum - mixed));
}

}  // namespace

namespace {

/// Square of the thickness that the shear scaling goes by: the plate's own, or, where shear is softer beside bending
/// than in an isotropic plate with k_s = 5/6, that of an isotropic plate with this ratio (D_min / S_max = h^2 / 5).
double square_of_thickness(const LocalSection& section) {
  constexpr double ratio = 4.8;  // not quite 5: isotropic plates keep their own
  const double own = section.thickness * section.thickness;
  const double shear = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(section.shear).eigenvalues().maxCoeff();
  if (!(shear > 0)) return own;
  const Eigen::Vector3d kelvin(1, 1, std::numbers::sqrt2);
  const Eigen::Matrix3d bending = kelvin.asDiagonal() * section.bending * kelvin.asDiagonal();
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(bending).eigenvalues().minCoeff();
  return std::max(own, ratio * least / shear);
}

}  // namespace

// t_b = 0.5, f = h^2 / (h^2 + 0.05 spacing^2), t_s = 1, e = h^2 / (h^2 + spacing^2)
GalerkinStiffness::GalerkinStiffness(const LocalSection& section, double spacing_square)
    : bending(section.bending), bending_residual(softness(section.bending) * 0.5) {
  const double square = square_of_thickness(section);
  shear = square / (square + 0.05 * spacing_square) * section.shear;
  shear_residual = square / (square + spacing_square) * section.shear;
}

FamilyStrains family_strains(const GalerkinFamilies& families, std::size_t k, const State& state) {
  FamilyStrains result;
  const auto family = families.families[k];
  const auto* bonds = families.of(k);
  const Point own = psi_of(state, k);
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto [j, vector] = family[i];
    result.psi += (psi_of(state, j) - own) * bonds[i].gradient.transpose();
    result.gamma += bonds[i].gradient * bond_shear(state, k, j, families.families.vectors()[vector]);
  }
  return result;
}

double family_energy(const GalerkinFamilies& families, const LocalSection& section, std::size_t k, const State& state) {
  const GalerkinStiffness stiffness(section, families.square(k));
  const FamilyStrains strains = family_strains(families, k, state);
  const Eigen::Vector3d kappa(strains.psi(0, 0), strains.psi(1, 1), strains.psi(0, 1) + strains.psi(1, 0));
  double energy = families.areas[k] / 2 *
                  (kappa.dot(stiffness.bending * kappa) + strains.gamma.dot(stiffness.shear * strains.gamma));
  const auto family = families.families[k];
  const auto* bonds = families.of(k);
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto [j, vector] = family[i];
    const Point& x = families.families.vectors()[vector];
    const double length = x.norm();
    const Point n = x / length, r = (psi_of(state, j) - psi_of(state, k)) / length - strains.psi * n;
    const double rho = bond_shear(state, k, j, x) / length - n.dot(strains.gamma);
    energy += bonds[i].share / 2 *
              (stiffness.bending_residual * r.dot(along(stiffness.bending, n) * r) +
               n.dot(stiffness.shear_residual * n) * rho * rho);
  }
  return energy;
}

}  // namespace plate
