#pragma once
#include <span>

namespace plate {

/// Fetches values of points that a process has copies of from the processes that own them. All processes call it at
/// once, in the same order, from one thread each.
class Exchange {
public:
  virtual ~Exchange() = default;

  /// Begins with `values` [components x points] of the process, component by component, 1 or 3 of them: those that
  /// others have copies of are taken as they are now, those of the copies are nobody's until finish(). One at a time.
  virtual void start(std::span<double> values) const = 0;
  virtual void start(std::span<float> values) const = 0;
  /// Waits for the copies, and puts them where they belong.
  virtual void finish() const = 0;
  /// Helps what has begun along, where that goes on in calls only.
  virtual void progress() const {}

  template <typename Real>
  void fetch(std::span<Real> values) const {
    start(values);
    finish();
  }
};

}  // namespace plate
