#pragma once
#include <Eigen/Core>
#include "plate/model/section.hpp"
#include "plate/model/supports.hpp"

/// The local Mindlin plate, for comparison.
namespace boundary_bodies {

/// A square from -side / 2 to side / 2 under uniform pressure, held alike on opposite edges, by Ritz's method: products
/// of Legendre polynomials, of `count` even or odd ones in each direction, times what makes them vanish where held.
class RitzPlate {
public:
  /// `x`, `y`: of the edges across x, across y.
  RitzPlate(const plate::Section& section, double side, double pressure, plate::SupportKind x, plate::SupportKind y,
            int count);
  double deflection(double x, double y) const;  // from the middle

private:
  /// A function of one coordinate from -1 to 1 and its slope.
  struct Shape {
    double value, slope;
  };
  Shape shape(int field, int axis, int i, double t) const;
  Eigen::MatrixXd strains(double x, double y) const;  // psi_x,x; psi_y,y; psi_x,y + psi_y,x; two shear angles
  Eigen::RowVectorXd deflections(double x, double y) const;

  double half_;
  int count_;
  bool vanishes_[3][2];  // w, psi_x, psi_y on the edges across x, across y
  Eigen::VectorXd weights_;
};

}  // namespace boundary_bodies
