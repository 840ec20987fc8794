#pragma once
#include <array>

#include "plate/formulation/sections.hpp"
#include "plate/galerkin/families.hpp"

namespace plate {

/// Rows of lattice points whose forces come from the 25 points about each with the same factors: the families of a
/// point and of its neighbours, summed once for all. Of simple sections.
class GalerkinRows {
public:
  /// `column_block`: 0 of points whose forces are not asked for; rows end where it changes. Empty: all are. `pending`:
  /// points whose values may be on their way; empty: none.
  GalerkinRows(const GalerkinFamilies& families, const PointSections& sections,
               const std::vector<std::uint32_t>& column_block = {}, const std::vector<char>& pending = {});

  /// Points that are in no row, among those whose forces are requested.
  const std::vector<std::uint32_t>& others() const { return others_; }

  void internal_force(const State& state, Forces& forces) const;
  /// Internal forces of rows that see no pending point (inside), and of the other rows (waiting).
  void internal_force_inside(const State& state, Forces& forces) const;
  void internal_force_waiting(const State& state, Forces& forces) const;
  void absolute_product(const State& state, Forces& forces) const;
  void diagonal(Forces& diagonal) const;
  std::size_t bytes() const { return rows_.size() * sizeof(Row) + others_.size() * sizeof(std::uint32_t); }

private:
  struct Row {
    std::uint32_t first, length;
    std::array<std::int32_t, 5> step;  // to the middle of the five rows of points about it
  };
  using Factors =
      std::array<double, 225>;  // 25 places, lowest row first; of each the force's component, then the state's

  void find_factors(const LatticeFamily& lattice, const PointSections& sections, double spacing);
  template <typename Apply>
  void apply(std::size_t begin, std::size_t end, const Apply& apply) const;
  void product(const Factors& factors, std::size_t begin, std::size_t end, const State& state, Forces& forces) const;

  Factors factors_{};  // -K
  std::vector<Row> rows_;
  std::size_t inside_ = 0;  // how many of them see no pending point, the first
  std::vector<std::uint32_t> others_;
};

/// The points of a Galerkin plate that are in no row of lattice points, with the families that act on them: as many
/// families at once as a machine vector has lanes. Of simple sections.
class GalerkinLists {
public:
  /// `points`: those in no row. `pending`: points of the plate whose values may be on their way; empty: none.
  GalerkinLists(const GalerkinFamilies& families, const PointSections& sections,
                const std::vector<std::uint32_t>& points, const std::vector<char>& pending = {});

  /// Sets the forces on those points. One call at a time.
  void internal_force(const State& state, Forces& forces) const { internal_force_from(0, state, forces); }
  /// Computes the internal force in two halves: families without a pending point, then the rest.
  void begin_force(const State& state) const;
  void end_force(const State& state, Forces& forces) const { internal_force_from(inside_, state, forces); }

  /// The families that act on them, of any number of points.
  const std::vector<std::uint32_t>& kept() const { return kept_; }
  std::size_t bytes() const;

private:
  /// Families side by side, with the bonds of the largest; missing ones weigh nothing.
  struct Block {
    std::size_t first_bond;  // in bonds_, lanes at a time
    std::uint32_t bonds;
  };
  void add_block(const GalerkinFamilies& families, const PointSections& sections, std::size_t first);
  void find_slots(const GalerkinFamilies& families, const std::vector<std::uint32_t>& points);
  void act(std::size_t block, const State& state) const;
  void internal_force_from(std::size_t block, const State& state, Forces& forces) const;

  std::vector<std::uint32_t> kept_;        // without pending points first, families of one size side by side
  std::vector<std::uint32_t> kept_lanes_;  // the same by blocks, the last one filled up
  std::vector<Block> blocks_;
  std::size_t inside_ = 0;               // how many of them have no pending point, the first
  std::vector<std::uint32_t> members_;   // per bond and lane
  std::vector<double> bonds_;            // per bond: direction, 1 / length, gradient times length, share; lanes of each
  std::vector<double> families_;         // per block: stiffnesses and sums over the bonds; lanes of each
  std::vector<std::uint32_t> points_;    // in no row
  std::vector<std::size_t> first_slot_;  // per point of those
  std::vector<std::uint32_t> slots_;     // where families leave forces for it
  double poisson_;
  mutable std::vector<double>
      given_;  // force and couples that families leave: per bond and family, three rows of lanes
};

}  // namespace plate
