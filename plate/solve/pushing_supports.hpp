#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "plate/model/state.hpp"
#include "plate/model/supports.hpp"

namespace plate {

class AssembledPlate;
class Formulation;

/// Points of supports that only push, of those whose deflection no support holds both ways.
class PushedPoints {
public:
  /// `plate` must outlive this.
  explicit PushedPoints(const Formulation& plate);

  std::size_t size() const { return rows_.size(); }
  /// Dirichlet lift of a unit gap [3 x points].
  State lift(std::size_t row) const;
  /// Dirichlet lift of gaps [3 x points].
  State lift(const Eigen::VectorXd& gaps) const;
  /// Forces of the supports on the plate that internal forces and loads ask for, along which they push.
  Eigen::VectorXd reactions(const Forces& forces) const;
  LiftedSupports lifted(const Eigen::VectorXd& gaps) const;

private:
  /// A point that such a support holds.
  struct Row {
    std::uint32_t point;
    double direction;  // in which it is pushed: 1 along w, -1 against it
  };

  const Formulation& plate_;
  std::vector<Row> rows_;
};

/// Error of a plate that nothing holds any more where its supports only push.
extern const char* const flies_off_supports;

/// Supports that only push under a plate at rest. Each of their points touches and is pushed, or is free and has a gap
/// (theory.md, "Supports that only push"). The factor of the plate with all points in contact is made once, and a
/// column of the stiffness against gaps for each point that opens under any load.
class PushingSupports {
public:
  /// Gaps as prescribed displacements: the Dirichlet lift of all of them [3 x points].
  struct Gaps {
    State lift;
    LiftedSupports lifted;
  };

  /// `plate` must outlive this.
  /// @throws NumericalError  where the factor of the stiffness fails
  explicit PushingSupports(const Formulation& plate);
  ~PushingSupports();

  /// Finds the gaps under a load. `settled`: Dirichlet lift of supports that have moved; without columns none.
  /// @throws NumericalError  where no equilibrium is left
  Gaps operator()(const Forces& load, const State& settled);

private:
  State held(const Forces& load, const State& settled) const;
  void add_columns(const std::vector<Eigen::Index>& rows);
  Eigen::VectorXd gaps(const std::vector<Eigen::Index>& open, const Eigen::VectorXd& reactions) const;

  const Formulation& plate_;
  std::unique_ptr<const AssembledPlate> factor_;
  PushedPoints rows_;
  std::vector<Eigen::VectorXd> columns_;  // of every row: reactions of all by a unit gap; empty until it opens
};

}  // namespace plate
