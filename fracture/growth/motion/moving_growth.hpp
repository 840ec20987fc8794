#pragma once
#include "fracture/growth/ended.hpp"
#include "fracture/growth/record.hpp"
#include "fracture/severing/fallen_pieces.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/archive_types.hpp"
#include "post/factors/srif.hpp"
#include "post/files/frame.hpp"

namespace fracture {

/// Cracks that grow while the plate moves: the plate whose bonds they sever, and what is recorded of them.
class MovingGrowth {
public:
  /// `start`: of a formulation whose bonds break. `factors`: where intensity factors are wanted. All references must
  /// outlive this.
  MovingGrowth(const Growth& growth, const plate::Formulation& start, std::optional<post::SrifOptions> factors,
               double rotary_inertia);
  virtual ~MovingGrowth() = default;

  const plate::Operator& plate() const { return plate_; }
  const plate::Constraints& constraints() const { return plate_.constraints(); }
  plate::Changes& changes();
  virtual double fracture_energy() const = 0;
  /// Kinetic energy of pieces that were frozen.
  double frozen_energy() const { return fallen_ ? fallen_->energy() : 0; }

  /// Looks at the cracks at a row of the history.
  virtual void look(double time) = 0;
  /// Factors of the tips where they are now, of those that this process has, by the methods that are wanted; none of
  /// tips beside edges and other cracks.
  std::vector<post::Srif> factors(const plate::State& state) const;
  /// The cells, cut along the cracks; sets the frame's resultants, damage and cracks. `factors`: of the tips.
  plate::Mesh draw(post::Frame& frame, const plate::State& state, const std::vector<post::Srif>& factors) {
    frame.cracks = record().cracks;
    post::set_factors(*frame.cracks, factors);
    return plate_.draw(frame, state, start_, cuts());
  }
  virtual const Record& record() = 0;
  virtual Moved moved() const = 0;

  /// All that goes on from here, between two steps.
  virtual void remember(plate::OutArchive& archive) const = 0;
  virtual void recall(plate::InArchive& archive) = 0;

protected:
  /// What both kinds remember of themselves.
  template <typename Archive, typename Self>
  static void memory(Archive& archive, Self& self) {
    archive(self.plate_, self.record_);
    if (self.fallen_) archive(*self.fallen_);
  }
  /// Tips by their number.
  using Tips = std::vector<std::pair<std::size_t, geometry::Tip>>;
  virtual plate::Changes& severing() = 0;
  virtual Tips tips() const = 0;
  virtual std::vector<geometry::CrackPath> paths() const = 0;
  /// Where the plate is parted.
  virtual std::vector<geometry::CrackPath> cuts() const { return paths(); }
  /// What both kinds have to say.
  Moved moved_so_far() const;

  const Growth& growth_;
  const plate::Formulation& start_;
  SeveredPlate plate_;
  Record record_;

private:
  std::optional<post::SrifOptions> options_;
  double rotary_inertia_;
  std::optional<FallenPieces> fallen_;
};

/// By the criterion.
std::unique_ptr<MovingGrowth> moving_growth(const Growth& growth, const plate::Formulation& start,
                                            std::optional<post::SrifOptions> factors, double rotary_inertia);

}  // namespace fracture
