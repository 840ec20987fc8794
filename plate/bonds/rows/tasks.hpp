#pragma once
#include <omp.h>

#include <cstdint>
#include <vector>

namespace plate {

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

  /// Where the share of a thread begins; of the one after the last, their end.
  std::size_t begin(int thread, int threads) const;
  std::size_t size() const { return number_.size(); }
  std::size_t bytes() const { return number_.size() * (sizeof(std::uint32_t) + sizeof(double)); }

private:
  std::vector<std::uint32_t> number_;
  std::vector<double> until_;  // time of all up to every one
};

}  // namespace plate
