#include "plate/bonds/visibility.hpp"

#include <algorithm>
#include <map>

#include "plate/bonds/supports.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

using geometry::Point;

/// Marks the points within one horizon of something a bond can leave the plate through: all edges of an outline that is
/// not convex, and holes. All others need no test.
std::vector<char> near_openings(const Boundary& boundary, const geometry::Outline& outline, double reach) {
  const auto& vertices = outline.outer.vertices;
  bool convex = true;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point a = vertices[(i + 1) % vertices.size()] - vertices[i];
    const Point b = vertices[(i + 2) % vertices.size()] - vertices[(i + 1) % vertices.size()];
    if (a.x() * b.y() - a.y() * b.x() < 0) convex = false;
  }
  const std::size_t outer = vertices.size();
  std::vector<char> near(boundary.lattice.size(), 0);
  for (std::size_t s = convex ? outer : 0; s < boundary.sides.size(); ++s) {
    const Side& side = boundary.sides[s];
    if (!side.parts()) continue;
    for (std::size_t k = 0; k < boundary.cloud.plate_points; ++k) {
      const Point& u = boundary.lattice[k];
      const double away = side.circle ? side.inside(u) : geometry::distance({side.edge.from, side.edge.to}, u);
      if (away <= reach) near[k] = 1;
    }
  }
  return near;
}

/// True where pq and the side cross, each strictly between the ends of the other.
bool crosses(const Side& side, const Point& p, const Point& q) {
  if (!side.parts()) return false;
  if (side.circle) return side.meets(p, q);
  const auto turn = [](const Point& a, const Point& b, const Point& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  return turn(side.edge.from, side.edge.to, p) * turn(side.edge.from, side.edge.to, q) < 0 &&
         turn(p, q, side.edge.from) * turn(p, q, side.edge.to) < 0;
}

/// A bond to a mirror image must cross a side of the image, and no image of it any other side.
bool sees_mirror_image(const Boundary& boundary, std::uint32_t k, std::uint32_t j, const FictitiousPoint& image) {
  const Point &p = boundary.lattice[k], &q = boundary.lattice[j];
  const auto own = [&](std::size_t s) { return int(s) == image.sides[0] || int(s) == image.sides[1]; };
  bool through = false;
  for (std::size_t s = 0; s < boundary.sides.size(); ++s)
    if (own(s)) through = through || boundary.sides[s].meets(p, q);
  return through && !boundary.any_image(k, j, [&](const Point& a, const Point& b) {
    for (std::size_t s = 0; s < boundary.sides.size(); ++s)
      if (!own(s) && crosses(boundary.sides[s], a, b)) return true;
    return false;
  });
}

/// True if the bond from k to j meets this image. Of several images at one place, a bond meets that of the side through
/// which it leaves the plate; through a vertex, it meets a mirror image or the first one.
bool sees_general_image(const Boundary& boundary, std::uint32_t k, std::uint32_t j, const FictitiousPoint& image) {
  const Point &p = boundary.lattice[k], &q = boundary.lattice[j];
  const auto own = std::size_t(image.sides[0]);
  if (!boundary.sides[own].meets(p, q)) return false;
  for (std::size_t s = 0; s < boundary.sides.size(); ++s) {
    if (s == own) continue;
    const Side& side = boundary.sides[s];
    if (crosses(side, p, q) || ((s < own || side.along_lattice()) && has_images(side) && side.meets(p, q)))
      return false;
  }
  return true;
}

bool sees_image(const Boundary& boundary, std::uint32_t k, std::uint32_t j) {
  const FictitiousPoint& image = boundary.fictitious[j - boundary.cloud.plate_points];
  return image.exact ? sees_mirror_image(boundary, k, j, image) : sees_general_image(boundary, k, j, image);
}

bool sees_layer(const Boundary& boundary, std::uint32_t k, std::uint32_t j) {
  for (const Side& side : boundary.sides)
    if (!is_layer(side.kind) && crosses(side, boundary.lattice[k], boundary.lattice[j])) return false;
  return true;
}

/// Numbers of the supports whose bodies have points of this plate, -1 elsewhere [plate points]; empty without bodies.
std::vector<std::int32_t> bodies_of(const Boundary& boundary) {
  auto result = boundary.body;
  for (const auto& side : boundary.sides)
    if (!side.parts()) std::ranges::replace(result, std::int32_t(*side.support), -1);
  return result;
}

/// An outline with the parts that bodies hold as holes.
geometry::Outline with_rims(geometry::Outline outline, const Boundary& boundary) {
  std::map<std::size_t, geometry::Polygon> polygons;
  for (const auto& side : boundary.sides) {
    if (!side.support || !side.parts()) continue;
    if (side.circle)
      outline.holes.emplace_back(geometry::Circle{side.centre, side.radius, side.name});
    else
      polygons[*side.support].vertices.push_back(side.edge.from);
  }
  for (auto& [support, polygon] : polygons) outline.holes.emplace_back(std::move(polygon));
  return outline;
}

}  // namespace

