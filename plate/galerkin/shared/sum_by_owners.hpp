#pragma once
#include "plate/model/ranks/ranks.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// Sums of what several processes have of points that one of them owns.
class SumByOwners {
public:
  /// `all` must outlive this.
  SumByOwners(const Ranks& all, std::vector<Copy> copies);

  /// Adds what copies have to the points that they are copies of, and leaves zero on them. All call it at once.
  void add(Forces& forces) const;

private:
  const Ranks& all_;
  std::vector<std::vector<std::uint32_t>> sent_;      // to every process: these copies
  std::vector<std::vector<std::uint32_t>> received_;  // from every process: of these own points
};

}  // namespace plate
