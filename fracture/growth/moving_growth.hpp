#pragma once
#include "fracture/breakage/detached_pieces.hpp"
#include "fracture/growth/bond_cracks.hpp"
#include "fracture/growth/bond_failure.hpp"
#include "fracture/growth/growth.hpp"
#include "fracture/growth/moving_cracks.hpp"
#include "fracture/growth/record.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/archive_types.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/factors/srif.hpp"
#include "post/files/frame.hpp"

namespace fracture {

/// Cracks that grow while the plate moves: the plate whose bonds they break, and what is recorded of them.
class MovingGrowth {
public:
  /// `start`: of a formulation whose bonds break. `factors`: where intensity factors are wanted. `membrane`: the same
  /// points in their plane, where loads act there: steps have stacked() states then. All references must outlive this.
  MovingGrowth(const Growth& growth, const plate::Formulation& start, std::optional<post::SrifOptions> factors,
               double rotary_inertia, const plate::Formulation* membrane = nullptr);
  virtual ~MovingGrowth() = default;

  const plate::Operator& plate() const { return plate_; }
  /// The plate in its plane; null where no loads act there.
  const DamagedPlate* plane() const { return plate_.plane(); }
  const plate::Constraints& constraints() const { return plate_.constraints(); }
  plate::Changes& changes();
  virtual double fracture_energy() const = 0;
  /// Kinetic energy of pieces that were frozen.
  double frozen_energy() const { return detached_pieces_ ? detached_pieces_->energy() : 0; }

  /// Looks at the cracks at a row of the history.
  virtual void look(double time) = 0;
  /// Factors of the tips where they are now, of those that this process has, by the methods that are wanted; none of
  /// tips beside edges and other cracks.
  std::vector<post::Srif> factors(const plate::State& state) const;
  /// Likewise of the plate in its plane: N1 and N2 as K1 and K2.
  std::vector<post::Srif> factors_in_plane(const plate::State& state) const;
  /// The cells, cut along the cracks; sets the frame's resultants, damage and cracks. `factors`: of the tips.
  plate::Mesh draw(post::Frame& frame, const plate::State& state, const std::vector<post::Srif>& factors) {
    frame.cracks = record().cracks;
    post::set_factors(*frame.cracks, factors);
    return plate_.draw(frame, state, start_, cuts());
  }
  virtual const Record& record() = 0;
  virtual MovingGrowthOutcome outcome() const = 0;

  /// Saves all that the growth needs to continue, between two steps.
  virtual void save(plate::OutArchive& archive) const = 0;
  virtual void restore(plate::InArchive& archive) = 0;

protected:
  /// Serialises the state that both kinds of growth have.
  template <typename Archive, typename Self>
  static void memory(Archive& archive, Self& self) {
    archive(self.plate_, self.record_);
    if (self.detached_pieces_) archive(*self.detached_pieces_);
  }
  /// Tips by their number.
  using Tips = std::vector<std::pair<std::size_t, geometry::Tip>>;
  virtual plate::Changes& breakage() = 0;
  virtual Tips tips() const = 0;
  virtual std::vector<geometry::CrackPath> paths() const = 0;
  /// Lines along which the plate is parted.
  virtual std::vector<geometry::CrackPath> cuts() const { return paths(); }
  /// Outcome so far, as far as both kinds of growth have it.
  MovingGrowthOutcome outcome_so_far() const;

  const Growth& growth_;
  const plate::Formulation& start_;
  DamagedPlate plate_;
  Record record_;

private:
  /// `start`, `plate`: before bonds broke and now.
  std::vector<post::Srif> factors(const plate::Formulation& start, const DamagedPlate& plate,
                                  const plate::State& state) const;

  const plate::Formulation* membrane_;
  std::optional<post::SrifOptions> options_;
  double rotary_inertia_;
  std::optional<DetachedPieces> detached_pieces_;
};

/// Constructs the growth that the criterion needs. `membrane`: of tips alone, single bonds take no loads in the plane.
std::unique_ptr<MovingGrowth> moving_growth(const Growth& growth, const plate::Formulation& start,
                                            std::optional<post::SrifOptions> factors, double rotary_inertia,
                                            const plate::Formulation* membrane = nullptr);

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
