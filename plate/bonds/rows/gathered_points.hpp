#pragma once
#include "plate/bonds/rows/row_kernels.hpp"

namespace plate {

/// Points one above the other with equal bonds, whose neighbours the numbering does not put at equal steps.
struct PointColumn {
  std::vector<std::uint32_t> points;   // upwards
  std::uint32_t reach = 0;             // spacings
  std::uint32_t pattern = 0;           // of PointColumns
  std::vector<std::uint32_t> sources;  // what the column sees: (2 reach + 1) rows of points + 2 reach, turned
};

/// The bonds of a pattern are turned so that the column lies along x: the rotations about x and y are theta_y and
/// -theta_x, and `step` is that between points kept in rows of `pitch`.
struct PointColumns {
  struct Pattern {
    std::vector<PatternBond> bonds;
    double stiffness;  // as in Patterns
  };
  std::vector<PointColumn> columns;
  std::vector<Pattern> patterns;
  std::vector<std::uint32_t> rest;  // points in no column
};

/// Pattern and block of every point of the plate.
struct PointNumbers {
  const std::vector<std::uint32_t>& pattern_of;  // which of the patterns it has
  const std::vector<std::uint32_t>& block;       // no column holds points of different blocks; empty: one block
};

/// Columns of `shortest` to `longest` of the given points that reach no further than `farthest` spacings.
PointColumns point_columns(const Patterns& patterns, const std::vector<std::uint32_t>& points,
                           const PointNumbers& numbers, double spacing, std::uint32_t shortest, std::uint32_t longest,
                           std::uint32_t farthest, std::int32_t pitch);

/// Points that no row takes, one vector of them at a time, with the weights of their bonds lane by lane.
template <typename Real>
class Packets {
public:
  /// `pattern_of` [points of the plate]: which of the patterns a point has.
  void add(const Patterns& patterns, std::vector<std::uint32_t> points, const std::vector<std::uint32_t>& pattern_of);

  std::size_t size() const { return packets_.size(); }
  void dilatation(std::size_t i, const Fields<Real>& in, Real* q) const;
  void force(std::size_t i, const Fields<Real>& in, const ForceFields<Real>& out) const;

  /// Rough time of a packet, in operations on a vector.
  double work(std::size_t i) const { return 120 * double(packets_[i].end - packets_[i].first); }
  std::size_t bytes() const { return packets_.size() * sizeof(Packet) + bonds_.size() * sizeof(Bond); }

private:
  static constexpr std::size_t lanes = Lane<Real>::size();

  /// Bond that every point of a packet has.
  struct Bond {
    Real mx[lanes], my[lanes], half_length[lanes];
    Real D_kj[lanes], D_jk[lanes], curvature[lanes], shear[lanes];
    std::uint32_t neighbour[lanes];
  };
  struct Packet {
    std::uint32_t point[lanes], used;
    Real stiffness[lanes];   // 2 A a
    std::size_t first, end;  // in bonds_
  };
  std::vector<Packet> packets_;
  std::vector<Bond> bonds_;
};

extern template class Packets<double>;
extern template class Packets<float>;

}  // namespace plate
