#pragma once
#include <experimental/simd>
#include "plate/family_operator.hpp"

namespace plate {

/// The same plate as a FamilyOperator, for many points at once: where neighbouring points share a pattern of bonds, as
/// on the rows of a lattice, a vector of them is treated together, and bonds with an opposite one of the same weights
/// go in pairs; all other points go in packets of one vector, which share a pattern or have weights lane by lane.
/// Forces are gathered: any number of threads gives the same bits. One call at a time.
class LatticeOperator : public FamilyOperator {
public:
  explicit LatticeOperator(FamilyOperator plate);

  void internal_force(const State& state, Forces& forces) const override;

  /// Share of the points that are treated in pairs of opposite bonds, and in rows of equal ones.
  double paired_share() const { return paired_share_; }
  double row_share() const { return row_share_; }
  std::size_t bytes() const;

private:
  static constexpr std::size_t packet = std::experimental::native_simd<double>::size();  // points

  /// Two opposite bonds of a point with equal weights.
  struct Pair {
    double mx, my, half_length;
    double Dx, Dy;  // D_kj m
    double D_jk, shear;
    double bend, g;  // of the curvature and shear differences in the couple
    std::int32_t plus, minus;
  };
  struct Single {
    double mx, my, half_length;
    double Dx, Dy;
    double D_jk, shear, bend, g;
    std::int32_t step;
  };
  /// Bonds of a pattern, and what a point's own rotations and dilatation do to it.
  struct RowPattern {
    std::vector<Pair> pairs;
    std::vector<Single> singles;
    double Dx = 0, Dy = 0;            // couple, per q
    double xx = 0, xy = 0, yy = 0;    // couple, per rotation
    double force_x = 0, force_y = 0;  // force, per rotation
  };
  struct Row {
    std::uint32_t first, length, pattern;
  };
  /// Points of one pattern that do not follow each other.
  struct Packet {
    std::uint32_t point[packet], used, pattern;
  };
  /// One bond of every point of a packet of different patterns.
  struct MixedBond {
    double mx[packet], my[packet], half_length[packet];
    double D_kj[packet], D_jk[packet], curvature[packet], shear[packet];
    std::uint32_t neighbour[packet];
  };
  struct MixedPacket {
    std::uint32_t point[packet], used;
    std::size_t first, end;  // in mixed_bonds_
  };
  using Loose = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // point, pattern

  RowPattern row_pattern(const PatternBond* begin, const PatternBond* end) const;
  std::uint32_t row_pattern_of(std::uint32_t pattern);
  void add_rows();
  void add_packets(Loose points);
  void add_mixed(const Loose& points);
  template <typename Place>
  void dilatation(const Place& place, const RowPattern& pattern, const State& state) const;
  template <typename Place>
  void force(const Place& place, const RowPattern& pattern, const State& state, Forces& forces) const;
  void mixed_dilatation(const MixedPacket& packet, const State& state) const;
  void mixed_force(const MixedPacket& packet, const State& state, Forces& forces) const;

  std::vector<std::int64_t> row_pattern_index_;  // of a family pattern, -1: not needed
  std::vector<RowPattern> row_patterns_;
  std::vector<Row> rows_;
  std::vector<Packet> packets_;
  std::vector<MixedPacket> mixed_;
  std::vector<MixedBond> mixed_bonds_;
  double paired_share_ = 0, row_share_ = 0;
  mutable Eigen::ArrayXd q_;  // as in FamilyOperator
};

}  // namespace plate
