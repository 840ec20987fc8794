#pragma once
#include "fracture/growth/motion/moving_cracks.hpp"
#include "fracture/growth/motion/moving_growth.hpp"

namespace fracture {

/// Tips that run where their energy release rate lets them.
class MovingTips : public MovingGrowth {
public:
  MovingTips(const Growth& growth, const plate::Formulation& start, std::optional<post::SrifOptions> factors,
             double rotary_inertia);

  double fracture_energy() const override { return cracks_.fracture_energy(); }
  void look(double) override {}
  const Record& record() override;
  Moved moved() const override;
  void remember(plate::OutArchive& archive) const override;
  void recall(plate::InArchive& archive) override;

private:
  plate::Changes& severing() override { return cracks_; }
  Tips tips() const override { return cracks_.tips(); }
  std::vector<geometry::CrackPath> paths() const override { return cracks_.paths(); }

  MovingCracks cracks_;
};

}  // namespace fracture
