#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "plate/bonds/family_operator.hpp"
#include "plate/bonds/family_weights.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/solve/archive_types.hpp"

namespace plate {
class Formulation;
class TipView;
struct Mesh;
struct Resultants;
struct Surroundings;
}  // namespace plate

namespace post {
struct Frame;
}

namespace fracture {

/// Bonds that have broken, one bit for each directed bond of the points that lost any. Points that did are numbered in
/// the order of their first loss.
class BrokenBonds {
public:
  /// `longest`: bonds of the largest family.
  BrokenBonds(std::size_t points, std::size_t longest) : words_per_point_((longest + 63) / 64), number_(points, -1) {}

  /// Number of a point; -1: all its bonds are intact.
  std::int32_t number(std::size_t k) const { return number_[k]; }
  std::size_t points() const { return words_per_point_ == 0 ? 0 : words_.size() / words_per_point_; }

  /// The i-th bond of point k.
  bool broken(std::size_t k, std::size_t i) const { return number_[k] >= 0 && (words_[word(k, i)] >> (i % 64) & 1); }
  void set(std::size_t k, std::size_t i) {
    if (number_[k] < 0) {
      number_[k] = std::int32_t(points());
      words_.resize(words_.size() + words_per_point_, 0);
    }
    words_[word(k, i)] |= std::uint64_t(1) << (i % 64);
  }

  /// Directed bonds.
  std::size_t count() const {
    std::size_t sum = 0;
    for (const auto word : words_) sum += std::size_t(std::popcount(word));
    return sum;
  }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(number_, words_);
  }

private:
  std::size_t word(std::size_t k, std::size_t i) const { return std::size_t(number_[k]) * words_per_point_ + i / 64; }

  std::size_t words_per_point_;
  std::vector<std::int32_t> number_;
  std::vector<std::uint64_t> words_;
};

/// A family that lost bonds, with all bonds of its base; the weights of broken ones go to zero.
struct Change {
  plate::OwnFamily now;
  std::vector<plate::BondWeights> target;
  double a_target;
  unsigned left = 0;     // steps to the target, of single bonds
  bool ongoing = false;  // by a piece of crack that goes on
};

/// Contribution of a changed family to the forces: one bond of the family.
struct Difference {
  std::uint32_t neighbour;
  double mx, my, length;  // as in BondShape
  double D_base, D_now;
  double curvature, shear;  // 2 A times what B and S have gained
};

/// Upper bounds of the stiffness of families that have lost bonds, and of their bonds.
struct Stiffest {
  double bending = 0, shear = 0;
  std::vector<plate::BondWeights> bonds;  // B and S by bond vector; infinite for those of no full family
};

/// Stiffness of a family's bonds against rotations (bending) and deflections (shear) of its point alone, divided by its
/// area.
double bending_stiffness(double a, std::span<const plate::BondWeights> bonds);
double shear_stiffness(std::span<const plate::BondWeights> bonds);

/// Computes the bounds from the first full family of the plate, on whichever rank it is.
Stiffest stiffest(const plate::FamilyOperator& plate, const plate::Boundary& boundary);

/// A bond between two points, the lower number first.
using PointPair = std::array<std::uint32_t, 2>;
/// A bond of which this rank does not know both ends.
constexpr PointPair outside_overlap{std::uint32_t(-1), std::uint32_t(-1)};

/// A state, and what it was a step before: state - time_step velocity.
struct Motion {
  const plate::State& state;
  const plate::State& velocity;  // half a step before
  double time_step;              // 0: quasi-static
};

/// The last piece of a crack at one of its ends.
struct CrackPiece {
  geometry::CrackPath path;
  bool at_back;
  double length;
};

/// A plate of bonds over a horizon whose bonds break while it is loaded: the plate as it was, and what has changed
/// since in the families that lost bonds. Each goes over to the weights that its surface correction gives to the bonds
/// left, at once or step by step. A family with few bonds left would ask for shorter time steps: none gets stiffer than
/// beside a clean crack, and what has less than two fifths of its bonds gives way in proportion. One call at a time.
/// Where loads act in its plane, pieces of cracks break the same bonds there: plane(). A motion is then one of
/// stacked() states; forces, views and drawings are of this plate alone.
class DamagedPlate : public plate::Operator {
public:
  /// Constructs the undamaged plate; all arguments but the rule must outlive this. `seen`: in a distributed plate, the
  /// points that this rank knows beside its owned points: a horizon about all that these see, and about tips what their
  /// factors need.
  DamagedPlate(const plate::FamilyOperator& base, const plate::Boundary& boundary, const plate::FamilyRule& rule,
               std::shared_ptr<const plate::Surroundings> seen = {});
  /// `start`: of a formulation whose bonds break; `membrane`: the same points in their plane (PlateLaw::membrane), by
  /// one process; null: no loads act there. Both must outlive this.
  DamagedPlate(const plate::Formulation& start, const plate::Formulation* membrane,
               std::shared_ptr<const plate::Surroundings> seen);

  std::size_t points() const override { return base_.points(); }
  void internal_force(const plate::State& state, plate::Forces& forces) const override;
  /// Absolute product and diagonal of the undamaged plate: time steps are found before any bond is broken (and kept at
  /// 0.9 of the limit).
  void absolute_product(const plate::State& state, plate::Forces& forces) const override {
    base_.absolute_product(state, forces);
  }
  plate::Forces diagonal() const override { return base_.diagonal(); }

  /// Points in their plane; null where no loads act there.
  const DamagedPlate* plane() const { return plane_.get(); }