bool Boundary::any_image(std::uint32_t k, std::uint32_t j,
                         const std::function<bool(const Point&, const Point&)>& test) const {
  Point p = lattice[k], q = lattice[j];
  if (test(p, q)) return true;
  const auto outer = std::max(k, j);
  if (is_plate(outer)) return false;
  const FictitiousPoint& point = fictitious[outer - cloud.plate_points];
  if (!point.exact) return false;
  const auto mirror = [&](int side, const Point& u) { return sides[static_cast<std::size_t>(side)].mirrored(u); };
  for (const int side : point.sides)
    if (side >= 0 && test(mirror(side, p), mirror(side, q))) return true;
  if (point.sides[1] < 0) return false;
  return test(mirror(point.sides[1], mirror(point.sides[0], p)), mirror(point.sides[1], mirror(point.sides[0], q)));
}

geometry::Pairwise sees(const Boundary& boundary, const geometry::Outline& outline, double horizon_ratio) {
  auto near = near_openings(boundary, outline, horizon_ratio);
  auto bodies = bodies_of(boundary);
  return [&boundary, rims = with_rims(outline, boundary), near = std::move(near), bodies = std::move(bodies)](
             std::uint32_t k, std::uint32_t j) {
    if (boundary.is_plate(j)) {
      if (!bodies.empty() && (bodies[k] >= 0 || bodies[j] >= 0)) return bodies[k] == bodies[j];
      return !(near[k] && near[j]) || !geometry::leaves(rims, boundary.lattice[k], boundary.lattice[j]);
    }
    if (!bodies.empty() && boundary.is_plate(k) && bodies[k] >= 0) return false;
    const auto of = [&](std::uint32_t i) -> const FictitiousPoint& {
      return boundary.fictitious[i - boundary.cloud.plate_points];
    };
    if (!of(j).bonded) return false;
    const bool layer = of(j).layer;
    if (boundary.is_plate(k)) return layer ? sees_layer(boundary, k, j) : sees_image(boundary, k, j);
    return layer && of(k).layer && of(k).bonded && sees_layer(boundary, k, j);
  };
}

namespace {

/// Points with a bond that may cross a crack: themselves or an image of theirs within one horizon of it.
std::vector<char> near_cracks(const Boundary& boundary, const std::vector<geometry::CrackPath>& paths, double reach) {
  std::vector<char> near(boundary.lattice.size(), 0);
  const auto close = [&](const Point& u) {
    for (const auto& path : paths)
      if (geometry::distance(path.vertices, u) <= reach) return true;
    return false;
  };
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < near.size(); ++k) near[k] = close(boundary.lattice[k]);
  for (const auto& tie : boundary.constraints.ties())
    if (tie.follower.point >= boundary.cloud.plate_points && near[tie.leader.point]) near[tie.follower.point] = 1;
  return near;
}

}  // namespace

geometry::Families without_crossing_bonds(const Boundary& boundary, const geometry::Families& families,
                                          const std::vector<geometry::CrackPath>& paths, double horizon_ratio) {
  if (paths.empty()) return families;
  const auto near = near_cracks(boundary, paths, horizon_ratio);
  return geometry::without(families, [&](std::uint32_t k, std::uint32_t j) {
    if (!near[k] && !near[j]) return false;
    return boundary.any_image(k, j, [&](const Point& p, const Point& q) {
      for (const auto& path : paths)
        if (geometry::separates(path, p, q)) return true;
      return false;
    });
  });
}

std::vector<double> cut_share(const geometry::Families& whole, const geometry::Families& remaining,
                              const std::vector<BondShape>& shapes, std::size_t plate_points) {
  std::vector<double> share(plate_points, 0);
  const auto weight = [&](const geometry::Families& families, std::size_t k) {
    double sum = 0;
    for (const auto& bond : families[k]) sum += shapes[bond.vector_id].weight;
    return sum;
  };
  for (std::size_t k = 0; k < plate_points; ++k) {
    const auto before = whole[k].size(), after = remaining[k].size();
    if (after < before) share[k] = 1 - weight(remaining, k) / weight(whole, k);
  }
  return share;
}

}  // namespace plate
