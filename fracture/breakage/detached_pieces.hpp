#pragma once
#include "fracture/breakage/damaged_plate.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace fracture {

struct SavedPoint;
class PointKeys;

/// Freezes the detached pieces of a moving plate (plate::detached_points), at most 50 steps after they came off. Acts
/// before bonds break.
class DetachedPieces : public plate::Changes {
public:
  /// Constructs without pieces; all arguments must outlive this. `mass` per degree of freedom [3 x points].
  DetachedPieces(plate::Changes& growth, const DamagedPlate& plate, const plate::Boundary& boundary,
                 plate::Forces mass);

  void before_force(const plate::Step& now) override;
  void after_force(const plate::Step& now, const plate::Forces& force) override { growth_.after_force(now, force); }

  /// Kinetic energy that they had.
  double energy() const { return energy_; }

  /// Saves the state to continue from, of all ranks. Collective.
  void save(plate::OutArchive& archive) const;
  /// Restores the state; the plate must have restored its broken bonds before.
  void load(plate::InArchive& archive);

private:
  /// Points with their state, and their velocity half a step before.
  struct PointStates {
    std::vector<std::uint32_t> points;
    plate::State state, velocity;
  };
  std::vector<SavedPoint> of_all(const PointStates& states, const PointKeys& keys) const;
  static PointStates seen(const std::vector<SavedPoint>& states, const PointKeys& keys);
  void look(const plate::Step& now);
  void freeze(const plate::Step& now);

  plate::Changes& growth_;
  const DamagedPlate& plate_;
  const plate::Boundary& boundary_;
  plate::Forces mass_;
  std::size_t broken_ = 0;   // bonds when it was last looked
  bool any_fresh_ = false;   // of fresh_ some process has points
  bool any_frozen_ = false;  // and of frozen_
  PointStates fresh_;        // detached in the step before: frozen from there on
  PointStates frozen_;       // points ascending
  double energy_ = 0;
};

}  // namespace fracture
