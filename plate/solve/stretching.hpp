#pragma once
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/operator.hpp"
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

/// Constraints of stacked() states of a plate of so many points and its plane.
inline Constraints stacked(const Constraints& plate, const Constraints& membrane, std::size_t points) {
  Constraints result;
  result.add(plate, 0), result.add(membrane, std::uint32_t(points));
  result.resolve();
  return result;
}

/// A plate and its plane that do not act on each other, as the stiffness of stacked() states.
class StackedOperator : public Operator {
public:
  /// Both have as many points, and must outlive this.
  StackedOperator(const Operator& plate, const Operator& membrane) : plate_(plate), membrane_(membrane) {}

  std::size_t points() const override { return 2 * plate_.points(); }
  void internal_force(const State& state, Forces& forces) const override {
    Forces on_plate, on_membrane;
    plate_.internal_force(of_plate(state), on_plate), membrane_.internal_force(of_plane(state), on_membrane);
    forces = stacked(on_plate, on_membrane);
  }
  void absolute_product(const State& state, Forces& forces) const override {
    Forces on_plate, on_membrane;
    plate_.absolute_product(of_plate(state), on_plate), membrane_.absolute_product(of_plane(state), on_membrane);
    forces = stacked(on_plate, on_membrane);
  }
  Forces diagonal() const override { return stacked(plate_.diagonal(), membrane_.diagonal()); }

private:
  const Operator &plate_, &membrane_;
};

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
