#include "post/factors/tip_rings.hpp"

#include <algorithm>
#include <cmath>

namespace post {
namespace {

using geometry::Point;

/// How far the crack runs straight back from its tip; another end of it counts at 0.7 of its distance, because the
/// field there is singular too (an integral over a ring up to the other tip of a crack 25 spacings long was 1.5 % off).
double straight_length(const geometry::CrackPath& path, const geometry::Tip& tip, double spacing) {
  auto vertices = path.vertices;
  if (tip.at_back) std::reverse(vertices.begin(), vertices.end());
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const Point x = vertices[i] - tip.position;
    const double aside = std::abs(x.x() * tip.direction.y() - x.y() * tip.direction.x());
    if (aside > spacing / 4) return (vertices[i - 1] - tip.position).norm();
  }
  const bool ends_in_plate = (tip.at_back ? path.front : path.back) != geometry::End::mouth;
  return (ends_in_plate ? 0.7 : 1.0) * (vertices.back() - tip.position).norm();
}

}  // namespace

double clear_distance(const geometry::Outline& outline, const std::vector<geometry::CrackPath>& paths,
                      const geometry::Tip& tip, double spacing) {
  double clear = straight_length(paths[tip.crack], tip, spacing);
  for (const auto& edge : geometry::straight_edges(outline))
    clear = std::min(clear, geometry::distance({edge.from, edge.to}, tip.position));
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<geometry::Circle>(&hole))
      clear = std::min(clear, std::abs((tip.position - circle->centre).norm() - circle->radius));
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (i != tip.crack) clear = std::min(clear, geometry::distance(paths[i].vertices, tip.position));
  return clear;
}

geometry::Tip centred(const geometry::Tip& tip, const TipView& plate) {
  const TipFrame frame(tip);
  const double behind = 16 * plate.spacing;  // two steps of the staircase that a crack at 7 degrees is
  double above = behind, below = -behind;
  for (std::size_t k = 0; k < plate.plate_points; ++k) {
    const Point x = frame.local(plate.positions[k]);
    if (x.x() > -1e-3 * plate.spacing || x.x() < -behind || std::abs(x.y()) > behind) continue;
    if (plate::face_of(x.y(), frame.left(), plate.spacing) > 0)
      above = std::min(above, x.y());
    else
      below = std::max(below, x.y());
  }
  geometry::Tip result = tip;
  result.position += (above + below) / 2 * frame.left();
  return result;
}

std::vector<Ring> rings(double clear, double spacing, bool graded) {
  const double most = (clear - spacing / 2) / spacing;
  std::vector<Ring> result;
  if (graded && most > 16) {
    for (const double share : {0.6, 0.4, 0.8})
      result.push_back({std::max(share * clear / 8, 3 * spacing), share * clear});
    return result;
  }
  for (const double outer : {16.0, 11.0, 24.0, 7.0})
    if (outer <= most * (1 + 1e-9)) result.push_back({outer / 2 * spacing, outer * spacing});
  if (most > 4 && (result.empty() || (most < 11 && most > 8.5)))
    result.insert(result.begin(), {most / 2 * spacing, most * spacing});
  return result;
}

}  // namespace post
