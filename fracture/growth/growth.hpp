#pragma once
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/outline.hpp"

namespace plate {
class Formulation;
struct Section;
}  // namespace plate

namespace fracture {

/// Growth of cracks: when, where to, and under what control (theory.md, "Growth").
struct Growth {
  /// Criterion for the growth of a crack.
  enum class Criterion {
    energy_release,  // the energy release rate of a tip
    bond_energy,     // the energy of every bond
    curvature_shear  // curvature and shear angle of every bond
  };
  /// Criterion for the direction in which a tip advances.
  enum class Direction {
    straight,           // on as it is
    tangential_moment,  // where the moment across the crack is largest: K2 = 0 on the new piece
    energy_release      // where the first piece of a kink releases most energy
  };
  /// Quantity that is held while a crack runs.
  enum class Control {
    load,          // the load factor, from 0 up to 1
    displacement,  // the displacement that the loads do work on, up to that of the full load before any growth
    equilibrium    // neither: the load follows, so that the crack is always just about to grow
  };

  /// Response to a quasi-static advance for which the present load is more than enough.
  enum class Unstable {
    jump,  // the crack jumps on to where it rests again
    stop,  // the growth ends
    move   // it ends, and motion begins
  };
  /// Treatment of pieces that detach in motion.
  enum class Detached { move, freeze };

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
  Detached detached = Detached::move;
  std::optional<double> apparent_toughness;                  // of a criterion for bonds, over the fracture energy
  std::optional<double> critical_curvature, critical_shear;  // of bonds [1/length], [-]
  std::vector<std::array<double, 4>> no_fail;  // rectangles in which tips stay: xmin, ymin, xmax, ymax [length]

  /// True where this is the largest length that was asked for.
  bool reached(double length) const { return max_length && length >= *max_length * (1 - 1e-9); }
  /// Energy taken over the fracture energy of new crack of this length [length]; none where there is none of either.
  std::optional<double> spent(double energy, double thickness, double length) const {
    return length > 0 && fracture_energy > 0 ? std::optional(energy / (fracture_energy * thickness * length))
                                             : std::nullopt;
  }
  /// True where bonds break one by one.
  bool by_bonds() const { return criterion != Criterion::energy_release; }

  /// True where a rectangle of no_fail holds this point.
  bool held(const geometry::Point& x) const {
    return std::any_of(no_fail.begin(), no_fail.end(), [&](const auto& box) {
      return x.x() >= box[0] && x.y() >= box[1] && x.x() <= box[2] && x.y() <= box[3];
    });
  }
};

/// Reason why a quasi-static growth ends.
enum class End {
  no_tip_left,    // every tip has reached an edge, a hole or a crack
  cannot_grow,    // nothing that could give way
  no_growth,      // the whole load, or the displacement at its end, was not enough from the start
  arrested,       // ... or is not enough any more
  most_advances,  // the largest number of advances that was asked for
  longest,        // the largest length of cracks that was asked for
  unstable,       // the next advance would be unstable, and growth must not jump
  not_resolved,   // the points do not tell which tip goes on, or in which direction
  split,          // a piece of the plate is not held any more
  interrupted,    // a signal asked for it
  failed          // the numbers failed
};

struct Ended {
  End how = End::failed;
  std::string detail = {};  // what is not resolved; of a split: what is not held; of a failure: what failed
};

/// Outcome of a growth in motion.
struct MovingGrowthOutcome {
  std::size_t advances = 0;                 // pieces of crack, or steps in which bonds broke
  std::size_t under_way = 0;                // pieces of crack that have begun and not ended
  std::optional<std::size_t> broken;        // bonds
  std::vector<std::string> reached;         // edges, holes and cracks by tips
  std::vector<std::string> stopped = {};    // tips whose direction is not resolved, and when
  std::vector<std::string> unsteady = {};   // tips that took another energy than that of a crack, and when
  bool direction_unknown = false;           // tips have gone straight on whose direction is not known
  std::size_t parts = 1, parts_before = 1;  // of the plate
  bool frozen = false;                      // pieces that fell off stay where they were
  std::optional<double> spent;              // energy taken over fracture energy and area of the new crack
  double largest_speed = 0;                 // of a tip [length/time]
  std::vector<double> lengths;              // of every crack [length]
};

/// Describes in words how a quasi-static growth ended. `by_bonds`: of bonds that break one by one.
std::string in_words(const Ended& ended, bool by_bonds);

/// Describes the outcome of a growth in motion.
std::string in_words(const MovingGrowthOutcome& outcome);

/// Warnings of a growth in bonds at this discretisation: cracks through points; of growth by single bonds where the
/// apparent toughness was not measured for it, and what bonds cannot do. Collective.
std::vector<std::string> warnings_about_bonds(const Growth& growth, const plate::Formulation& plate);

/// Tips that have too little about them for the energy release rate, which growth by tips needs, and why.
std::vector<std::string> tips_without_rings(const plate::Formulation& plate);

/// Warns where the energy spent per crack area is more than 5 % from the fracture energy: the speed of the tips is then
/// not that of a crack. `remedy`: what to set.
std::vector<std::string> warnings_about_spent_energy(const Growth& growth, const MovingGrowthOutcome& outcome,
                                                     const plate::Section& section, const std::string& remedy);

/// Tips in motion whose directions or energies are not resolved. `remedy`: what to set.
std::vector<std::string> warnings_about_directions(const MovingGrowthOutcome& outcome, const std::string& remedy);

}  // namespace fracture
