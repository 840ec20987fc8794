// The plane formulations in a line each.
#include <stdexcept>

#include "tests/verification/galerkin/mixed.hpp"

namespace galerkin_systems {
namespace {

System corrected_unl(const Body& b) {
  return variationally_consistent(b, moving(b));
}
System corrected_u1(const Body& b) {
  return variationally_consistent(b, linear_static(b));
}

/// Correction V4; no factors on the surface, where V4 cannot give the normals of an uneven edge.
System corrected_u2(const Body& b) {
  return variationally_consistent(b, quadratic_static(b), quadratic_correction, Normals::found);
}

System averages_with_residuals(const Body& b) {
  return central_average(b) + bond_residuals(b, central_average(b), 0.5, 1);
}

}  // namespace

const std::vector<Basis>& bases() {
  const auto moved = [](const Body& b) { return moving(b); };
  static const std::vector<Basis> table{
      {"U1", Reach::cells, linear_static},
      {"VC U1", Reach::cells, corrected_u1},
      {"VC U1SUnl", Reach::cells, [](const Body& b) { return 0.5 * corrected_u1(b) + 0.5 * corrected_unl(b); }},
      {"VC U1SIG", Reach::cells, [](const Body& b) { return corrected_u1(b) + implicit_gradients(b); }},
      {"Unl", Reach::cells, moved},
      {"VC Unl", Reach::cells, corrected_unl},
      {"U2", Reach::two_cells, quadratic_static},
      {"VC U2", Reach::two_cells, corrected_u2, Pressure::displacement, false, Normals::found},
      {"CA, masters only", Reach::cells, central_average},
      {"PG-CA", Reach::cells, averages_with_residuals},
      {"PG-CA, residuals isochoric", Reach::cells, averages_with_residuals, Pressure::masters},
      {"UnlP0", Reach::cells, moved, Pressure::constant},
      {"VC UnlP0", Reach::cells, corrected_unl, Pressure::constant},
      {"U2P1", Reach::two_cells, quadratic_static, Pressure::linear},
      {"VC U2P1", Reach::two_cells, corrected_u2, Pressure::linear, false, Normals::found},
      {"U2P1C", Reach::two_cells, quadratic_static, Pressure::continuous},
      {"VC U2P1C", Reach::two_cells, corrected_u2, Pressure::continuous, false, Normals::found},
      {"Unl+P1C", Reach::cells, moved, Pressure::continuous, true},
      {"VC Unl+P1C", Reach::cells, corrected_unl, Pressure::continuous, true},
      {"VC UnlP1C, no bubble", Reach::cells, corrected_unl, Pressure::continuous},
  };
  return table;
}

const Basis& basis(const std::string& name) {
  for (const Basis& each : bases())
    if (each.name == name) return each;
  throw std::out_of_range("no basis " + name);
}

Eigen::Matrix2Xd load_normals(const Body& b, const Basis& basis) {
  return basis.normals == Normals::found ? nodal_normals(b, basis.system(b)) : b.normals;
}

}  // namespace galerkin_systems
