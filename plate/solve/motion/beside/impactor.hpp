#pragma once
#include <cstdint>
#include <utility>
#include <vector>

namespace plate {

/// A mass that meets the plate at time 0 at a place of it, and presses on it by a spring that does not pull.
struct Impactor {
  std::vector<std::pair<std::uint32_t, double>> shares;  // of the points about the place, as far as they are seen
  double mass = 0;                                       // [mass]
  double velocity = 0;                                   // along w [length/time]; its sign tells the side
  double stiffness = 0;                                  // of the contact [force/length]
  std::vector<char> own = {};                            // of the shares: no other process has the point; empty: all
};

/// Where the mass is: along w, and half a step before how fast; how it has pressed so far.
struct Striker {
  double place = 0, velocity = 0;
  double largest = 0, touching = 0;  // force, with its sign [force]; for how long [time]
};

/// What the mass does at an instant.
struct Blow {
  double place, velocity;    // along w [length, length/time]
  double force;              // that it presses with, on the plate along w [force]
  double largest, touching;  // of all steps so far: force, how long it presses [time]
  std::vector<std::pair<std::uint32_t, double>> shares;
};

}  // namespace plate
