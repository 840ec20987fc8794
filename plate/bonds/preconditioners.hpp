#pragma once
#include <memory>
#include <vector>

#include "plate/bonds/family_operator.hpp"
#include "plate/bonds/stiffness.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/state.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/matrices/factor.hpp"
#include "plate/solve/plate_in_contact.hpp"

namespace plate {

/// Preconditioner of a plate with the short horizon of 1.5 spacings and without dilatation, factorised, between two
/// Jacobi sweeps: its stiffness follows that of the plate for every wave that the lattice carries (theory.md,
/// "Statics").
class ShortHorizonPreconditioner : public Preconditioner {
public:
  /// `plate` and `boundary` must outlive this. `added`: to the diagonal of what is factorised; empty: nothing.
  ShortHorizonPreconditioner(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                             const Discretization& discretization, const Forces& added = {});

  void apply(const Forces& residual, State& result) const override;

  std::size_t bytes() const override { return factor_->bytes(); }

private:
  PlateInContact plate_;  // on unilateral foundations in contact everywhere
  const Constraints& constraints_;
  Forces inverse_diagonal_;  // of the plate, times the weight of a sweep
  Unknowns unknowns_;
  std::unique_ptr<Factor> factor_;
  mutable Forces product_, rest_;
};

/// The plate of ShortHorizonPreconditioner: bonds up to 1.5 spacings, bond-based, with the stiffness of the plate
/// given.
FamilyOperator local_operator(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                              const Discretization& discretization);

/// Every second point of a lattice in both directions, and how displacements of these give those of all points
/// (theory.md, "Statics"): bilinear between the points of the coarse lattice that a point is bonded to, so that nothing
/// goes across a crack; the deflection with what the rotations add to it in a plate without shear.
class Transfer {
public:
  Transfer(const geometry::Families& families, const Boundary& boundary);

  std::size_t coarse_points() const { return cell_.size(); }
  /// Place of a coarse point in the coarse lattice.
  struct Cell {
    std::int32_t column, row;
    auto operator<=>(const Cell&) const = default;
  };
  const std::vector<Cell>& cells() const { return cell_; }
  /// The point of the plate that each coarse one is.
  const std::vector<std::uint32_t>& fine_points() const { return fine_point_; }

  void prolong(const State& coarse, State& fine) const;       // adds to `fine`
  void restrict_to(State& coarse, const Forces& fine) const;  // the transpose: coarse = R fine

private:
  std::vector<Cell> cell_;
  std::vector<std::uint32_t> fine_point_;
  LevelTransfer<float> fine_, coarse_;  // of every fine point, of every coarse point
};

/// Coarse points by their cells.
class CoarseCells {
public:
  explicit CoarseCells(const std::vector<Transfer::Cell>& cells);
  /// -1: none
  std::int32_t at(const Transfer::Cell& c) const;

private:
  std::int32_t width() const { return high_.column - low_.column + 1; }
  std::size_t index(const Transfer::Cell& c) const {
    return std::size_t(c.row - low_.row) * std::size_t(width()) + std::size_t(c.column - low_.column);
  }
  Transfer::Cell low_{0, 0}, high_{0, 0};
  std::vector<std::int32_t> point_;
};

/// Coarse cells across that one coarse point couples to.
constexpr int coarse_window = 5;

/// The stiffness R L R^T of the coarse points with the operator L, column by column: one product for all that are too
/// far from each other to meet in it. Calls visit(i, j, component, force on i of a unit of the component of j), from
/// several threads, each i in one of them. Where the plate is distributed, right for their owned points i.
using CoarseVisit = std::function<void(std::uint32_t i, std::uint32_t j, int component, const PointValues& K_ij)>;
void for_each_coarse_column(const Operator& L, const Transfer& transfer, const Constraints& constraints,
                            const CoarseCells& index, const CoarseVisit& visit);

/// The plate of every second point in both directions, R L R^T with an operator L, solved.
class CoarsePlate {
public:
  virtual ~CoarsePlate() = default;
  /// [3 x coarse points] both; zero where nothing has stiffness.
  virtual void solve(const Forces& force, State& u) const = 0;
  virtual std::size_t bytes() const = 0;
};

/// Constructs the coarse plate with a factor of its stiffness; in a distributed plate with the inverse that
/// the processes find together, exact at owned points and ghosts. `transfer` and `boundary` must outlive it.
std::unique_ptr<CoarsePlate> coarse_plate(const Operator& L, const Transfer& transfer, const Boundary& boundary);

/// Two-level preconditioner: the plate of ShortHorizonPreconditioner on every second point in both directions,
/// factorised, between Jacobi sweeps on the plate itself: a quarter of the unknowns, for plates of many points
/// (theory.md, "Statics").
class TwoLevelPreconditioner : public Preconditioner {
public:
  /// `plate` and `boundary` must outlive this.
  TwoLevelPreconditioner(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                         const Discretization& discretization);

  void apply(const Forces& residual, State& result) const override;

  std::size_t bytes() const override { return coarse_plate_->bytes(); }

private:
  PlateInContact plate_;  // on unilateral foundations in contact everywhere: another plate would not be linear
  const Constraints& constraints_;
  Forces inverse_diagonal_;  // of the plate, times the weight of a sweep
  Transfer transfer_;
  std::unique_ptr<CoarsePlate> coarse_plate_;
  mutable Forces product_, rest_, coarse_force_;
  mutable State coarse_;
};

}  // namespace plate
