#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "geometry/lattice/cloud.hpp"
#include "plate/model/space.hpp"

namespace plate {
struct Boundary;
}

namespace fracture {

/// A point of a plate, fictitious ones too, by what all ranks agree upon: the cell of the lattice, and which of the
/// fictitious points there it is, from 1; 0: the point of the plate.
using PointKey = std::array<std::int64_t, 3>;

/// Points that this rank knows, by their keys.
class PointKeys {
public:
  /// `boundary` must outlive this.
  explicit PointKeys(const plate::Boundary& boundary);

  PointKey of(std::uint32_t k) const;
  /// Local index of the point; nothing where this rank does not know it.
  std::optional<std::uint32_t> point(const PointKey& key) const;

private:
  const plate::Boundary& boundary_;
  geometry::CellIndex plate_;
  std::map<geometry::Cell, std::vector<std::uint32_t>> fictitious_;
};

/// A family that has lost bonds, as it is by now.
struct DamagedFamily {
  PointKey point{};
  std::uint64_t event = 0, place = 0;  // when it lost the first: in which breakage, and as which there
  double a = 0;
  unsigned left = 0;                    // Change::left
  std::optional<std::size_t> breakage;  // that goes on
  std::vector<char> broken = {};        // of every bond of the family at the start
  std::vector<double> weights = {};     // D, B, S of every bond

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(point, event, place, a, left, breakage, broken, weights);
  }
};

/// Checkpoint of the bond breakage of a plate, over all ranks.
struct BreakageCheckpoint {
  std::vector<DamagedFamily> families;
  std::vector<std::pair<std::size_t, double>> going;  // breakages that go on: number, share
  std::uint64_t events = 0;                           // breakages of both kinds so far
  std::size_t breakages = 0;                          // of pieces of cracks
  unsigned easing_left = 0;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(families, going, events, breakages, easing_left);
  }
};

/// A point with its state and its velocity half a step before.
struct SavedPoint {
  PointKey point{};
  std::array<double, plate::unknowns_per_point> state{}, velocity{};

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(point, state, velocity);
  }
};

}  // namespace fracture
