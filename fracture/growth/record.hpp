#pragma once
#include <optional>

#include "fracture/growth/growth.hpp"
#include "post/files/frame.hpp"
#include "post/files/table.hpp"

namespace plate {
struct Problem;
}

namespace fracture {

/// Energy terms of a growth [energy]. What is released beyond what the crack takes would be kinetic.
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
  /// Advances to the next change, as far as the control permits. `whole`: what the whole load does work on now
  /// [energy]; `critical`: the load factor of the next change, infinite where none comes; `held`: the part of `whole`
  /// of supports that move, which stay where they are while bonds break or tips advance.
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

/// A row of growth.csv: one advance, whatever grew. What does not exist in a growth stays empty.
struct GrowthRow {
  double advance = 0;
  std::optional<double> time = {};                                                                    // in motion
  std::optional<double> load_factor = {}, displacement = {}, critical_load_factor = {}, stable = {};  // quasi-static
  double crack_length = 0;  // of all cracks [length]
  std::size_t tips = 0;
  std::optional<double> broken_bonds = {};
  std::optional<double> external_work = {}, strain_energy = {};
  double fracture_energy = 0;
  std::optional<double> released_energy = {};
  std::optional<double> critical_load_factor_error = {};  // quasi-static by tips: estimated, relative
};

/// A row of tips.csv: a tip at an advance.
struct TipRow {
  double advance = 0;
  std::optional<double> time = {};
  double tip = 0;  // its number
  std::optional<double> crack = {};
  double x = 0, y = 0, angle = 0;                                       // where it is and points to [length, degrees]
  std::optional<double> length = {};                                    // of its crack [length]
  std::optional<double> moves = {}, G = {}, K1 = {}, K2 = {}, K3 = {};  // quasi-static
  std::optional<double> N1 = {}, N2 = {};                               // where loads act in the plane
  std::string face = {};                                                // of the plate, whose stress turns the tip
  std::optional<double> begin = {}, piece = {}, speed = {},
                        spent = {};  // in motion: of the piece of crack that it has gone
  std::string reached = {};          // an edge, a hole or a crack
};

/// Output of a growth: growth.csv, tips.csv, cracks.csv and cracks.vtp.
struct Record {
  Record();
  void add(const GrowthRow& row);
  void add(const TipRow& row);
  /// Gives tips the columns of loads in the plane, before their first row.
  void acts_in_plane();

  post::Table growth, tips;
  post::Cracks cracks;  // with the advance, or in motion the time, at which every vertex was reached
  bool in_motion = false;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(growth, tips, cracks, in_motion);
  }

  /// The vertices of all cracks.
  post::Table crack_table() const;
  /// Places of loads and supports that cracks run through.
  std::vector<std::string> cut_places(const plate::Problem& problem) const;
};

}  // namespace fracture
