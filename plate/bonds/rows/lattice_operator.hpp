#pragma once
#include <omp.h>
#include <cstdint>
#include <vector>

#include "plate/bonds/rows/gathered_points.hpp"

namespace plate {

class PendingExchange;

/// Numbered pieces of work, which the threads of a team share out by the time that they take, always in the same way.
class Tasks {
public:
  void add(std::size_t number, double time) {
    number_.push_back(std::uint32_t(number));
    until_.push_back((until_.empty() ? 0 : until_.back()) + time);
  }

  /// Calls visit(number) for the share of the thread in hand.
  template <typename Visit>
  void for_share(const Visit& visit) const {
    const int thread = omp_get_thread_num(), threads = omp_get_num_threads();
    for (std::size_t i = begin(thread, threads), end = begin(thread + 1, threads); i < end; ++i) visit(number_[i]);
  }

  /// Index where the share of a thread begins; for the thread after the last, the end.
  std::size_t begin(int thread, int threads) const;
  std::size_t size() const { return number_.size(); }
  std::size_t bytes() const { return number_.size() * (sizeof(std::uint32_t) + sizeof(double)); }

private:
  std::vector<std::uint32_t> number_;
  std::vector<double> until_;  // time of all up to every one
};

/// The forces of a FamilyOperator in the number `Real`, for many points at once. Points that follow each other and
/// share a pattern of bonds are rows. Points one above the other that look alike, but not to the numbering, are
/// gathered into rows with what they see. The rest goes in packets. Where a process holds a part of the plate, rows
/// that see nothing of others go on while dilatations are exchanged, and before the rest of a state is there. Any
/// number of threads gives the same bits. One call at a time.
template <typename Real>
class LatticeRows {
public:
  explicit LatticeRows(const FamilyOperator& plate);

  /// `rest`: of the state, where that may be on its way; complete afterwards.
  void internal_force(const Values<Real>& state, Values<Real>& forces, PendingExchange* rest = nullptr) const;

  double row_share() const { return row_share_; }        // of the points: in rows of their own
  double folded_share() const { return folded_share_; }  // of the points: in rows that are folded
  double packet_share() const { return packet_share_; }  // of the points: in packets
  std::size_t bytes() const;

private:
  static constexpr std::size_t lanes = Lane<Real>::size();  // points
  static constexpr std::size_t pitch = 192;                 // of gathered rows
  static constexpr std::uint32_t farthest = 16;             // spacings that a gathered row sees

  struct Row {
    std::uint32_t first, length, pattern;
    bool waits;  // sees points of other processes, or what follows these
  };
  /// A PointColumn.
  struct GatheredRow {
    std::uint32_t length, pattern, reach;
    std::size_t first_point, first_source;  // in gathered_points_ and sources_
    bool waits;
  };
  struct Scratch;

  std::vector<std::uint32_t> add_rows(const geometry::FamilyRuns& runs, const Patterns& patterns, double spacing,
                                      const OperatedPart& part);
  void add_columns(const Patterns& patterns, const std::vector<std::uint32_t>& points,
                   const std::vector<std::uint32_t>& pattern_of, double spacing, const OperatedPart& part);
  void select_wanted(const std::vector<char>& wanted);
  void share_out();

  void row_dilatation(const Row& row, const Fields<Real>& in, Real* q) const;
  void row_force(const Row& row, const Fields<Real>& in, const ForceFields<Real>& out) const;
  Row gather_row(const GatheredRow& row, const Fields<Real>& in, bool all, Scratch& scratch) const;
  void gathered_dilatation(const GatheredRow& row, const Fields<Real>& in, Scratch& scratch) const;
  void gathered_force(const GatheredRow& row, const Fields<Real>& in, const ForceFields<Real>& out,
                      Scratch& scratch) const;
  template <typename OnRow, typename OnGathered, typename OnPacket>
  void for_share(const Tasks& tasks, const OnRow& row, const OnGathered& gathered, const OnPacket& packet) const;

  std::vector<RowPattern<Real>> patterns_;
  std::vector<Row> rows_;
  std::vector<GatheredRow> gathered_;
  std::vector<std::uint32_t> gathered_points_, sources_;
  Packets<Real> packets_;
  std::size_t waiting_packets_ = 0;                  // the first of them
  Tasks inside_, waiting_;                           // rows, gathered rows and packets, numbered in this order
  std::size_t field_size_ = 0;                       // of Scratch
  std::shared_ptr<const HaloExchange> exchange_;     // of q_, where a process holds a part of the plate only
  mutable Eigen::Array<Real, Eigen::Dynamic, 1> q_;  // by point, of the state in hand: 2 A a theta
  double row_share_ = 0, folded_share_ = 0, packet_share_ = 0;
};

extern template class LatticeRows<double>;
extern template class LatticeRows<float>;

/// FamilyOperator of a plate on the lattice whose forces are those of LatticeRows, in double or single precision. One
/// call at a time.
class LatticeOperator : public FamilyOperator {
public:
  explicit LatticeOperator(FamilyOperator plate) : FamilyOperator(std::move(plate)), rows_(*this) {}

  void internal_force(const State& state, Forces& forces) const override {
    rows_.internal_force(state, forces);
    elastic_supports().add_force(state, forces);
  }
  void internal_force_overlapped(const State& state, PendingExchange& rest, Forces& forces) const override {
    rows_.internal_force(state, forces, &rest);
    elastic_supports().add_force(state, forces);
  }

  const LatticeRows<double>& rows() const { return rows_; }
  LatticeRows<float> single_rows() const { return LatticeRows<float>(*this); }

private:
  LatticeRows<double> rows_;
};

}  // namespace plate
