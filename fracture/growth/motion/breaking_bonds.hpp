#pragma once
#include "fracture/growth/bond_check.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace fracture {

/// Bonds that break while a plate moves (theory.md, "Bonds that break"). Called in every step.
class BreakingBonds : public plate::Changes {
public:
  /// Sees the bonds of a step that break; false: no more bonds break after them.
  using Observe = std::function<bool(const std::vector<LoadedBond>& bonds, double time)>;

  /// `plate` and `check` must outlive this.
  BreakingBonds(SeveredPlate& plate, BondCheck& check, Observe observe);

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
  SeveredPlate& plate_;
  BondCheck& check_;
  Observe observe_;
  std::vector<std::uint32_t> suspects_;
  bool suspected_ = false;       // by any process
  std::size_t next_search_ = 0;  // step
  bool ended_ = false;
  double spent_ = 0;
};

/// Of bonds by falling demand, those that may break at once: one for each family, and what is loaded alike.
std::vector<LoadedBond> first_to_break(const std::vector<LoadedBond>& failing);

}  // namespace fracture
