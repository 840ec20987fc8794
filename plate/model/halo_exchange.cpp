#include "plate/model/halo_exchange.hpp"

#include <chrono>
#include <cstring>
#include <set>

namespace plate {
namespace {

/// Adds the time of a scope.
class Timed {
public:
  explicit Timed(Traffic& traffic) : traffic_(traffic) {}
  ~Timed() { traffic_.seconds += std::chrono::duration<double>(Clock::now() - begin_).count(); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

private:
  using Clock = std::chrono::steady_clock;
  Traffic& traffic_;
  Clock::time_point begin_ = Clock::now();
};

class CountedHaloExchange : public HaloExchange {
public:
  CountedHaloExchange(std::unique_ptr<HaloExchange> exchange, std::size_t points, const std::vector<Copy>& copies,
                      Traffic& traffic)
      : exchange_(std::move(exchange)), points_(points), copies_(std::int64_t(copies.size())), traffic_(traffic) {
    std::set<int> owners;
    for (const auto& copy : copies) owners.insert(copy.owner);
    owners_ = std::int64_t(owners.size());
  }
  void start(std::span<double> values) const override { counted(values); }
  void start(std::span<float> values) const override { counted(values); }
  void finish() const override {
    const Timed timed(traffic_);
    exchange_->finish();
  }
  void progress() const override {
    const Timed timed(traffic_);
    exchange_->progress();
  }

private:
  template <typename Real>
  void counted(std::span<Real> values) const {
    const Timed timed(traffic_);
    traffic_.messages += owners_;
    if (points_ > 0) traffic_.bytes += copies_ * std::int64_t(values.size() / points_ * sizeof(Real));
    exchange_->start(values);
  }

  std::unique_ptr<HaloExchange> exchange_;
  std::size_t points_;
  std::int64_t copies_, owners_ = 0;
  Traffic& traffic_;
};

}  // namespace

/// Fetches integers as the bits of numbers of the same size.
void HaloExchange::fetch(std::vector<std::int64_t>& numbers) const {
  std::vector<double> bits(numbers.size());
  std::memcpy(bits.data(), numbers.data(), numbers.size() * sizeof(double));
  fetch(std::span(bits));
  std::memcpy(numbers.data(), bits.data(), numbers.size() * sizeof(double));
}

Traffic& Traffic::operator+=(const Traffic& other) {
  messages += other.messages, bytes += other.bytes, sums += other.sums, seconds += other.seconds;
  return *this;
}

Traffic Traffic::operator-(const Traffic& before) const {
  return {messages - before.messages, bytes - before.bytes, sums - before.sums, seconds - before.seconds};
}

void CountedCommunicator::sum(std::span<std::int64_t> values) const {
  const Timed timed(traffic_);
  ++traffic_.sums;
  ranks_.sum(values);
}

void CountedCommunicator::largest(std::span<double> values) const {
  const Timed timed(traffic_);
  ++traffic_.sums;
  ranks_.largest(values);
}

std::vector<std::string> CountedCommunicator::exchanged(std::vector<std::string> texts) const {
  const Timed timed(traffic_);
  return ranks_.exchanged(std::move(texts));
}

std::unique_ptr<HaloExchange> CountedCommunicator::halo_exchange(std::size_t points,
                                                                 const std::vector<Copy>& copies) const {
  return std::make_unique<CountedHaloExchange>(ranks_.halo_exchange(points, copies), points, copies, traffic_);
}

}  // namespace plate
