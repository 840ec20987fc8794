#pragma once
#include <memory>
#include <vector>

#include "plate/formulation/springs_and_stiffeners.hpp"
#include "plate/solve/stretching.hpp"

namespace plate {

/// The middle plane of a plate with stiffeners that have an axial stiffness: their axes stretch with the plane, the
/// rotations at their eccentricity, and the squares of the slopes along them (theory.md, "Stiffeners"). What the
/// rotations alone do is of the plate that bends.
class StretchedStiffeners : public Stretching {
public:
  /// `plane`: without them.
  StretchedStiffeners(std::unique_ptr<const Stretching> plane, std::vector<AxialElement> elements)
      : plane_(std::move(plane)), elements_(std::move(elements)) {}

  Eigen::VectorXd energies(const State& bending, const State& membrane) const override;
  void internal_force(const State& bending, const State& membrane, Forces& on_bending,
                      Forces& on_membrane) const override;
  PointMatrix stiffness(const State& bending, const State& membrane) const override;
  PointMatrix geometric_stiffness(const State& membrane) const override;
  Stretch stretch(const State& bending) const override;
  Eigen::Matrix3Xd membrane_forces(const State& bending, const State& membrane) const override {
    return plane_->membrane_forces(bending, membrane);
  }
  PointMatrix stiffness_of_heat(const Eigen::VectorXd& free) const override { return plane_->stiffness_of_heat(free); }
  PointMatrix stiffness_of_forces(const Eigen::Matrix3Xd& forces) const override {
    return plane_->stiffness_of_forces(forces);
  }

private:
  std::unique_ptr<const Stretching> plane_;
  std::vector<AxialElement> elements_;
};

}  // namespace plate
