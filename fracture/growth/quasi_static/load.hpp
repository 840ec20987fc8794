#pragma once
#include "fracture/growth/criteria.hpp"

namespace fracture {

/// Energy books of a growth [energy]. What is released beyond what the crack takes would be kinetic.
struct Ledger {
  double external_work = 0, strain = 0, fracture = 0;
  double released() const { return external_work - strain - fracture; }
};

/// The load of a static plate that is linear between two changes of it (theory.md, "Growth").
class QuasiStaticLoad {
public:
  explicit QuasiStaticLoad(Growth::Control control) : control_(control) {}

  struct Step {
    bool stable;  // no load that was there before would have been enough
    bool beyond;  // the whole load, or the displacement at its end, is not enough
  };
  /// Goes on to where the next change comes, as far as the control lets it. `whole`: what the whole load does work on
  /// now [energy]; `critical`: the load factor of the next change, infinite where none comes; `held`: what of `whole`
  /// supports that move have, which stay where they are while something gives way.
  Step to(double whole, double critical, double held = 0);

  double factor() const { return factor_; }
  double displacement() const { return displacement_; }
  /// Work and strain energy.
  Ledger ledger;

  template <typename Archive>
  void serialize(Archive& archive) {
    auto& [work, strain, fracture] = ledger;
    archive(first_, factor_, displacement_, held_, most_displacement_, work, strain, fracture);
  }

private:
  void go_to(double whole, double held, double factor);

  Growth::Control control_;
  bool first_ = true;
  double factor_ = 0, displacement_ = 0, held_ = 0, most_displacement_ = 0;
};

}  // namespace fracture
