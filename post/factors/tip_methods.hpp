#pragma once
#include <memory>

#include "geometry/shape/crack_path.hpp"
#include "plate/model/state.hpp"
#include "post/factors/srif.hpp"

namespace plate {
class TipView;
}

namespace post {

using plate::TipView;

struct TipPlace;

/// Influences on the field about a tip beside the forces on its points.
struct ActingAtTip {
  /// Curvatures of heat that varies, less that at the tip, of which the state is cold(); in the plane the strains of
  /// the deflections. Absent where it is null.
  const Eigen::Matrix3Xd* free = nullptr;
  /// Work of the forces that press the faces of the crack apart, per length by which the tip moves on, minus; of every
  /// point [force]. Absent where it is null.
  const Eigen::VectorXd* on_faces = nullptr;
};

/// Chosen methods at one tip: built once, evaluated at any number of times. The recommended one comes first.
class TipMethods {
public:
  /// Methods that cannot work at this tip are left out.
  TipMethods(std::shared_ptr<const TipView> view, const TipPlace& place, const SrifOptions& options);

  /// Constructs the methods at a tip that another rank owns, from what that rank has reported.
  TipMethods(bool works, std::vector<std::string> left_out);

  TipMethods(TipMethods&&) noexcept;
  TipMethods& operator=(TipMethods&&) noexcept;
  ~TipMethods();

  /// `force`: internal force of the state (Operator::internal_force). `all_rings` = false: only those that the result
  /// needs, for curves in time.
  std::vector<Srif> operator()(const plate::State& state, const plate::Forces& force, bool all_rings = true,
                               const ActingAtTip& acting = {}) const;

  /// Reasons why methods were left out.
  const std::vector<std::string>& left_out() const;
  /// True where any method is left.
  bool works() const;
  /// False at a tip that another rank owns.
  bool here() const { return at_tip_ != nullptr; }

  /// K1, K2, K3 times the thickness of the fit of the fields about the tip, as functionals (rows) of the state
  /// flattened; no row where there is no fit.
  Eigen::MatrixXd functionals() const;

  /// True where any method asks for the internal force.
  bool needs_force() const;

private:
  class AtTip;
  std::unique_ptr<const AtTip> at_tip_;  // none of another process
  bool works_elsewhere_ = false;
  std::vector<std::string> left_out_elsewhere_;
};

}  // namespace post
