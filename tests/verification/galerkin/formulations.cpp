// Each formulation in a line or two; the weights of PG-CA's residuals and shear factors are those of its
// recommendation.
#include "tests/verification/galerkin/formulations.hpp"

#include <stdexcept>

namespace galerkin_systems {
namespace {

constexpr double tb = 0.5, ts = 1, master_shear = 0.05, residual_shear = 1;

Body reaching(Lattice l, Reach reach) {
  l.reach = reach;
  return body(l);
}

Body near(const Lattice& l) {
  return reaching(l, Reach::cells);
}
Body far(const Lattice& l) {
  return reaching(l, Reach::two_cells);
}

/// Master gradients with bond residuals and both shear factors: the energy of PG-CA.
System stabilised(const Body& b, const System& u1, double h) {
  return shear_scaled(b, u1, h, master_shear) + shear_scaled(b, bond_residuals(b, u1, tb, ts), h, residual_shear);
}

System consistent_u1(const Body& b) {
  return variationally_consistent(b, linear_static(b));
}
System consistent_unl(const Body& b) {
  return variationally_consistent(b, moving(b));
}

/// Bode 6.18 with half of the modulus stabilising.
System u1_s_unl(const Body& b) {
  return 0.5 * consistent_u1(b) + 0.5 * consistent_unl(b);
}

/// Bode 6.25.
System u1_sig(const Lattice& l) {
  return consistent_u1(near(l)) + implicit_gradients(near(l));
}

/// PG-CA's factor of the master on all of the shear.
System scaled(const Lattice& l, const System& system, double h) {
  return shear_scaled(body(l), system, h, master_shear);
}

}  // namespace

const std::vector<Formulation>& formulations() {
  using L = const Lattice&;
  static const std::vector<Formulation> table{
      // name, system, consistent, stable, locks
      {"PG-CA", [](L l, double h) { return stabilised(near(l), central_average(near(l)), h); }, true, true, false},
      {"CA, masters only", [](L l, double) { return central_average(near(l)); }, true, false, false},
      {"CA, shear unscaled",
       [](L l, double) { return central_average(near(l)) + bond_residuals(near(l), central_average(near(l)), tb, ts); },
       true, true, true},
      {"U1", [](L l, double) { return linear_static(near(l)); }, false, false, false},
      {"U1, residuals", [](L l, double h) { return stabilised(near(l), linear_static(near(l)), h); }, false, true,
       false},
      {"U1 5x5, residuals", [](L l, double h) { return stabilised(far(l), linear_static(far(l)), h); }, false, true,
       false},
      {"VC U1", [](L l, double) { return consistent_u1(near(l)); }, true, false, false},
      {"VC U1, residuals", [](L l, double h) { return stabilised(near(l), consistent_u1(near(l)), h); }, true, true,
       false},
      {"Unl, direct shear", [](L l, double) { return moving(near(l)); }, false, true, true, Shear::direct},
      {"VC Unl, direct shear", [](L l, double) { return consistent_unl(near(l)); }, false, true, true, Shear::direct},
      {"Unl", [](L l, double) { return moving(near(l)); }, false, true, true},
      {"VC Unl", [](L l, double) { return consistent_unl(near(l)); }, true, true, true},
      {"VC Unl, shear scaled", [](L l, double h) { return scaled(l, consistent_unl(near(l)), h); }, true, true, false},
      {"VC U1SUnl", [](L l, double) { return u1_s_unl(near(l)); }, true, true, true},
      {"VC U1SUnl, shear scaled", [](L l, double h) { return scaled(l, u1_s_unl(near(l)), h); }, true, true, false},
      {"VC U1SIG", [](L l, double) { return u1_sig(l); }, true, true, true},
      {"VC U1SIG, shear scaled", [](L l, double h) { return scaled(l, u1_sig(l), h); }, true, true, false},
  };
  return table;
}

const std::vector<Formulation>& assumed_shear() {
  using L = const Lattice&;
  static const std::vector<Formulation> table{
      {"VC Unl, assumed shear", [](L l, double) { return consistent_unl(near(l)); }, true, false, false,
       Shear::assumed_bond},
      {"VC Unl, assumed shear scaled", [](L l, double h) { return scaled(l, consistent_unl(near(l)), h); }, true, false,
       false, Shear::assumed_bond},
      {"VC Unl, assumed direct shear", [](L l, double) { return consistent_unl(near(l)); }, false, false, true,
       Shear::assumed_direct},
      {"VC Unl, shear assumed across bonds", [](L l, double) { return consistent_unl(near(l)); }, true, true, true,
       Shear::assumed_along},
  };
  return table;
}

const Formulation& formulation(const std::string& name) {
  for (const Formulation& f : formulations())
    if (f.name == name) return f;
  throw std::out_of_range("no formulation " + name);
}

Sparse stiffness(const Plate& plate, const Formulation& f, const Lattice& lattice) {
  return stiffness(plate, f.system(lattice, plate.thickness), body(lattice), f.shear);
}

}  // namespace galerkin_systems
