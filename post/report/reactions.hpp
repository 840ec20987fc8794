#pragma once
#include <functional>
#include <optional>

#include "post/balance/balance.hpp"
#include "post/files/table.hpp"

namespace plate {
class Formulation;
class Operator;
struct Instant;
}  // namespace plate

namespace post {

struct ReactionSummary;

/// The reactions of a run, row by row: what edges and pins do to the plate. No rows of a plate that nothing holds.
class ReactionRows {
public:
  /// Of plates that change from row to row.
  ReactionRows() = default;
  /// Of one plate, which must outlive this. `rotary`: factor of the rotary inertia; `mass_of_cells`: Lanczos vectors
  /// move it.
  ReactionRows(const plate::Formulation& plate, double rotary, bool mass_of_cells);

  /// Of that plate: under all of its loads where nothing moves. `forces`: the plate as it is now, where bonds may have
  /// broken.
  void add(const plate::Instant& now, const plate::Operator& forces);
  /// In equilibrium under a share of all loads.
  void add(double time, const plate::Formulation& plate, const plate::Operator& forces, const plate::State& state,
           double share);

  bool empty() const { return balances_.empty(); }
  /// The rows of reactions.csv.
  Table table() const;
  std::optional<ReactionSummary> summary() const;

private:
  std::vector<plate::Holder> holders_;
  std::vector<std::pair<double, Balance>> balances_;
  // of one plate:
  const plate::Formulation* plate_ = nullptr;
  double rotary_ = 1;
  bool mass_of_cells_ = false;
  std::optional<Supports> supports_;
  std::vector<Applied> loads_;
  std::function<plate::Forces(const plate::State&)> inertial_force_;  // where it moves
};

}  // namespace post
