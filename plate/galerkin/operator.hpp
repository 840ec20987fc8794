#pragma once
#include <optional>

#include "plate/formulation/elastic_supports.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/galerkin/force_kernels.hpp"
#include "plate/model/point_map.hpp"
#include "plate/model/state.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// Products with an assembled stiffness, each point by the blocks of its own row: for plates whose families share no
/// weights. Any number of threads gives the same bits.
class PointRows {
public:
  /// `points`: those whose rows are wanted; the other columns of a result are left as they are.
  PointRows(PointMatrix matrix, std::vector<std::uint32_t> points);

  const PointMatrix& matrix() const { return matrix_; }
  void internal_force(const State& state, Forces& forces) const;    // -K state
  void absolute_product(const State& state, Forces& forces) const;  // |K| state
  void diagonal(Forces& diagonal) const;
  std::size_t bytes() const;

private:
  /// A block of a row: of the lower triangle, or the transpose of one.
  struct Entry {
    std::uint32_t point;
    bool transposed;
    std::size_t block;
  };
  template <typename Add>
  void gather(Forces& result, const Add& add) const;

  PointMatrix matrix_;
  std::vector<std::uint32_t> points_;
  std::vector<std::size_t> first_;  // per point of those [points_ + 1]
  std::vector<Entry> entries_;
};

/// The Galerkin plate: nodal mean strains of the cells about every point, and residuals of its bonds (theory.md, "The
/// Galerkin plate"). Points inside the lattice by rows, all others by lists of their bonds, or with directions by
/// the assembled stiffness; sections that vary by that alone.
/// Forces are gathered: any number of threads gives the same bits. One call at a time.
class GalerkinOperator : public Operator {
public:
  /// `column_block`: 0 of points whose forces are not asked for, and zero; rows end where it changes. Empty: all are.
  /// `pending`: points whose values may be on their way (Constraints); empty: none.
  GalerkinOperator(GalerkinFamilies families, PointSections sections, ElasticSupports elastic_supports = {},
                   const std::vector<std::uint32_t>& column_block = {}, const std::vector<char>& pending = {});

  std::size_t points() const override { return families_.areas.size(); }
  void internal_force(const State& state, Forces& forces) const override;
  void internal_force_overlapped(const State& state, PendingExchange& rest, Forces& forces) const override;
  void absolute_product(const State& state, Forces& forces) const override;
  Forces diagonal() const override;

  /// Strain energy of every family [points].
  Eigen::VectorXd energies(const State& state) const;

  const GalerkinFamilies& families() const { return families_; }
  const PointSections& sections() const { return sections_; }
  /// Stiffness without the elastic supports.
  PointMatrix own_matrix() const;
  const ElasticSupports& elastic_supports() const { return elastic_supports_; }
  std::size_t bytes() const;

private:
  void complete(const State& state, Forces& forces) const;
  template <typename Own>
  void gather(const Own& own, Forces& result) const;

  GalerkinFamilies families_;
  PointSections sections_;
  std::optional<GalerkinRows> rows_;    // of uniform sections
  std::optional<GalerkinLists> lists_;  // of simple sections, all other points
  std::optional<PointRows> whole_;      // of other sections, likewise
  ElasticSupports elastic_supports_;
  std::vector<std::uint32_t> copies_;  // points that are not one's own
  bool knows_pending_;
};

/// Nodal forces [3 x points] of a free thermal curvature kappa_0 given by points: minus the derivative of
/// -sum of V D (1 + nu) kappa_0 times the curvatures, theory (79); for sections with material directions, with
/// moments_held_flat(). `own`: the points whose forces are requested, where the plate is distributed.
Forces force_of_curvature(const GalerkinFamilies& families, const Section& section, const Eigen::VectorXd& curvature,
                          const PointMap& map = {});

}  // namespace plate
