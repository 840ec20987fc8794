#pragma once
#include <vector>
#include "plate/formulation/tip_frame.hpp"
#include "plate/model/section.hpp"

namespace post {

using plate::Polar, plate::TipFrame;

/// The fields that a Mindlin plate can have about the tip of a straight crack with free faces: exact solutions, each a
/// power series that begins with one of the eigenfunctions of its leading order, plane stress for the rotations or a
/// harmonic deflection (Williams 1957 for both), or with an even load (theory.md, "Fields about a tip").
class TipSeries {
public:
  /// All fields that begin with a power r^(n/2) of psi or r^(n/2+1) of w, n <= order, and are bounded. They are made
  /// for distances up to `radius` [length]. `heated`: two more, of free curvatures kappa_0 that grow straight ahead and
  /// to the left.
  TipSeries(const plate::Section& section, double radius, int order, bool heated = false);

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

}  // namespace post
