#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>
#include "plate/model/point_map.hpp"
#include "plate/model/state.hpp"

namespace plate {

class HaloExchange;

/// Degrees of freedom that are zero or follow others. Together they are the matrix P of
/// u = P q; forces go back by its transpose, so that a symmetric stiffness stays symmetric.
class Constraints {
public:
  struct Leader {
    Dof dof;
    double factor;
  };
  struct Tie {
    Dof follower, leader;
    double factor;  // u[follower] = sum of factor * u[leader] over its ties
  };
  /// Offset of a held degree of freedom from the value of its leaders, per unit motion of its support.
  struct Offset {
    std::size_t motion;  // whose
    double value;
  };

  void fix(const Dof& dof, std::vector<Offset> offsets = {});
  /// u[follower] = sum of factor * u[dof] over the leaders, which may follow others in turn, or be fixed; resolve()
  /// resolves the chains. A dof that is tied twice keeps its first leaders.
  void tie(const Dof& follower, std::vector<Leader> leaders, std::vector<Offset> offsets = {});

  /// Adds resolved constraints of other points, which are counted from `first` here, without the motions of their
  /// supports. Before resolve().
  void add(const Constraints& others, std::uint32_t first);

  /// Replaces chains of ties by ties to free leaders. Call once, after the last fix and tie.
  void resolve();

  /// Shares resolved constraints of a plate and of the same points in their plane, which stand behind each other, as
  /// those of both are shared: ghosts of either are ghosts of both. Collective; does nothing where one process holds
  /// both.
  void share_stacked(const Constraints& plate, const Constraints& plane, std::size_t points);

  /// Ties free degrees of freedom after resolve(). What they follow moves with no support.
  void tie_more(std::vector<std::pair<Dof, std::vector<Leader>>> ties);

  /// Sets the ghosts, points that other ranks own: impose() fetches their values before anything follows them, fold()
  /// leaves no forces on them. After resolve(). `communicator` must outlive this.
  void share(const Communicator& communicator, std::vector<std::uint32_t> ghosts,
             std::shared_ptr<const HaloExchange> exchange);
  /// The ranks whose sums over degrees of freedom count.
  const Communicator& communicator() const { return *communicator_; }
  int rank() const;
  bool distributed() const;

  /// Returns these constraints, without the motions of their supports, with more fixed degrees of freedom.
  Constraints fixing(const std::vector<Dof>& more) const;

  /// Returns these constraints with another halo exchange, which fetches more ghosts.
  Constraints fetching(std::shared_ptr<const HaloExchange> exchange) const;

  const std::vector<Tie>& ties() const { return ties_; }  // ascending by follower
  const std::vector<Dof>& fixed() const { return fixed_; }
  bool held(const Dof& dof) const;
  const std::vector<Dof>& held() const { return held_; }  // fixed or tied, ascending
  /// Dirichlet lift: values of the held degrees of freedom under a unit motion of supports, with all free ones at rest
  /// [3 x points]; without columns where none of them moves.
  State lift(std::size_t motion, std::size_t points) const;
  /// Held values that are not zero; empty where none of them moves.
  std::vector<Leader> lifted(std::size_t motion) const;
  /// Forces on what is held, in that order, before they are carried over.
  Eigen::VectorXd on_held(const Forces& forces) const;
  Eigen::VectorXd on_held(const Values<float>& forces) const;

  /// Fetches the values of ghosts from their owners; does nothing where one process holds the plate.
  template <typename Real>
  void fetch(Values<Real>& values) const;
  void fetch(std::vector<std::int64_t>& numbers) const;  // of all points

  /// Imposes the constraints in two halves (Awaited), as impose() does. Between them ghosts have no values, nor have
  /// points that follow ghosts; progress() progresses the exchange.
  void begin_imposing(State& state) const;
  void progress() const;
  void end_imposing(State& state) const;
  /// Flags the points that lack values between begin_imposing() and end_imposing() [points]; empty where there are
  /// none.
  std::vector<char> pending(std::size_t points) const;

  void impose(State& state) const;  // u = P q
  void impose(Values<float>& state) const;
  void impose_absolute(State& state) const;  // u = |P| q
  void fold(Forces& forces) const;           // f = P^T f; zero at held dofs
  void fold(Values<float>& forces) const;
  void fold_absolute(Forces& forces) const;    // f = |P|^T f; zero at held dofs
  void fold_diagonal(Forces& diagonal) const;  // m = diag(P^T diag(m) P); zero at held dofs

private:
  struct Share {
    Dof from;
    double factor;
  };
  /// Shares that every target takes, so that targets can be treated at once.
  struct Sums {
    std::vector<Dof> target;
    std::vector<std::size_t> first{0};
    std::vector<Share> shares;
  };
  static Sums sums(const std::vector<Tie>& ties, bool by_leader);
  template <typename Real, typename Weight>
  void impose_own(Values<Real>& state, const Weight& weight) const;
  template <typename Real, typename Weight>
  void impose_pending(Values<Real>& state, const Weight& weight) const;
  template <typename Real, typename Weight>
  void impose_with(Values<Real>& state, const Weight& weight) const;
  template <typename Real, typename Weight>
  void fold_with(Values<Real>& forces, const Weight& weight) const;

  std::unordered_map<Dof, std::vector<Leader>> wanted_;              // until resolve()
  std::unordered_map<Dof, std::vector<Offset>> of_fixed_, of_ties_;  // until resolve()
  std::map<std::size_t, std::vector<Leader>> lifts_;                 // by motion: what is held and its value
  std::vector<Tie> ties_;
  std::vector<Dof> fixed_;
  std::vector<Dof> held_;          // sorted, by resolve()
  std::vector<Dof> zero_;          // held and follows none
  Sums followers_, leaders_;       // of resolve()
  std::vector<Dof> pending_zero_;  // of the zeros those of ghosts
  Sums pending_followers_;         // of the followers those that are ghosts, or follow some
  std::vector<std::uint32_t> copies_;
  const Communicator* communicator_ = &single_process();
  std::shared_ptr<const HaloExchange> exchange_;  // none where one process holds the plate
};

/// Resolved constraints of a plate and of the same points in their plane, which stand behind each other. Collective.
Constraints stacked(const Constraints& plate, const Constraints& plane, std::size_t points);

/// Halo exchange in progress: a state waits for the ghost values of points that other ranks own. As long as it lives,
/// the state must stay where it is.
class PendingExchange {
public:
  /// Begins to impose the constraints.
  PendingExchange(const Constraints& constraints, State& state) : constraints_(constraints), state_(state) {
    constraints_.begin_imposing(state_);
  }
  ~PendingExchange() { complete(); }
  PendingExchange(const PendingExchange&) = delete;
  PendingExchange& operator=(const PendingExchange&) = delete;

  /// Helps what is on its way along.
  void progress() const {
    if (pending_) constraints_.progress();
  }
  /// Waits. Afterwards the constraints are imposed.
  void complete() {
    if (std::exchange(pending_, false)) constraints_.end_imposing(state_);
  }

private:
  const Constraints& constraints_;
  State& state_;
  bool pending_ = true;
};

}  // namespace plate
