#pragma once
#include "fracture/severed_plate.hpp"
#include "plate/dynamics.hpp"

namespace fracture {

/// Keeps pieces of a moving plate where they are when they have fallen off (plate::fallen). Stands before what severs bonds.
class FallenPieces : public plate::Changes {
public:
  /// All must outlive this. `mass` per degree of freedom [3 x points].
  FallenPieces(plate::Changes& growth, const SeveredPlate& plate, const plate::Boundary& boundary, plate::Forces mass);

  void before_force(const plate::Moment& now) override;
  void after_force(const plate::Moment& now, const plate::Forces& force) override;

  /// Kinetic energy that they had.
  double energy() const { return energy_; }

private:
  void look(const plate::Moment& now);

  plate::Changes& growth_;
  const SeveredPlate& plate_;
  const plate::Boundary& boundary_;
  plate::Forces mass_;
  std::size_t broken_ = 0;  // bonds when it was last looked
  std::vector<std::uint32_t> points_;
  plate::State state_;      // of those points
  double energy_ = 0;
};

}  // namespace fracture
