#pragma once
#include <optional>
#include "post/factors/tip_integrals.hpp"
#include "post/factors/tip_series.hpp"

namespace post {

/// Which points about a tip a fit takes, and how many fields.
struct FitRange {
  double inner, outer;  // distances from the tip [length]
  int order;            // of TipSeries
};

/// K1, K2, K3 by least squares of the displacements of all points about a tip to the fields that the plate can have
/// there (theory.md, "Fields about a tip"; for plane problems Ayatollahi and Nejati 2011). A linear functional of the
/// state.
struct SeriesFit {
  FitRange range;
  std::vector<std::uint32_t> points;
  Eigen::Matrix3Xd row;  // per point: of w, theta_x, theta_y

  Eigen::Vector3d operator()(const NearField& field) const;
};

/// Fits over `range` and over the given shares of it, as far as these hold enough points: 1 is the first. `heated`: by
/// temperatures that vary about the tip.
std::vector<SeriesFit> series_fits(const TipView& plate, const geometry::Tip& tip, const FitRange& range,
                                   const std::vector<double>& shares, bool heated = false);

/// The range that serves a tip best, `clear` [length] being free about it: as large as the series allows.
/// Nothing where it would hold too few points.
std::optional<FitRange> fit_range(const plate::Section& section, double clear, double spacing, bool graded);

/// Order of the series that the corrections to the eigenfunctions, which grow like exp(r / layer), ask for.
int fit_order(const plate::Section& section, double outer);

}  // namespace post
