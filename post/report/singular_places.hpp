#pragma once
#include <string>
#include <vector>

#include "geometry/shape/outline.hpp"
#include "post/files/recorder.hpp"
#include "post/files/summary.hpp"

namespace plate {
class Formulation;
}

namespace post {

struct Frame;

/// Place at which a plate has no finite stress: a tip, a sharp corner, a pin, a spring, a point force, an impact.
struct SingularPlace {
  std::string name;
  geometry::Point position;
};

std::vector<SingularPlace> singular_places(const plate::Formulation& plate);

/// Circles about the singular places of a plate that one process holds, on which the von Mises stress is looked at.
/// Points nearer than the radius to another singular place are left out, and so are places after the first fifty.
class StressAround {
public:
  /// `distance`: the radius [length].
  StressAround(const plate::Formulation& plate, double distance);

  bool none() const { return around_.empty(); }
  /// The largest von Mises stress at this distance from every place.
  std::vector<StressAtDistance> take(const Frame& frame) const;

private:
  struct Around {
    SingularPlace place;
    std::vector<Probe> circle;
    bool resolved;  // two points at least lie between the place and the circle
  };
  double distance_;
  std::vector<Around> around_;
};

}  // namespace post
