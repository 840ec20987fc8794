#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "plate/formulation/tip_view.hpp"
#include "plate/model/section.hpp"
#include "post/factors/tip_integrals.hpp"

namespace post {

using plate::Polar, plate::TipFrame;

/// The fields that a Mindlin plate can have about the tip of a straight crack with free faces: exact solutions, each a
/// power series that begins with one of the eigenfunctions of its leading order, plane stress for the rotations or a
/// harmonic deflection (Williams 1957 for both), or with an even load (theory.md, "Fields about a tip").
class TipSeries {
public:
  /// Constructs all fields that begin with a power r^(n/2) of psi or r^(n/2+1) of w, n <= order, and are bounded. They
  /// are made for distances up to `radius` [length]. `heated`: two more, of free curvatures kappa_0 that grow straight
  /// ahead and to the left. `curvature`: of the crack behind the tip [1 / length], to whose first order the faces of
  /// all fields but the heated ones are free (theory.md, "Curved cracks").
  TipSeries(const plate::Section& section, double radius, int order, bool heated = false, double curvature = 0);

  Eigen::Index size() const { return Eigen::Index(orders_.size()); }
  /// The n with which every field begins.
  const std::vector<int>& orders() const { return orders_; }
  /// w, psi_x', psi_y' of every field (columns) at all places (three rows each), of the size of w / radius and psi in
  /// them [length, 1, 1].
  Eigen::MatrixXd operator()(const std::vector<Polar>& places) const;
  /// K1, K2, K3 (rows) of every field (columns).
  const Eigen::Matrix3Xd& factors() const { return factors_; }

private:
  /// c r^p exp(i q angle), p and q in halves.
  struct Term {
    int twice_p, twice_q;
    double c;
  };
  /// Re of sums of such terms is w, and sums of others are psi_x' + i psi_y'; in odd fields i times that.
  struct Field {
    bool even;  // w in y'
    int order;
    std::vector<Term> w, psi;
    std::vector<Term> w_of_curve = {}, psi_of_curve = {};  // of the other symmetry
  };
  /// The fields of one symmetry: what they take (columns) of the same terms.
  struct Half {
    std::vector<std::pair<int, int>> terms;  // twice p and q
    std::vector<Eigen::Index> fields;
    Eigen::MatrixXd w, psi;  // terms x fields
  };
  class Maker;

  static Half half(const std::vector<Field>& fields, bool even);

  double radius_;
  std::vector<int> orders_;
  Half even_, odd_;
  Eigen::Matrix3Xd factors_;
};

/// Points about a tip that a fit takes, and number of fields.
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
std::vector<SeriesFit> series_fits(const TipView& plate, const TipFrame& frame, const FitRange& range,
                                   const std::vector<double>& shares, bool heated = false);

/// The range that serves a tip best, `clear` [length] being free about it: as large as the series allows.
/// Nothing where it would hold too few points.
std::optional<FitRange> fit_range(const plate::Section& section, double clear, double spacing, bool graded);

/// Order of the series that the corrections to the eigenfunctions, which grow like exp(r / layer), ask for.
int fit_order(const plate::Section& section, double outer);

}  // namespace post
