#pragma once
#include <optional>
#include <span>

#include "plate/bonds/family_operator.hpp"

namespace plate {

/// The bonds of a point of a row, in the forms of the row kernels: what does not depend on the states is multiplied
/// out. m, D, curvature and shear as in PatternBond; `Real` is the number of the kernel.
template <typename Real>
struct RowPattern {
  /// Two opposite bonds with equal weights.
  struct Pair {
    Real mx, my, half_length;
    Real Dx, Dy;  // D_kj m
    Real D_jk, shear;
    Real bend, g;  // of the curvature and shear differences in the couple
    std::int32_t plus, minus;
  };
  struct Single {
    Real mx, my, half_length;
    Real Dx, Dy;
    Real D_jk, shear, bend, g;
    std::int32_t step;
  };
  /// Bonds to (+-i, +-j) with equal weights; of the one to (i, j):
  struct Mirrored {
    Real Dx, Dy;                 // D_kj m
    Real shear, turn_x, turn_y;  // force per w and rotation
    Real qx, qy;                 // couple per q
    Real xx, xy, yy;             // couple per rotation
    Real wx, wy;                 // couple per w
  };
  /// All bonds of a disc, each with the weights of its mirror images.
  struct Fold {
    int radius_squared;                    // [spacing^2]
    std::vector<std::ptrdiff_t> up, down;  // by j: steps to (0, j) and (0, -j)
    std::vector<Mirrored> bonds;           // of every j those of i = 0 on; the first one is none
    Real shear;                            // sum over all bonds
  };

  std::vector<Pair> pairs;
  std::vector<Single> singles;
  std::optional<Fold> fold;              // then neither pairs nor singles
  Real stiffness = 0;                    // 2 A a
  Real Dx = 0, Dy = 0;                   // couple, per q
  Real xx = 0, xy = 0, yy = 0;           // couple, per rotation
  Real force_x = 0, force_y = 0;         // force, per rotation
  std::int64_t lowest = 0, highest = 0;  // steps that the kernel reads about a point
};

/// Bond vectors of a pattern in spacings, where all of them are whole numbers.
struct LatticeOffset {
  std::int32_t i, j;
  auto operator<=>(const LatticeOffset&) const = default;
};
std::optional<LatticeOffset> lattice_offset(const PatternBond& bond, double spacing);

/// Folded where the bonds allow it and `spacing`, the shortest bond of the plate, is given.
template <typename Real>
RowPattern<Real> row_pattern(std::span<const PatternBond> bonds, double stiffness, std::optional<double> spacing);

extern template RowPattern<double> row_pattern<double>(std::span<const PatternBond>, double, std::optional<double>);
extern template RowPattern<float> row_pattern<float>(std::span<const PatternBond>, double, std::optional<double>);

}  // namespace plate