  /// Constraints of the boundary; where the plate is distributed, they fetch the values of all points that this rank
  /// knows.
  const plate::Constraints& constraints() const { return wider_ ? *wider_ : boundary_.constraints; }
  /// Norm of forces on the free degrees of freedom, weighted by a diagonal that has been carried over to these.
  double norm(plate::Forces force, const plate::Forces& diagonal) const;
  /// True where this rank owns the place.
  bool here(const geometry::Point& x) const { return boundary_.here(x); }

  /// Begins to break the bonds that cross these pieces. Pieces with families of the same points are one breakage.
  /// Returns the number of the breakage of each piece; none, and nothing is done for it, where one that goes on has
  /// families of the same points.
  std::vector<std::optional<std::size_t>> break_bonds(const std::vector<CrackPiece>& pieces);
  /// Carries a breakage on to a share from 0 to 1; returns the energy that it takes, as central differences count it:
  /// mixed from the state and the one a step before (theory.md, "Growth").
  double carry_on(std::size_t number, double share, const Motion& motion);

  /// Breaks bonds, in the same order in all processes; the families of their ends need `steps` calls of carry_on_all to
  /// go over.
  void break_bonds(const std::vector<PointPair>& bonds, unsigned steps);
  /// Collective: true where families lose single bonds on any rank.
  bool easing() const { return easing_left_ > 0; }
  /// Carries the families that lose single bonds on by a step; returns the energy that this takes.
  double carry_on_all(const Motion& motion);

  /// Moments and shear forces, or membrane forces, of every point of the plate.
  plate::Resultants resultants(const plate::State& state) const;
  /// View of the plate for the tips of its cracks in its present state. This must outlive it.
  std::shared_ptr<const plate::TipView> tip_view() const;
  /// The cells, cut along the cracks; sets the frame's resultants and damage. `start`: the plate before.
  plate::Mesh draw(post::Frame& frame, const plate::State& state, const plate::Formulation& start,
                   const std::vector<geometry::CrackPath>& cracks) const;
  /// Families without the bonds that have broken so far.
  const geometry::Families& families() const { return families_; }
  const plate::FamilyOperator& base() const { return base_; }
  const plate::PointMap& map() const { return boundary_.map; }
  const BrokenBonds& broken() const { return broken_; }
  /// Factor of the dilatation [force length] and weights of the i-th bond of the base's family, as they are now.
  double a(std::size_t k) const;
  const plate::BondWeights& weights(std::size_t k, std::size_t i) const;

  /// Saves the broken bonds and their present weights, from all ranks. Collective.
  void save(plate::OutArchive& archive) const;
  /// Restores them into a plate in which no bond has been broken yet.
  void load(plate::InArchive& archive);

private:
  struct OngoingBreakage {
    std::size_t number;
    std::vector<std::uint32_t> points;
    double share = 0;
  };
  /// Bonds that a piece of crack cuts: point and number in its family; and these points, ascending.
  struct CutBonds {
    std::vector<std::pair<std::uint32_t, std::size_t>> bonds;
    std::vector<std::uint32_t> points;
  };
  /// Breakage in which a point lost its first bond, and its position there.
  struct FirstLoss {
    std::uint64_t event, place;
  };
  CutBonds cut_by(const CrackPiece& piece) const;
  std::vector<std::array<std::size_t, 2>> sharing(const std::vector<CutBonds>& cuts) const;
  std::vector<CutBonds> cuts_by(const std::vector<CrackPiece>& pieces) const;
  std::size_t begin_breakage(CutBonds cut);
  void lose(std::uint32_t k, std::size_t i, std::uint64_t place);
  Change& change(std::uint32_t k);
  /// The families without their broken bonds, and where they go.
  void retarget(std::uint32_t k);
  bool known(std::size_t k) const { return known_.empty() || known_[k]; }
  /// Sum of the values of these points over all ranks, each of which counts the points that it owns.
  double sum_of_all(const std::vector<std::uint32_t>& points, const std::vector<double>& values) const;
  void soften(plate::FamilyWeights& family, double left, const std::vector<std::uint32_t>& ids) const;
  double approach(std::uint32_t k, double fraction, const Motion& motion);
  /// Sets the differences of a change, by its number, to what its weights are now.
  void differ(std::size_t number);

  const plate::FamilyOperator& base_;
  const plate::Boundary& boundary_;
  plate::FamilyRule rule_;
  std::unique_ptr<DamagedPlate> plane_;
  std::vector<char> known_;                  // points whose families are followed; empty: all
  std::optional<plate::Constraints> wider_;  // where the plate is distributed
  geometry::Families families_;
  double reach_ = 0;  // of the longest bond [spacings]
  Stiffest stiffest_;
  BrokenBonds broken_;
  std::vector<FirstLoss> first_losses_;  // by number
  std::vector<Change> changed_;          // by number
  std::vector<Difference> differences_;  // of every change, as many as its base has bonds
  std::vector<std::size_t> first_difference_{0};
  /// Force and couple along m that a change gives to its point, and that every difference gives to its neighbour.
  mutable std::vector<plate::PointValues> own_force_;
  mutable std::vector<std::array<double, 2>> given_;
  std::vector<OngoingBreakage> going_;
  std::vector<std::uint32_t> easing_;  // points that lose single bonds, ascending
  unsigned easing_left_ = 0;           // steps until no process has any
  std::size_t breakages_ = 0;          // so far, of pieces of cracks
  std::uint64_t events_ = 0;           // and of bonds
};

}  // namespace fracture
