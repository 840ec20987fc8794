#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "plate/bonds/family_weights.hpp"

namespace plate {
struct Boundary;
class FamilyOperator;
}  // namespace plate

namespace fracture {

/// Bonds that have broken, one bit for each directed bond of the points that lost any. Points that did are numbered in
/// the order of their first loss.
class BrokenBonds {
public:
  /// `longest`: bonds of the largest family.
  BrokenBonds(std::size_t points, std::size_t longest) : words_per_point_((longest + 63) / 64), number_(points, -1) {}

  /// Number of a point; -1: all its bonds are intact.
  std::int32_t number(std::size_t k) const { return number_[k]; }
  std::size_t points() const { return words_per_point_ == 0 ? 0 : words_.size() / words_per_point_; }

  /// The i-th bond of point k.
  bool broken(std::size_t k, std::size_t i) const { return number_[k] >= 0 && (words_[word(k, i)] >> (i % 64) & 1); }
  void set(std::size_t k, std::size_t i) {
    if (number_[k] < 0) {
      number_[k] = std::int32_t(points());
      words_.resize(words_.size() + words_per_point_, 0);
    }
    words_[word(k, i)] |= std::uint64_t(1) << (i % 64);
  }

  /// Directed bonds.
  std::size_t count() const {
    std::size_t sum = 0;
    for (const auto word : words_) sum += std::size_t(std::popcount(word));
    return sum;
  }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(number_, words_);
  }

private:
  std::size_t word(std::size_t k, std::size_t i) const { return std::size_t(number_[k]) * words_per_point_ + i / 64; }

  std::size_t words_per_point_;
  std::vector<std::int32_t> number_;
  std::vector<std::uint64_t> words_;
};

/// A family that lost bonds, with all bonds of its base; the weights of broken ones go to zero.
struct Change {
  plate::OwnFamily now;
  std::vector<plate::BondWeights> target;
  double a_target;
  unsigned left = 0;     // steps to the target, of single bonds
  bool ongoing = false;  // by a piece of crack that goes on
};

/// Contribution of a changed family to the forces: one bond of the family.
struct Difference {
  std::uint32_t neighbour;
  double mx, my, length;  // as in BondShape
  double D_base, D_now;
  double curvature, shear;  // 2 A times what B and S have gained
};

/// Upper bounds of the stiffness of families that have lost bonds, and of their bonds.
struct Stiffest {
  double bending = 0, shear = 0;
  std::vector<plate::BondWeights> bonds;  // B and S by bond vector; infinite for those of no full family
};

/// Stiffness of a family's bonds against rotations (bending) and deflections (shear) of its point alone, divided by its
/// area.
double bending_stiffness(double a, std::span<const plate::BondWeights> bonds);
double shear_stiffness(std::span<const plate::BondWeights> bonds);

/// Computes the bounds from the first full family of the plate, on whichever rank it is.
Stiffest stiffest(const plate::FamilyOperator& plate, const plate::Boundary& boundary);

}  // namespace fracture
