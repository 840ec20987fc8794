#pragma once
#include <chrono>
#include <utility>
#include <variant>
#include "cases/input/case_file.hpp"
#include "fracture/severing/precrack.hpp"
#include "plate/galerkin/boundary.hpp"
#include "plate/galerkin/operator.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/bonds/lattice_operator.hpp"
#include "plate/solve/pieces.hpp"
#include "plate/bonds/parameters/position_aware.hpp"

namespace cases {

/// Seconds spent in the stages of a run, in order.
class Stopwatch {
public:
  /// Time since the last call (or construction) goes to `stage`.
  void lap(const std::string& stage);
  const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }
  /// Time spent in the stages of another watch.
  void add(const Stopwatch& other);
  double seconds(const std::string& stage) const;
  double total() const;

private:
  void add(const std::string& stage, double spent);

  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> seconds_;
};

/// The Galerkin plate and what its outputs need.
struct GalerkinPlate {
  geometry::Tessellation cells;
  plate::GalerkinOperator op;
  std::vector<geometry::Point> seen;      // geometry::seen_positions()
  std::vector<plate::BondShape> shapes;   // of the vectors of its families
};

/// A case turned into points, bonds and loads: everything that a solver asks for, and nothing has been solved yet.
struct Assembly {
  std::vector<geometry::CrackPath> paths;  // [length]
  std::vector<geometry::Tip> tips;
  plate::Boundary boundary;
  std::vector<double> cut;  // per plate point: share of the family severed by cracks
  std::variant<plate::LatticeOperator, GalerkinPlate> formulation;
  std::optional<plate::MatchCounts> match;  // of the position-aware correction
  std::vector<plate::TimedLoad> loads;
  std::vector<std::string> warnings;
  bool may_move = false;  // parts that hang by bonds along one line may move without resistance

  const plate::Operator& plate() const;
  /// nullptr where the plate is of the other formulation.
  const plate::LatticeOperator* ordinary() const { return std::get_if<plate::LatticeOperator>(&formulation); }
  const GalerkinPlate* galerkin() const { return std::get_if<GalerkinPlate>(&formulation); }
  const geometry::Families& families() const;
  double strain_energy(const plate::State& state) const;

  std::size_t bonds() const;             // directed, between points of the plate
  std::size_t fictitious_bonds() const;  // directed, all others
};

/// Mass per degree of freedom, with the factor of the case for rotary inertia.
plate::Forces mass_of(const Case& c, const Assembly& assembly);

/// Throws CaseError where the plate is not held in statics, in whole or in a piece that cracks cut off, and where it has
/// fewer modes than frequencies are asked for.
Assembly assemble(const CaseFile& file, Stopwatch& stopwatch);

}  // namespace cases
