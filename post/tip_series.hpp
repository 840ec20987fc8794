#pragma once
#include <vector>
#include "plate/section.hpp"
#include "post/tip_frame.hpp"

namespace post {

/// The fields that a Mindlin plate can have about the tip of a straight crack with free faces: exact solutions, each a power
/// series that begins with one of the eigenfunctions of its leading order, plane stress for the rotations or a harmonic
/// deflection (Williams 1957 for both), or with an even load (theory.md, "Fields about a tip").
class TipSeries {
public:
  /// All fields that begin with a power r^(n/2) of psi or r^(n/2+1) of w, n <= order, and are bounded. They are made for
  /// distances up to `radius` [length].
  TipSeries(const plate::Section& section, double radius, int order);

  Eigen::Index size() const { return Eigen::Index(fields_.size()); }
  /// w, psi_x', psi_y' (rows) of every field (columns), of the size of w / radius and psi in them [length, 1, 1].
  Eigen::Matrix3Xd operator()(const Polar& at) const;
  /// K1, K2, K3 (rows) of every field (columns).
  const Eigen::Matrix3Xd& factors() const { return factors_; }

private:
  /// Re sum c r^p exp(i q angle) of w and sum c r^p exp(i q angle) of psi_x' + i psi_y', p and q in halves from the lowest.
  struct Term {
    int twice_p, twice_q;
    double c;
  };
  struct Field {
    bool even;  // w in y'; the coefficients of an odd field are i times those that are stored
    std::vector<Term> w, psi;
  };
  class Maker;

  double radius_;
  std::vector<Field> fields_;
  Eigen::Matrix3Xd factors_;
  int highest_p_ = 0, highest_q_ = 0;
};

}  // namespace post
