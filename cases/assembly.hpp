#pragma once
#include <chrono>
#include <utility>
#include "cases/case_file.hpp"
#include "fracture/precrack.hpp"
#include "plate/dynamics.hpp"
#include "plate/lattice_operator.hpp"
#include "plate/pieces.hpp"
#include "plate/position_aware.hpp"

namespace cases {

/// Seconds spent in the stages of a run, in order.
class Stopwatch {
public:
  /// Time since the last call (or construction) goes to `stage`.
  void lap(const std::string& stage);
  const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }
  double seconds(const std::string& stage) const;
  double total() const;

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> seconds_;
};

/// A case turned into points, bonds and loads: everything that a solver asks for, and nothing has been solved yet.
struct Assembly {
  std::vector<geometry::CrackPath> paths;  // [length]
  std::vector<geometry::Tip> tips;
  plate::Boundary boundary;
  std::vector<double> cut;  // per plate point: share of the family severed by cracks
  plate::LatticeOperator plate;
  std::optional<plate::MatchCounts> match;  // of the position-aware correction
  std::vector<plate::TimedLoad> loads;
  std::vector<std::string> warnings;
  bool may_move = false;  // parts that hang by bonds along one line may move without resistance

  std::size_t bonds() const;             // directed, between points of the plate
  std::size_t fictitious_bonds() const;  // directed, all others
};

/// Mass per degree of freedom, with the factor of the case for rotary inertia.
plate::Forces mass_of(const Case& c, const Assembly& assembly);

/// Throws CaseError where the plate is not held in statics, in whole or in a piece that cracks cut off, and where it has
/// fewer modes than frequencies are asked for.
Assembly assemble(const CaseFile& file, Stopwatch& stopwatch);

}  // namespace cases
