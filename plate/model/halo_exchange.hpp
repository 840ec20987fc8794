#pragma once
#include <span>

#include "plate/model/communicator.hpp"

namespace plate {

/// Halo exchange: fetches the values of ghosts from the ranks that own them. Collective: every rank must call it, in
/// the same order, from one thread.
class HaloExchange {
public:
  virtual ~HaloExchange() = default;

  /// Starts the exchange of `values` [components x points] of this rank, component by component, 1 or 3 of them: values
  /// of owned points that are ghosts elsewhere are taken as they are now, those of ghosts are undefined until finish().
  /// One at a time.
  virtual void start(std::span<double> values) const = 0;
  virtual void start(std::span<float> values) const = 0;
  /// Waits for the ghosts and stores their values.
  virtual void finish() const = 0;
  /// Helps what has begun along, where that goes on in calls only.
  virtual void progress() const {}

  template <typename Real>
  void fetch(std::span<Real> values) const {
    start(values);
    finish();
  }
  /// Numbers of points [points].
  void fetch(std::vector<std::int64_t>& numbers) const;
};

/// Traffic that a rank receives from others: ghost values of their points, and sums and maxima over all. Exchanges in
/// the libraries behind DistributedInverse are not counted.
struct Traffic {
  std::int64_t messages = 0, bytes = 0;  // of ghosts
  std::int64_t sums = 0;                 // calls
  double seconds = 0;                    // in all of these: packed, sent, and above all waited for

  Traffic& operator+=(const Traffic& other);
  Traffic operator-(const Traffic& before) const;
};

/// Processes, and what comes to this one: it calls them, which must outlive it, and counts.
class CountedCommunicator : public Communicator {
public:
  explicit CountedCommunicator(const Communicator& ranks) : ranks_(ranks) {}

  int rank() const override { return ranks_.rank(); }
  int size() const override { return ranks_.size(); }
  bool distributed() const override { return ranks_.distributed(); }
  void sum(std::span<std::int64_t> values) const override;
  void largest(std::span<double> values) const override;
  std::vector<std::string> exchanged(std::vector<std::string> texts) const override;
  std::unique_ptr<HaloExchange> halo_exchange(std::size_t points, const std::vector<Copy>& copies) const override;
  std::unique_ptr<DistributedInverse> inverse(const DistributedRows& rows) const override {
    return ranks_.inverse(rows);
  }
  DistributedEigenpairs largest_pairs(const DistributedProduct& product, std::span<const double> start,
                                      const EigenpairRequest& wanted) const override {
    return ranks_.largest_pairs(product, start, wanted);
  }
  const Traffic* traffic() const override { return &traffic_; }

private:
  const Communicator& ranks_;
  mutable Traffic traffic_;
};

}  // namespace plate
