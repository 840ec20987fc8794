#pragma once
#include "post/displacement_extrapolation.hpp"
#include "post/interaction_integral.hpp"
#include "post/tip_rings.hpp"

namespace post {

/// What is around a tip.
struct TipPlace {
  geometry::Tip tip;
  geometry::CrackPath path;
  double clear;  // clear_distance, less where loads and pins stand nearer [length]
};

/// All chosen methods at one tip: built once, evaluated at any number of times. The recommended one comes first.
class TipMethods {
public:
  /// Methods that cannot work at this tip are left out; throws std::invalid_argument, with the reasons, where none can.
  TipMethods(const BondedPlate& plate, const TipPlace& place, double horizon, const SrifOptions& options);

  /// `force`: internal force of the state (FamilyOperator::internal_force).
  std::vector<Srif> operator()(const plate::State& state, const plate::Forces& force) const;

  /// Why methods were left out.
  const std::vector<std::string>& left_out() const { return left_out_; }

  /// Does any method ask for the internal force?
  bool needs_force() const { return !integrals_.empty(); }

private:
  struct Integral {
    std::string method;
    std::vector<Ring> rings;
    std::vector<TipIntegral> integrals;  // one per ring
  };

  static Integral integral_of(const std::string& method, const BondedPlate& plate, const geometry::Tip& tip, double clear);
  Srif of(const Integral& integral, const Eigen::Vector3d& mix, const plate::State& state,
          const plate::Forces& force) const;
  void estimate(std::vector<Srif>& found, const Eigen::Vector3d& mix) const;
  Eigen::Vector3d split(const plate::State& state, const plate::Forces& force) const;

  geometry::Tip tip_;
  plate::Section section_;
  std::vector<std::string> methods_, left_out_;
  std::vector<Integral> integrals_;
  std::vector<InteractionIntegral> interaction_;      // one, where the field of the thickness is resolved
  std::vector<DisplacementExtrapolation> openings_;
  std::vector<DisplacementExtrapolation> mix_;        // one, where it is not: proportions from the opening
};

}  // namespace post
