#pragma once
#include <numbers>
#include <random>

#include "geometry/lattice/cloud.hpp"

/// Valid plates of every kind: polygons of any direction, some with holes, with none to three cracks.
namespace random_plates {

using geometry::Point;

struct Plate {
  geometry::Outline outline;
  std::vector<geometry::Polyline> cracks;
};

class Maker {
public:
  explicit Maker(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// About `centre`, between these distances from it.
  geometry::Polygon polygon(const Point& centre, double nearest, double furthest, int corners,
                            const std::string& name) {
    geometry::Polygon result;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * (i + uniform(0, 0.9)) / corners, r = uniform(nearest, furthest);
      result.vertices.push_back(centre + r * Point(std::cos(angle), std::sin(angle)));
      result.edge_names.push_back(name + std::to_string(i));
    }
    return result;
  }

  geometry::Hole hole(const std::string& name) {
    const Point centre(uniform(-0.4, 0.4), uniform(-0.4, 0.4));
    if (uniform(0, 1) < 0.5) return geometry::Circle{centre, uniform(0.08, 0.25), name};
    return polygon(centre, 0.1, 0.3, 3 + int(uniform(0, 3)), name);
  }

  /// Inside, from an edge, or with a bend.
  geometry::Polyline crack(const geometry::Outline& outline) {
    const auto inside = [&] { return Point(uniform(-0.8, 0.8), uniform(-0.8, 0.8)); };
    geometry::Polyline result{inside(), inside()};
    if (uniform(0, 1) < 0.3) result.push_back(inside());
    const auto& ring = outline.outer.vertices;
    const auto edge = std::size_t(uniform(0, double(ring.size())));
    if (uniform(0, 1) < 0.4)
      result.front() = ring[edge] + uniform(0.1, 0.9) * (ring[(edge + 1) % ring.size()] - ring[edge]);
    return result;
  }

  Plate plate() {
    for (;;) {
      Plate result{{polygon({0, 0}, 0.6, 1.2, 3 + int(uniform(0, 6)), "edge"), {}}, {}};
      for (double some = uniform(0, 1); some > 0.6; some -= 0.2)
        result.outline.holes.push_back(hole(some > 0.8 ? "first" : "second"));
      if (!geometry::errors(result.outline).empty()) continue;
      const auto count = std::size_t(uniform(0, 4));
      for (int tries = 0; tries < 100 && result.cracks.size() < count; ++tries) {
        result.cracks.push_back(crack(result.outline));
        if (!geometry::errors(result.outline, result.cracks, tolerance(result.outline)).empty())
          result.cracks.pop_back();
      }
      return result;
    }
  }

  static double tolerance(const geometry::Outline& outline) {
    const auto [low, high] = geometry::bounding_box(outline);
    return 1e-9 * (high - low).norm();
  }

private:
  std::mt19937 random_;
};

/// Turned about the origin, then shifted.
inline Plate moved(Plate plate, double angle, const Point& shift) {
  const auto place = [&](const Point& x) -> Point {
    return shift +
           Point(std::cos(angle) * x.x() - std::sin(angle) * x.y(), std::sin(angle) * x.x() + std::cos(angle) * x.y());
  };
  plate.outline = geometry::placed(plate.outline, place, 1);
  for (auto& crack : plate.cracks)
    for (auto& x : crack) x = place(x);
  return plate;
}

inline std::vector<geometry::CrackPath> paths(const Plate& plate) {
  return geometry::crack_paths(plate.outline, plate.cracks, Maker::tolerance(plate.outline));
}

}  // namespace random_plates
