#pragma once
#include <vector>

namespace post {

/// Samples of a curve in the order in which they are joined; a value that is not finite leaves a gap.
struct Curve {
  std::vector<double> t, y;
};

}  // namespace post
