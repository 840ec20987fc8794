#pragma once
#include "post/factors/displacement_extrapolation.hpp"
#include "post/factors/errors.hpp"
#include "post/factors/series_fit.hpp"
#include "post/factors/tip_rings.hpp"

namespace post {

/// What is around a tip.
struct TipPlace {
  geometry::Tip tip;
  geometry::CrackPath path;
  double clear;            // clear_distance, less where loads and pins stand nearer [length]
  double narrowest;        // the least of `clear` of all tips: what is not resolved there errs everywhere [length]
  double known_error = 0;  // of all factors, whatever the field about the tip says, as a share of the largest
};

/// All chosen methods at one tip: built once, evaluated at any number of times. The recommended one comes first.
class TipMethods {
public:
  /// Methods that cannot work at this tip are left out.
  TipMethods(std::shared_ptr<const TipView> view, const TipPlace& place, const SrifOptions& options);

  /// `force`: internal force of the state (Operator::internal_force). `all_rings` = false: only those that the result
  /// needs, for curves in time.
  std::vector<Srif> operator()(const plate::State& state, const plate::Forces& force, bool all_rings = true) const;

  /// Why methods were left out.
  const std::vector<std::string>& left_out() const { return left_out_; }
  /// Is any method left?
  bool works() const { return left_out_.size() < methods_.size(); }

  /// K1, K2, K3 times the thickness of the fit of the fields about the tip, as functionals (rows) of the state
  /// flattened; no row where there is no fit.
  Eigen::MatrixXd functionals() const;

  /// Does any method ask for the internal force?
  bool needs_force() const { return !integrals_.empty(); }

private:
  struct Integral {
    std::string method;
    std::vector<Ring> rings;
    std::vector<TipIntegral> integrals;  // one per ring
  };

  Integral integral_of(const std::string& method, const geometry::Tip& tip, double clear, bool first_ring_only) const;
  Srif of(const Integral& integral, std::size_t rings, const Eigen::Vector3d& mix, const NearField& field,
          const Eigen::VectorXd& forward_work) const;
  std::size_t rings_of(const Integral& integral, bool all) const;
  Srif by_fit(const std::vector<FitSrif>& fits) const;
  void fit(const geometry::Tip& tip, double clear, bool first_only);
  std::vector<FitSrif> fitted(const NearField& field) const;
  Eigen::Vector3d split(const std::vector<FitSrif>& fits, const plate::State& state) const;

  std::shared_ptr<const TipView> view_;
  geometry::Tip tip_;
  ErrorShares shares_;
  std::vector<std::string> methods_, left_out_;
  TipSurroundings surroundings_;
  std::vector<Integral> integrals_;
  std::vector<SeriesFit> fits_;  // the widest first; none where the field within a thickness is not resolved
  std::string no_fit_;           // why
  std::vector<DisplacementExtrapolation> openings_;
  std::vector<DisplacementExtrapolation> mix_;  // one, where it is not: proportions from the opening
};

}  // namespace post
