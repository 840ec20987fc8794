#pragma once
#include <string>

#include "cases/papers/bodies/galerkin/plane.hpp"

/// Displacement, pressure and dilation as the thesis mixes them (Bode 6.2), linear: the potential of Hu and Washizu is
/// mu (eps:eps - tr^2 eps / 3) + K Theta^2 / 2 + p (div u - Theta), Bode 2.43, 2.59; p is positive in tension.
namespace galerkin_systems {

/// Variation of p and Theta over a family.
enum class Pressure {
  displacement,  ///< p = K div u at every sample: no field of its own
  masters,       ///< the same at the families' first samples, and no K at the others (Bode 6.2, underintegrated)
  constant,      ///< P0, Bode 6.9
  linear,        ///< P1: value and slope unknowns of the family, Bode 6.10
  continuous     ///< P1C: values at the points, slopes by the displacements' gradient at the master, Bode 6.11
};

/// A plane formulation by the thesis' name.
struct Basis {
  std::string name;
  Reach reach;
  std::function<System(const Body&)> system;
  Pressure pressure = Pressure::displacement;
  bool bubble = false;               ///< u_b (x) (X_j - X_c) per family, Bode 6.12, 6.15
  Normals normals = Normals::given;  ///< found: loads use sum w G_i
};

/// A_k by which a traction loads the points, 2 x points.
Eigen::Matrix2Xd load_normals(const Body& b, const Basis& basis);

const std::vector<Basis>& bases();

/// The row of that name; throws std::out_of_range.
const Basis& basis(const std::string& name);

/// The quadratic form and its constraints, over displacements of the points and then of the bubbles.
struct Blocks {
  Sparse isochoric;     ///< everything, with Pressure::displacement
  Sparse divergence;    ///< pressures x displacements: sum w q div u of each pressure function q
  Sparse pressures;     ///< sum w q q
  Sparse gradients;     ///< sum w H:H, the H1 half-norm of Bode 7.12
  Sparse read;          ///< points x (displacements, pressures): p at the masters
  Eigen::Index points;  ///< 2 x them: the displacements that are no bubbles
};

Blocks blocks(const Solid& solid, const Body& b, const System& system, Pressure pressure, bool bubble);
Blocks blocks(const Solid& solid, const Body& b, const Basis& basis);

/// Stiffness of the displacements with pressures (Bode 6.6) and bubbles condensed: full where there are any.
Sparse condensed(const Solid& solid, const Blocks& blocks);

struct PlaneSolution {
  Eigen::VectorXd u, p;  ///< displacements and pressures of the points
};

/// Under loads of the points' displacements, `prescribed` as for `solved`; sparse, no condensation.
PlaneSolution solution(const Solid& solid, const Blocks& blocks, const Eigen::VectorXd& load,
                       const Eigen::VectorXd& prescribed);

/// The constrained eigenvalues of Bode 7.11, T U = lambda S U, and what follows from them.
struct InfSup {
  double value;  ///< sqrt of the smallest that is not zero, Bode 7.14
  int spurious;  ///< pressure functions that no displacement feels, Bode 7.15
};

InfSup inf_sup(const Blocks& blocks, const std::vector<Eigen::Index>& free);

/// The square of Bode 7.2.5 in cells x cells: u_x = 0 on the left edge, u_y = 0 at its lower end. Where the pressure is
/// no field of its own: T of the divergences at all samples, no spurious ones are counted.
InfSup inf_sup(const Basis& basis, Reach reach, int cells, double perturbation);

/// PPG UnlP0: distortion as PPG1 (Bode 4.21), K at the masters alone (Bode 6.7); trial as Unl, test gradients apart.
/// `dilation` has the gradients of the volume change, first samples: those of Unl, or the test's.
Sparse petrov_constant_pressure(const Solid& solid, const Body& b, const System& test, const System& dilation);

}  // namespace galerkin_systems
