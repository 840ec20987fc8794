#pragma once
#include "fracture/breakage/damaged_plate.hpp"
#include "fracture/breakage/detached_pieces.hpp"
#include "fracture/growth/growth.hpp"
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

}  // namespace fracture
