#pragma once
#include "cases/driver/bond_cracks.hpp"
#include "cases/driver/moving_growth.hpp"
#include "fracture/growth/breaking_bonds.hpp"

namespace cases {

/// Bonds that break one by one while the plate moves.
class MovingBonds : public MovingGrowth {
public:
  MovingBonds(const CaseFile& file, const Assembly& assembly);

  double fracture_energy() const override { return bonds_.fracture_energy(); }
  /// growth.csv (bonds and lengths over time), tips.csv, cracks.csv, cracks.vtp.
  void write(const std::filesystem::path& folder, bool lines) const override;
  post::GrowthSummary summary() const override;

private:
  plate::Changes& severing() override { return bonds_; }
  bool broke(const std::vector<fracture::LoadedBond>& bonds, double time);
  void look(double time) override;
  Tips tips() const override { return cracks_.tips_of_cracks(); }
  std::vector<geometry::CrackPath> paths() const override { return cracks_.paths(); }

  fracture::BondLimits limits_;
  fracture::BondCheck check_;
  BondCracks cracks_;
  fracture::BreakingBonds bonds_;
  post::Table growth_;
  std::size_t advances_ = 0;  // steps in which bonds broke
  double largest_speed_ = 0;
};

}  // namespace cases
