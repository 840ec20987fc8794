#pragma once
#include <optional>

#include "geometry/crack_path.hpp"
#include "plate/boundary.hpp"
#include "plate/family_operator.hpp"
#include "plate/own_family.hpp"
#include "plate/section.hpp"

namespace fracture {

/// Families before and after bonds of theirs are severed, and how far that has gone.
struct Severing {
  std::size_t number;
  std::vector<plate::OwnFamily> before, after;  // of the same points
  double share = 0;                             // 0 before ... 1 after
};

/// A plate of bonds over a horizon whose bonds are severed while it moves: the plate as it was, and what has changed since
/// in the families that lost bonds. A severing goes gradually: U = (1 - share) U_before + share U_after. Position-aware
/// weights. One call at a time.
class SeveredPlate : public plate::Operator {
public:
  /// All must outlive this.
  SeveredPlate(const plate::FamilyOperator& base, const plate::Boundary& boundary, const plate::Section& section);

  std::size_t points() const override { return base_.points(); }
  void internal_force(const plate::State& state, plate::Forces& forces) const override;
  /// Of the plate as it was: time steps are found before anything is severed (and kept at 0.9 of the limit).
  void absolute_product(const plate::State& state, plate::Forces& forces) const override;
  plate::Forces diagonal() const override;

  /// Begins to sever the bonds that cross the crack's last piece, which is `piece` long at the end `at_back`. Returns a
  /// number; none, and nothing is done, where a severing that goes on has families of the same points.
  std::optional<std::size_t> sever(const geometry::CrackPath& path, bool at_back, double piece);
  /// Carries a severing on to a share; returns the energy that it takes, as central differences count it: mixed from
  /// this state and the one a step before (theory.md, "Growth in motion"). `velocity`: half a step before.
  double carry_on(std::size_t number, double share, const plate::State& state, const plate::State& velocity, double time_step);

  /// Families as they are after all severings.
  const geometry::Families& families() const { return families_; }
  std::size_t changed() const { return changed_.size(); }

private:
  struct Change {
    plate::OwnFamily base, now;
  };
  /// What a settled change does to the forces: one bond of its family.
  struct Difference {
    std::uint32_t neighbour;
    double mx, my, length;      // as in BondShape
    double D_base, D_now;
    double curvature, shear;    // 2 A times what B and S have gained
  };
  void settle(const plate::OwnFamily& now);
  bool is_going(std::uint32_t k) const;
  plate::OwnFamily base_family(std::uint32_t k) const;
  plate::OwnFamily family(std::uint32_t k) const;  // of families_, with weights matched to it

  const plate::FamilyOperator& base_;
  const plate::Boundary& boundary_;
  const plate::Section& section_;
  geometry::Families families_;
  double reach_ = 0;                            // of the longest bond [spacings]
  std::vector<Change> changed_;                 // settled
  std::vector<Difference> differences_;         // of every change, as many as its base has bonds
  std::vector<std::size_t> first_difference_{0};
  mutable std::vector<Eigen::Vector3d> given_;  // forces by difference: of the point and of its neighbour
  std::vector<std::int32_t> change_of_;         // per point: in changed_, -1
  std::vector<Severing> going_;
  std::size_t severings_ = 0;                   // so far
};

}  // namespace fracture
