#pragma once
#include "fracture/severing/severed_plate.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace fracture {

/// Keeps pieces of a moving plate where they are when they are seen to have fallen off (plate::fallen), at most 50
/// steps after it. Stands before what severs bonds.
class FallenPieces : public plate::Changes {
public:
  /// All must outlive this. `mass` per degree of freedom [3 x points].
  FallenPieces(plate::Changes& growth, const SeveredPlate& plate, const plate::Boundary& boundary, plate::Forces mass);

  void before_force(const plate::Step& now) override;
  void after_force(const plate::Step& now, const plate::Forces& force) override;

  /// Kinetic energy that they had.
  double energy() const { return energy_; }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(broken_, falls_, fallen_, fresh_, frozen_, energy_);
  }

private:
  /// Points with their state, and their velocity half a step before.
  struct Kept {
    std::vector<std::uint32_t> points;
    plate::State state, velocity;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(points, state, velocity);
    }
  };
  void look(const plate::Step& now);
  void freeze(const plate::Step& now);

  plate::Changes& growth_;
  const SeveredPlate& plate_;
  const plate::Boundary& boundary_;
  plate::Forces mass_;
  std::size_t broken_ = 0;  // bonds when it was last looked
  bool falls_ = false;      // of fresh_ some process has points
  bool fallen_ = false;     // and of frozen_
  Kept fresh_;              // seen in the step before: frozen from there on
  Kept frozen_;             // points ascending
  double energy_ = 0;
};

}  // namespace fracture
