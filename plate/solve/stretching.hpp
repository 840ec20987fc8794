#pragma once
#include "plate/model/state.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// Values of a plate and of the same points in their plane, behind each other [3 x 2 points].
inline State stacked(const State& plate, const State& membrane) {
  State result(plate.rows(), plate.cols() + membrane.cols());
  result << plate, membrane;
  return result;
}

/// Values of the plate, or of its plane, in stacked ones [3 x points].
inline State of_plate(const State& both) {
  return both.leftCols(both.cols() / 2);
}
inline State of_plane(const State& both) {
  return both.rightCols(both.cols() / 2);
}

/// Strains that deflections give the middle plane of a plate, grad w (x) grad w / 2, and the nodal forces by which they
/// load it in its plane.
struct Stretch {
  Eigen::Matrix3Xd strains;  // xx, yy, 2 xy of every point
  Forces forces;
};

/// The middle plane of a plate that stretches with its deflection (von Karman): membrane strains
/// sym grad u + grad w (x) grad w / 2. States of the plate (w, theta_x, theta_y) and of its plane (PlateLaw::membrane)
/// have the same points.
class Stretching {
public:
  virtual ~Stretching() = default;

  /// Strain energy of every point [energy].
  virtual Eigen::VectorXd energies(const State& bending, const State& membrane) const = 0;
  /// Forces on the deflections and on the displacements in the plane: minus the derivatives of that energy.
  virtual void internal_force(const State& bending, const State& membrane, Forces& on_bending,
                              Forces& on_membrane) const = 0;
  /// Second derivatives of that energy: points of the plate first, then the same points in their plane.
  virtual PointMatrix stiffness(const State& bending, const State& membrane) const = 0;
  /// Stiffness of the deflections under the membrane forces of a plate that is still flat.
  virtual PointMatrix geometric_stiffness(const State& membrane) const = 0;
  /// Strains and loads that deflections give the plane.
  virtual Stretch stretch(const State& bending) const = 0;
  /// Nxx, Nyy, Nxy of every point of the plate [force/length].
  virtual Eigen::Matrix3Xd membrane_forces(const State& bending, const State& membrane) const = 0;
  /// Stiffness of the deflections under the membrane forces of held free strains, as of heat: the same in all
  /// directions, of every point. Half its product with deflections is the energy by which strains of a heated plate
  /// exceed those above.
  virtual PointMatrix stiffness_of_heat(const Eigen::VectorXd& free) const = 0;
};

}  // namespace plate
