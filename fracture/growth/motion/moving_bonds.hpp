#pragma once
#include "fracture/growth/bond_cracks.hpp"
#include "fracture/growth/motion/breaking_bonds.hpp"
#include "fracture/growth/motion/moving_growth.hpp"

namespace fracture {

/// Bonds that break one by one while the plate moves.
class MovingBonds : public MovingGrowth {
public:
  MovingBonds(const Growth& growth, const plate::Formulation& start, std::optional<post::SrifOptions> factors,
              double rotary_inertia);

  double fracture_energy() const override { return bonds_.fracture_energy(); }
  void look(double time) override;
  const Record& record() override;
  Moved moved() const override;
  void remember(plate::OutArchive& archive) const override;
  void recall(plate::InArchive& archive) override;

private:
  plate::Changes& severing() override { return bonds_; }
  bool broke(const std::vector<LoadedBond>& bonds, double time);
  Tips tips() const override { return cracks_.tips_of_cracks(); }
  std::vector<geometry::CrackPath> paths() const override { return cracks_.paths(); }
  std::vector<geometry::CrackPath> cuts() const override { return cracks_.cuts(); }

  BondLimits limits_;
  BondCheck check_;
  BondCracks cracks_;
  BreakingBonds bonds_;
  std::size_t advances_ = 0;  // steps in which bonds broke
  double largest_speed_ = 0;
};

}  // namespace fracture
