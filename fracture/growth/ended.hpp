#pragma once
#include <string>

namespace fracture {

/// How a growth ends at rest.
enum class End {
  no_tip_left,    // every tip has reached an edge, a hole or a crack
  cannot_grow,    // nothing that could give way
  no_growth,      // the whole load, or the displacement at its end, was not enough from the start
  arrested,       // ... or is not enough any more
  most_advances,  // the largest number of advances that was asked for
  longest,        // the largest length of cracks that was asked for
  unstable,       // the next advance would be unstable, and growth must not jump
  split,          // a piece of the plate is not held any more
  failed          // the numbers failed
};

struct Ended {
  End how = End::failed;
  std::string detail = {};  // of a split: what is not held; of a failure: what failed
};

}  // namespace fracture
