#pragma once
#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <span>
#include <vector>

namespace thread_ranks {

/// Where threads wait for what others send.
struct Post {
  std::mutex mutex;
  std::condition_variable come;
  bool gone = false;  // one of the threads has ended: nobody waits any more

  void leave() {
    const std::lock_guard lock(mutex);
    gone = true;
    come.notify_all();
  }
};

/// What threads send each other of one exchange: what is there for whoever comes for it, once all have come for what
/// was there before.
class Mail {
public:
  Mail(Post& post, std::size_t count)
      : post_(post), doubles_(count), floats_(count), sent_(count, 0), taken_(count, 0) {}

  template <typename Real>
  void put(std::size_t rank, std::span<Real> values) {
    std::unique_lock lock(post_.mutex);
    post_.come.wait(lock, [&] { return post_.gone || *std::ranges::min_element(taken_) >= sent_[rank]; });
    of<Real>()[rank].assign(values.begin(), values.end());
    ++sent_[rank];
    post_.come.notify_all();
  }

  /// Calls take(values of all).
  template <typename Real, typename Take>
  void take(std::size_t rank, const Take& take) {
    std::unique_lock lock(post_.mutex);
    post_.come.wait(lock, [&] { return post_.gone || *std::ranges::min_element(sent_) >= sent_[rank]; });
    if (!post_.gone) take(of<Real>());
    ++taken_[rank];
    post_.come.notify_all();
  }

private:
  template <typename Real>
  std::vector<std::vector<Real>>& of() {
    if constexpr (std::is_same_v<Real, float>)
      return floats_;
    else
      return doubles_;
  }

  Post& post_;
  std::vector<std::vector<double>> doubles_;
  std::vector<std::vector<float>> floats_;
  std::vector<std::size_t> sent_, taken_;  // how often, by rank
};

}  // namespace thread_ranks
