#pragma once
#include <memory>
#include <optional>

#include "plate/model/state.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"

namespace plate {
class Formulation;
class Operator;
struct Instant;
}  // namespace plate

namespace post {

/// The reactions of a run, row by row: what edges, pins, foundations and springs do to the plate. No
/// rows of a plate that nothing holds.
class ReactionRows {
public:
  /// Of plates that change from row to row.
  ReactionRows() = default;
  /// Of one plate, which must outlive this. `rotary`: factor of the rotary inertia; `mass_of_cells`: Lanczos vectors
  /// move it; `drag`: alpha of its damping, whose forces count as inertia.
  ReactionRows(const plate::Formulation& plate, double rotary, bool mass_of_cells, double drag = 0);

  /// Of that plate: under all of its loads where nothing moves. `forces`: the plate as it is now, where bonds may have
  /// broken.
  void add(const plate::Instant& now, const plate::Operator& forces);
  /// In equilibrium under a share of all loads.
  void add(double time, const plate::Formulation& plate, const plate::Operator& forces, const plate::State& state,
           double share);

  /// In equilibrium under a load.
  void add(double time, const plate::Formulation& plate, const plate::Operator& forces, const plate::State& state,
           const plate::Forces& load);

  /// By the Lanczos vectors that move the plate: ReactionSummary::truncation.
  void truncated(double share) { truncation_ = share; }

  bool empty() const { return balances_.empty(); }
  /// The rows of reactions.csv.
  Table table() const;
  std::optional<ReactionSummary> summary() const;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(supports_, balances_);
  }

private:
  /// One plate as it moves.
  struct Moving;

  std::vector<ReactionSummary::Support> supports_;
  std::vector<std::pair<double, Balance>> balances_;
  std::optional<double> truncation_;
  // of one plate:
  const plate::Formulation* plate_ = nullptr;
  double rotary_ = 1, drag_ = 0;
  bool mass_of_cells_ = false;
  std::shared_ptr<const Moving> moving_;  // once it does
};

}  // namespace post
