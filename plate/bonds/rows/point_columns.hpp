#pragma once
#include "plate/bonds/rows/pattern.hpp"

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

/// Of every point of the plate.
struct PointNumbers {
  const std::vector<std::uint32_t>& pattern_of;  // which of the patterns it has
  const std::vector<std::uint32_t>& block;       // no column holds points of different blocks; empty: one block
};

/// Columns of `shortest` to `longest` of the given points that reach no further than `farthest` spacings.
PointColumns point_columns(const Patterns& patterns, const std::vector<std::uint32_t>& points,
                           const PointNumbers& numbers, double spacing, std::uint32_t shortest, std::uint32_t longest,
                           std::uint32_t farthest, std::int32_t pitch);

}  // namespace plate
