#pragma once
#include "cases/driver/moving_growth.hpp"
#include "fracture/growth/moving_cracks.hpp"

namespace cases {

/// Tips that run where their energy release rate lets them.
class MovingTips : public MovingGrowth {
public:
  MovingTips(const CaseFile& file, const Assembly& assembly);

  double fracture_energy() const override { return cracks_.fracture_energy(); }
  void write(const std::filesystem::path& folder, bool lines) const override;
  post::GrowthSummary summary() const override;

private:
  plate::Changes& severing() override { return cracks_; }
  void look(double) override {}
  Tips tips() const override { return cracks_.tips(); }
  std::vector<geometry::CrackPath> paths() const override { return cracks_.paths(); }
  fracture::Gauge gauge(const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip) const;

  fracture::MovingCracks cracks_;
};

}  // namespace cases
