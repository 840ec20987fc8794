#pragma once
#include "fracture/growth/bond_cracks.hpp"
#include "fracture/growth/bond_failure.hpp"
#include "fracture/growth/moving_cracks.hpp"
#include "fracture/growth/moving_growth.hpp"

namespace fracture {

/// Bonds that break while a plate moves (theory.md, "Bonds that break"). Called in every step.
class BreakingBonds : public plate::Changes {
public:
  /// Sees the bonds of a step that break; false: no more bonds break after them.
  using Observe = std::function<bool(const std::vector<LoadedBond>& bonds, double time)>;

  /// `plate` and `check` must outlive this.
  BreakingBonds(DamagedPlate& plate, BondCheck& check, Observe observe);

  void before_force(const plate::Step& now) override;
  void after_force(const plate::Step& now, const plate::Forces& force) override;

  /// Energy that bonds took with them so far.
  double fracture_energy() const { return spent_; }

  template <typename Archive>
  void save(Archive& archive) const {
    archive(check_.numbers(suspects_), suspected_, next_search_, ended_, spent_);
  }
  template <typename Archive>
  void load(Archive& archive) {
    std::vector<std::uint32_t> numbers;
    archive(numbers, suspected_, next_search_, ended_, spent_);
    suspects_ = check_.points(numbers);
  }

private:
  DamagedPlate& plate_;
  BondCheck& check_;
  Observe observe_;
  std::vector<std::uint32_t> suspects_;
  bool suspected_ = false;       // by any process
  std::size_t next_search_ = 0;  // step
  bool ended_ = false;
  double spent_ = 0;
};

/// Selects, from bonds by falling demand, those that may break at once: one for each family, and bonds loaded alike.
std::vector<LoadedBond> first_to_break(const std::vector<LoadedBond>& failing);

/// Bonds that break one by one while the plate moves.
class MovingBonds : public MovingGrowth {
public:
  MovingBonds(const Growth& growth, const plate::Formulation& start, std::optional<post::SrifOptions> factors,
              double rotary_inertia);

  double fracture_energy() const override { return bonds_.fracture_energy(); }
  void look(double time) override;
  const Record& record() override;
  MovingGrowthOutcome outcome() const override;
  void save(plate::OutArchive& archive) const override;
  void restore(plate::InArchive& archive) override;

private:
  plate::Changes& breakage() override { return bonds_; }
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

/// Tips that run where their energy release rate lets them.
class MovingTips : public MovingGrowth {
public:
  MovingTips(const Growth& growth, const plate::Formulation& start, std::optional<post::SrifOptions> factors,
             double rotary_inertia, const plate::Formulation* membrane = nullptr);

  double fracture_energy() const override { return cracks_.fracture_energy(); }
  void look(double) override {}
  const Record& record() override;
  MovingGrowthOutcome outcome() const override;
  void save(plate::OutArchive& archive) const override;
  void restore(plate::InArchive& archive) override;

private:
  plate::Changes& breakage() override { return cracks_; }
  Tips tips() const override { return cracks_.tips(); }
  std::vector<geometry::CrackPath> paths() const override { return cracks_.paths(); }

  MovingCracks cracks_;
};

}  // namespace fracture
