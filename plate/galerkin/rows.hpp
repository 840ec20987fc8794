#pragma once
#include <array>
#include "plate/formulation/sections/point_sections.hpp"
#include "plate/galerkin/law.hpp"

namespace plate {

/// Rows of lattice points whose forces come from the 25 points about each with the same factors: the families of a
/// point and of its neighbours, summed once for all. Of simple sections.
class GalerkinRows {
public:
  /// `stretch`: 0 of points whose forces are not asked for; rows end where it changes. Empty: all are. `awaited`:
  /// points whose values may be on their way; empty: none.
  GalerkinRows(const GalerkinFamilies& families, const PointSections& sections,
               const std::vector<std::uint32_t>& stretch = {}, const std::vector<char>& awaited = {});

  /// Of these the points that are in no row.
  const std::vector<std::uint32_t>& others() const { return others_; }

  void internal_force(const State& state, Forces& forces) const;
  /// Of rows that see no awaited point, and of the others.
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
  std::size_t inside_ = 0;  // how many of them see no awaited point, the first
  std::vector<std::uint32_t> others_;
};

}  // namespace plate
