#pragma once
#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "geometry/shape/outline.hpp"

namespace fracture {

/// How cracks grow: when, where to, and under what control (theory.md, "Growth").
struct Growth {
  /// What decides that a crack grows.
  enum class Criterion {
    energy_release,  // the energy release rate of a tip
    bond_energy,     // the energy of every bond
    curvature_shear  // curvature and shear angle of every bond
  };
  /// Where a tip turns to.
  enum class Direction {
    straight,           // on as it is
    tangential_moment,  // where the moment across the crack is largest: K2 = 0 on the new piece
    energy_release      // where the first piece of a kink releases most energy
  };
  /// What is held while a crack runs.
  enum class Control {
    load,          // the load factor, from 0 up to 1
    displacement,  // the displacement that the loads do work on, up to that of the full load before any growth
    equilibrium    // neither: the load follows, so that the crack is always just about to grow
  };

  /// What comes of a quasi-static advance for which the load that is there is more than enough.
  enum class Unstable {
    jump,  // the crack jumps on to where it rests again
    stop,  // the growth ends
    move   // it ends, and motion begins
  };
  /// What comes of pieces that fall off in motion.
  enum class Fallen { move, freeze };

  Criterion criterion = Criterion::energy_release;
  double fracture_energy = 0;  // per area of crack [energy / length^2]
  Direction direction = Direction::tangential_moment;
  Control control = Control::load;
  double increment = 1;  // of a tip per advance [spacings]
  std::size_t max_advances = 100000;
  std::size_t frames_every = 10;     // advances
  std::optional<double> max_length;  // of any crack [length]
  bool tension_only = false;         // no growth of tips, no breaking of bonds, that close on the z > 0 face
  Unstable unstable = Unstable::jump;
  double duration = 0;  // of the motion [time]
  Fallen fallen = Fallen::move;
  std::optional<double> apparent_toughness;                  // of a criterion for bonds, over the fracture energy
  std::optional<double> critical_curvature, critical_shear;  // of bonds [1/length], [-]
  std::vector<std::array<double, 4>> no_fail;  // rectangles in which tips stay: xmin, ymin, xmax, ymax [length]

  /// Is this the largest length that was asked for?
  bool reached(double length) const { return max_length && length >= *max_length * (1 - 1e-9); }
  /// Energy taken over the fracture energy of new crack of this length [length]; none where there is none of either.
  std::optional<double> spent(double energy, double thickness, double length) const {
    return length > 0 && fracture_energy > 0 ? std::optional(energy / (fracture_energy * thickness * length))
                                             : std::nullopt;
  }
  /// Do bonds break one by one?
  bool by_bonds() const { return criterion != Criterion::energy_release; }

  /// Does a rectangle of no_fail hold this point?
  bool held(const geometry::Point& x) const {
    return std::any_of(no_fail.begin(), no_fail.end(), [&](const auto& box) {
      return x.x() >= box[0] && x.y() >= box[1] && x.x() <= box[2] && x.y() <= box[3];
    });
  }
};

}  // namespace fracture
