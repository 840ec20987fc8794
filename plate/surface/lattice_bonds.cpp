#include "plate/surface/lattice_bonds.hpp"

#include "plate/bonds/parameters/horizon_parameters.hpp"
#include "plate/bonds/parameters/influence.hpp"

namespace plate {

LatticeBonds lattice_bonds(const Section& section, const Discretization& d, const std::vector<CellShare>& family) {
  const double area = d.spacing * d.spacing;
  FamilySums sums;
  std::vector<BondShape> shapes;
  for (const auto& [away, share] : family) {
    const Eigen::Array2d xi = d.spacing * away.head<2>().cast<double>();
    const double length = xi.matrix().norm();
    shapes.push_back({xi[1] / length, -xi[0] / length, length,
                      influence(d.influence, length, d.horizon()) * share * section.thickness});
    add(sums, shapes.back(), share, section.thickness, area);
  }
  const PointParameters p = arbitrary_horizon(section, d.twist_match, sums, sums.twist);
  LatticeBonds result{{}, 2 * area * p.a, d.spacing, 0};
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto& [mx, my, length, weight] = shapes[i];
    const double weighted = weight * area;  // omega A
    result.bonds.push_back(
        {family[i].away, mx, my, length, p.d * weighted, 4 * area * p.b * weighted, area * p.C * weighted});
    result.reach = std::max(result.reach, family[i].away.abs().maxCoeff());
  }
  return result;
}

LatticeBonds lattice_bonds(const Section& section, const Discretization& d) {
  std::vector<CellShare> family;
  for (const auto& xi : full_family(d))
    family.push_back(
        {{int(std::lround(xi.x() / d.spacing)), int(std::lround(xi.y() / d.spacing)), 0}, volume_share(d, xi)});
  return lattice_bonds(section, d, family);
}

}  // namespace plate
