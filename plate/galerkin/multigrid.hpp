#pragma once
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/galerkin/operator.hpp"
#include "plate/galerkin/supports.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/state.hpp"
#include "plate/solve/factorised_plate.hpp"

namespace plate {

/// Sums of what several processes have of points that one of them owns.
class SumByOwners {
public:
  /// `all` must outlive this.
  SumByOwners(const Communicator& all, std::vector<Copy> copies);

  /// Adds the forces on ghosts to the points of their owners, and leaves zero on the ghosts. Collective.
  void add(Forces& forces) const;

private:
  const Communicator& all_;
  std::vector<std::vector<std::uint32_t>> sent_;      // to every rank: these ghosts
  std::vector<std::vector<std::uint32_t>> received_;  // from every rank: of these owned points
};

/// Constructs the transfer to points of a finer plate from the cells of a coarser one. `own`: the points that take
/// anything; empty: all.
LevelTransfer<double> transfer_to(const std::vector<geometry::Point>& seen, const geometry::Tessellation& coarse,
                                  const std::vector<char>& own = {});

/// A Galerkin plate with its supports; `seen`: geometry::positions_inside_faces() of its cells.
struct MultigridLevel {
  geometry::Tessellation cells;
  std::vector<geometry::Point> seen;
  Boundary boundary;
  GalerkinOperator plate;
  // where the plate is distributed:
  LevelTransfer<double> to_finer = {};          // from its points
  std::shared_ptr<const SumByOwners> sum = {};  // of forces on its points
};

/// Multigrid preconditioner: the plate on coarser and coarser points, the last of them factorised, between Jacobi
/// sweeps on each (theory.md, "Statics"): rotations interpolated in the coarser cells, the deflection with what the
/// rotations add to it in a plate without shear.
class GalerkinMultigrid : public Preconditioner {
public:
  /// `plate`, `constraints` and `seen` must outlive this. `coarser`: at least one.
  GalerkinMultigrid(const GalerkinOperator& plate, const Constraints& constraints,
                    const std::vector<geometry::Point>& seen, std::vector<MultigridLevel> coarser);

  void apply(const Forces& residual, State& result) const override;

  std::size_t bytes() const override;

private:
  struct Sweeps {
    const GalerkinOperator* plate;
    const Constraints* constraints;
    Forces inverse_diagonal;                         // times the weight of a sweep
    LevelTransfer<double> from_coarser, to_coarser;  // from the points of the next coarser plate, and back
    mutable Forces rest, product, coarse_force;
    mutable State coarse;
  };

  void cycle(std::size_t level, const Forces& residual, State& result) const;

  std::vector<MultigridLevel> coarser_;
  std::vector<Sweeps> sweeps_;  // of every level but the last
  std::unique_ptr<Preconditioner> last_;
};

/// Points of all ranks.
std::size_t points_of_all(const Boundary& boundary);

/// Coarser levels of a plate, on points two, four, ... times as far apart, as long as a level has the same pieces as
/// the plate and the level before has more than 4,000 points. Where the plate is distributed, each level is shared out
/// by itself, and every rank has what its points of the finer one take from it. `seen`:
/// geometry::positions_inside_faces() of the plate's points. Collective.
std::vector<MultigridLevel> multigrid_levels(const Formulation& plate, const std::vector<geometry::Point>& seen);

}  // namespace plate
