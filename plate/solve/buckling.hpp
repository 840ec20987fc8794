#pragma once
#include <Eigen/SparseCore>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "plate/formulation/operator.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

class Constraints;
class Formulation;

struct BucklingMode {
  double factor;        // of the loads in the plane
  double residual;      // |K q + factor K_g q| / |K q|, in the norm of StaticOptions
  State shape;          // u = P q; the largest |w| is 1 and positive
  State in_plane = {};  // of a plate whose bending and stretching are coupled
};

/// Eigenpairs of A x = mu B x, descending by mu; x . B x = 1.
struct Eigenvectors {
  Eigen::VectorXd values;     // mu
  Eigen::MatrixXd vectors;    // x, side by side
  std::size_t solutions = 0;  // of B y = A x
};

/// The pairs with the largest mu, `count` at most; multiple ones as often as they are. `A`, `B`: lower triangles of
/// symmetric matrices, B positive. `purpose`: names the analysis in messages.
/// @throws NumericalError  where the iteration does not converge
/// @throws NotPositive     where B is not positive
Eigenvectors largest_eigenvectors(const Eigen::SparseMatrix<double>& A, const Eigen::SparseMatrix<double>& B,
                                  std::size_t count, double tolerance, const std::string& purpose,
                                  const Constraints& constraints);

/// The lowest positive factors of its membrane forces at which a flat plate buckles, K q = -factor K_g q on the free
/// degrees of freedom, ascending: as many as there are, `modes` at most. `geometric`:
/// Stretching::geometric_stiffness(). The plate must be held.
/// @throws NumericalError  where the iteration does not converge
std::vector<BucklingMode> buckling(const Formulation& plate, const PointMatrix& geometric, std::size_t modes,
                                   double tolerance);

/// A x = mu B x of a plate that ranks share: A, positive, and a matrix that is `share` times B.
struct SharedPencil {
  const Operator& stiffness;       // A
  const Constraints& constraints;  // of its points
  const Preconditioner* inverse;   // of A, for conjugate gradients; null: its diagonal
  const PointMatrix& other;        // right in the rows of owned points
  double share = 1;
  State start;          // of any shape that has a share of all vectors
  const char* purpose;  // names the analysis in messages
};
struct SharedEigenvector {
  double value;     // mu
  double residual;  // |A x - B x / mu| / |A x|, in the norm of StaticOptions
  State vector;     // x = P q
};

/// The positive mu of B x = mu A x, descending: `count` at most, multiple ones as often as they are. Collective.
/// @throws NumericalError  where the iteration does not converge
std::vector<SharedEigenvector> largest_shared_eigenvectors(const SharedPencil& pencil, std::size_t count,
                                                           double tolerance);

/// Buckling of a distributed plate, by conjugate gradients in place of a factor. Collective.
std::vector<BucklingMode> distributed_buckling(const Formulation& plate, const PointMatrix& geometric,
                                               std::size_t modes, double tolerance);

/// Geometric stiffness by the membrane forces of a flat plate at rest under its loads (PlateLaw::membrane).
/// @throws NumericalError  where it is not in equilibrium
PointMatrix prestress(const Formulation& membrane);

/// A plate that its membrane forces stiffen or soften: K + K_g.
class StressedPlate : public Operator {
public:
  /// Both must outlive this.
  StressedPlate(const Operator& plate, const PointMatrix& geometric) : plate_(plate), geometric_(geometric) {}

  std::size_t points() const override { return plate_.points(); }
  void internal_force(const State& state, Forces& forces) const override;
  void absolute_product(const State& state, Forces& forces) const override;
  Forces diagonal() const override;

private:
  const Operator& plate_;
  const PointMatrix& geometric_;
};

}  // namespace plate
