#pragma once
#include <optional>
#include <string>
#include <vector>

namespace fracture {

/// How a quasi-static growth ends.
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

/// What became of a growth in motion.
struct Moved {
  std::size_t advances = 0;                 // pieces of crack, or steps in which bonds broke
  std::optional<std::size_t> broken;        // bonds
  std::vector<std::string> reached;         // edges, holes and cracks by tips
  std::vector<std::string> stopped = {};    // tips whose direction is not resolved, and when
  std::vector<std::string> unsteady = {};   // tips that took another energy than that of a crack, and when
  bool unseen = false;                      // tips have gone straight on whose direction is not known
  std::size_t parts = 1, parts_before = 1;  // of the plate
  bool frozen = false;                      // pieces that fell off stay where they were
  std::optional<double> spent;              // energy taken over fracture energy and area of the new crack
  double largest_speed = 0;                 // of a tip [length/time]
  std::vector<double> lengths;              // of every crack [length]
};

}  // namespace fracture
