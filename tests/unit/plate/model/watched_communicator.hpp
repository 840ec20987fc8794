#pragma once
#include <functional>

#include "plate/model/halo_exchange.hpp"

namespace thread_ranks {

/// Is told of every exchange as it begins, and before it ends: of which values.
using Watch = std::function<void(std::span<const double> values, bool ends)>;

class WatchedHaloExchange : public plate::HaloExchange {
public:
  WatchedHaloExchange(std::unique_ptr<plate::HaloExchange> exchange, const Watch& watch)
      : exchange_(std::move(exchange)), watch_(watch) {}
  void start(std::span<double> values) const override {
    values_ = values;
    watch_(values_, false);
    exchange_->start(values);
  }
  void start(std::span<float> values) const override { exchange_->start(values); }
  void finish() const override {
    watch_(values_, true);
    exchange_->finish();
  }

private:
  std::unique_ptr<plate::HaloExchange> exchange_;
  const Watch& watch_;
  mutable std::span<const double> values_;
};

/// Processes of whose exchanges one is told.
class WatchedCommunicator : public plate::CountedCommunicator {
public:
  WatchedCommunicator(const plate::Communicator& ranks, Watch watch)
      : CountedCommunicator(ranks), watch_(std::move(watch)) {}
  std::unique_ptr<plate::HaloExchange> halo_exchange(std::size_t points,
                                                     const std::vector<plate::Copy>& copies) const override {
    return std::make_unique<WatchedHaloExchange>(CountedCommunicator::halo_exchange(points, copies), watch_);
  }

private:
  Watch watch_;
};

}  // namespace thread_ranks
