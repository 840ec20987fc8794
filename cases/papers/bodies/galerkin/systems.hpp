#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <array>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

/// The formulations of Bode's thesis, and the plate's own, as sums of squares over families: small and plain, for
/// comparison. psi = (-theta_y, theta_x), gamma = grad w - psi, M = D[(1-nu) kappa + nu tr kappa I], Q = kG gamma.
namespace galerkin_systems {

using Nodes = std::vector<int>;
using Sparse = Eigen::SparseMatrix<double>;

struct Triangle {
  std::array<int, 3> corners;  ///< anticlockwise
  double share;                ///< of its area; 1/2 where both diagonals cut a cell
};

/// Points on a rectangle and its boundary; the outline runs anticlockwise.
struct Body {
  Eigen::Matrix2Xd points;
  std::vector<Triangle> triangles;
  std::vector<std::array<int, 2>> outline;
  Eigen::VectorXd areas;                  ///< V_k, a third of each triangle
  Eigen::Matrix2Xd normals;               ///< A_k, half of each edge at k times its outward normal
  std::vector<Nodes> families;            ///< the master first
  std::vector<std::array<int, 4>> cells;  ///< anticlockwise
  double width, height;
};

/// Extent of a family: the cells at its master, 5 x 5 points, the 21 within the thesis' 2.51 spacings.
enum class Reach { cells, two_cells, circle };

struct Lattice {
  double width, height;
  int columns, rows;        ///< of cells
  double perturbation = 0;  ///< in spacings; corners stay, other points of the boundary slide along it
  Reach reach = Reach::cells;
};

/// From the rectangle of a lattice to another shape; empty: none.
using Map = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;

/// Throws std::runtime_error where perturbation or map turn a triangle over.
Body body(const Lattice& lattice, const Map& map = {});

struct Part {
  Body body;
  Nodes names;  ///< of its points in the whole
};

/// The cells whose middles a predicate holds, as a body of its own, its families cut at its outline.
Part part(const Body& whole, const std::function<bool(const Eigen::Vector2d&)>& holds);

/// One evaluation of a family: a field's gradient there is sum_i f_i (x) gradient_i; sum_i gradient_i = 0.
struct Sample {
  Eigen::Matrix2Xd gradient;
  double weight;                                   ///< of the integration; energy density times weight
  double shear = 1;                                ///< factor on the transverse shear stiffness
  int at = 0;                                      ///< where, a position in the family's list
  Eigen::Vector2d bond = Eigen::Vector2d::Zero();  ///< n of a bond-conforming sample
};

struct Family {
  Nodes nodes;
  std::vector<Sample> samples;
};

using System = std::vector<Family>;

System operator+(System a, const System& b);
System operator*(double factor, System a);

/// A part's system by the whole's node numbers.
System renamed(System system, const Nodes& names);

/// Averages of the linear triangles around each point: PG-CA's gradient, variationally consistent by itself.
System central_average(const Body& b);

/// U1: Taylor expansion about the master (WTE1, weights V_i / r^2), integrated at the master; the correspondence model.
System linear_static(const Body& b);

/// Unl: moving Taylor expansion (MTE1) with the bond correction (Bode 5.55), integrated over the family (Bode 4.25).
System moving(const Body& b, bool bond_corrected = true);

/// U2: quadratic Taylor expansion about the master (WTE2), integrated over the family.
System quadratic_static(const Body& b);

/// Bilinear elements on the cells, 2 x 2 Gauss points: the finite elements that the thesis compares with.
System bilinear(const Body& b);

/// Samples that U1 misses of the family's integration: H^ki - H^k = r (x) n on each bond, weights c_ki of PG-CA;
/// `shear` multiplies the shear stiffness. The master's gradients are those of the first sample of each family of `u1`.
System bond_residuals(const Body& b, const System& u1, double bending, double shear);

/// U1SIG's addition: second derivatives at the master (Bode 6.28) times the second moment V^2 / (4 pi) of a disc,
/// Bode 6.25.
System implicit_gradients(const Body& b);

/// Factors h^2 / (h^2 + c V_k) on the shear stiffness of every sample of a plate of thickness h.
System shear_scaled(const Body& b, System system, double thickness, double c);

/// Correction functions Phi^k_i of Bode 5.60-5.63, one column per node of the family.
using Correction = std::function<Eigen::Matrix2Xd(const Body&, const Nodes&)>;
Eigen::Matrix2Xd constant_correction(const Body& b, const Nodes& nodes);           ///< V1
Eigen::Matrix2Xd second_derivative_correction(const Body& b, const Nodes& nodes);  ///< V2
Eigen::Matrix2Xd linear_correction(const Body& b, const Nodes& nodes);             ///< V3; V5 on bonds
Eigen::Matrix2Xd quadratic_correction(const Body& b, const Nodes& nodes);          ///< V4

/// given: sum w G_i = A_i at all points. found: at inner points alone, alpha = 0 on the surface (the thesis' suffix s),
/// where the sum is then the normal that loads must use. found_across: alpha = 0 in the direction of the surface's
/// normal alone (suffix sn), for edges along x and y.
enum class Normals { given, found, found_across };

/// Adds (I - n n) alpha_k Phi^k_i to every gradient, alpha the least-norm solution of the integration constraint.
System variationally_consistent(const Body& b, System system, const Correction& correction = linear_correction,
                                Normals normals = Normals::given);

/// sum w G_i, 2 x points: A_i where the system is variationally consistent, Bode 4.33, 4.35.
Eigen::Matrix2Xd nodal_normals(const Body& b, const System& system);

/// Largest |sum w G_i - A_i|.
double consistency_residual(const Body& b, const System& system);

/// Taylor expansion about the node `at` of the list: gradient there per node, Bode 5.52. 2 x nodes.
Eigen::Matrix2Xd taylor_gradient(const Body& b, const Nodes& nodes, int at);

/// Quadratic Taylor expansion about the master: f,x f,y f,xx f,xy f,yy per node. 5 x nodes.
Eigen::Matrix<double, 5, Eigen::Dynamic> quadratic_derivatives(const Body& b, const Nodes& nodes);

/// Least-norm solution x of M x = t, of least squares where there is none; M may be singular.
Eigen::VectorXd least_norm(const Sparse& M, const Eigen::VectorXd& t);

/// K u = f with u given where `prescribed` is a number (not NaN); K is symmetric.
Eigen::VectorXd solved(const Sparse& K, const Eigen::VectorXd& f, const Eigen::VectorXd& prescribed);

inline Eigen::VectorXd nothing_prescribed(Eigen::Index size) {
  return Eigen::VectorXd::Constant(size, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace galerkin_systems
