#include "geometry/shape/crack_cleanup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

/// The nearest place of those that it was shown.
struct Nearest {
  Point x, place{0, 0};
  double distance = std::numeric_limits<double>::infinity();
  std::string name{};

  /// True: it is nearer than all before.
  bool look(const Point& there) {
    const double length = (there - x).norm();
    if (length >= distance) return false;
    place = there, distance = length;
    return true;
  }
};

Nearest nearest(const Outline& outline, const std::vector<Polyline>& cracks, std::size_t own, const Point& x) {
  Nearest result{x};
  for (const Edge& edge : straight_edges(outline))
    if (result.look(nearest_on_segment(edge.from, edge.to, x))) result.name = edge.name;
  for (const Circle& circle : circles(outline))
    if (x != circle.centre && result.look(circle.centre + circle.radius * (x - circle.centre).normalized()))
      result.name = circle.name;
  std::size_t nearest = cracks.size();
  for (std::size_t other = 0; other < cracks.size(); ++other)
    for (std::size_t i = 0; other != own && i + 1 < cracks[other].size(); ++i)
      if (result.look(nearest_on_segment(cracks[other][i], cracks[other][i + 1], x))) nearest = other;
  if (nearest < cracks.size()) result.name = text("cracks[", nearest, "]");
  return result;
}

}  // namespace

namespace {

/// Vertex of a crack before its end; of a curve, whose pieces only say how it is drawn, one some pieces before.
Point before_end(const Polyline& line, bool at_back) {
  constexpr std::size_t pieces = 16;
  constexpr double slight = 0.01;  // bends [rad]
  const auto from_end = [&](std::size_t i) -> const Point& { return at_back ? line[line.size() - 1 - i] : line[i]; };
  std::size_t i = 1;
  for (; i < pieces && i + 1 < line.size(); ++i) {
    const Point one = from_end(i) - from_end(i - 1), next = from_end(i + 1) - from_end(i);
    if (const double turn = std::abs(std::atan2(cross(one, next), one.dot(next))); turn == 0 || turn > slight) break;
  }
  return from_end(i == pieces ? i : 1);
}

}  // namespace

Snapped snapped(const Outline& outline, std::vector<Polyline> cracks, double reach) {
  constexpr double share = 1e-3;  // of the segment: far above rounding to five digits, far below what is drawn
  const double touching = tolerance(outline);
  Snapped result;
  for (std::size_t crack = 0; crack < cracks.size(); ++crack) {
    auto& v = cracks[crack];
    if (v.size() < 2) continue;
    for (const bool at_back : {false, true}) {
      Point& x = at_back ? v.back() : v.front();
      const Point before = before_end(v, at_back);
      const auto found = nearest(outline, cracks, crack, x);
      if (found.distance <= touching || !(found.distance <= std::min(reach, share * (x - before).norm()))) continue;
      x = found.place;
      result.snaps.push_back({crack, at_back, found.distance, found.name});
    }
  }
  result.cracks = std::move(cracks);
  return result;
}

namespace {

/// True where x lies on the straight way from a to b.
bool on_the_way(const Point& a, const Point& x, const Point& b, double touching) {
  constexpr double share = 1e-4;  // of the shorter piece: rounding to five digits
  if ((x - a).dot(b - x) <= 0) return false;
  const double slack = std::max(touching, share * std::min((x - a).norm(), (b - x).norm()));
  return distance_to_segment(a, b, x) <= slack;
}

/// Returns the line without the vertices between straight pieces, save those for which `stays` is true.
template <typename Stays>
Polyline straightened(const Polyline& line, double touching, const Stays& stays) {
  Polyline result{line.front()};
  std::vector<Point> between;  // the last vertex of the result and the next one
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    between.push_back(line[i]);
    const auto removable = [&](const Point& x) { return on_the_way(result.back(), x, line[i + 1], touching); };
    if (std::ranges::all_of(between, removable) && !stays(line[i])) continue;
    result.push_back(line[i]);
    between.clear();
  }
  result.push_back(line.back());
  return result;
}

/// An end of a crack.
struct CrackEnd {
  std::size_t crack;
  bool at_back;
};

/// Two cracks that go on from each other at a place.
struct Joint {
  std::size_t one, other;
  Point at;
};

class Merger {
public:
  Merger(const Outline& outline, std::vector<Polyline> cracks)
      : outline_(outline), touching_(tolerance(outline)), cracks_(std::move(cracks)), number_(cracks_.size()) {
    for (std::size_t i = 0; i < number_.size(); ++i) number_[i] = i, ends_.push_back({i, i});
  }

  Merged operator()() {
    for (const auto& [one, other, at] : continued()) join(number_[one], number_[other], at);
    Merged result{{}, std::move(continuations_)};
    for (std::size_t i = 0; i < cracks_.size(); ++i) {
      if (cracks_[i].empty()) continue;
      if (ends_[i].front > ends_[i].back) std::ranges::reverse(cracks_[i]);
      const auto stays = [&](const Point& x) {
        const auto ends_at = [&](const Point& end) { return (end - x).norm() <= touching_; };
        return ends_at(cracks_[i].front()) || ends_at(cracks_[i].back()) || count_at(x, i) > 0;
      };
      cracks_[i] = straightened(cracks_[i], touching_, stays);
      result.cracks.push_back(cracks_[i]);
    }
    return result;
  }

private:
  const Point& place(const CrackEnd& end) const {
    return end.at_back ? cracks_[end.crack].back() : cracks_[end.crack].front();
  }
  const Point& before(const CrackEnd& end) const {
    const auto& line = cracks_[end.crack];
    return end.at_back ? line[line.size() - 2] : line[1];
  }

  /// Counts the cracks that touch a place, without these two.
  std::size_t count_at(const Point& x, std::size_t one, std::size_t other = SIZE_MAX) const {
    std::size_t count = 0;
    for (std::size_t c = 0; c < cracks_.size(); ++c)
      if (c != one && c != other && !cracks_[c].empty() && distance(cracks_[c], x) <= touching_) ++count;
    return count;
  }

  bool continues(const CrackEnd& one, const CrackEnd& other) const {
    const Point& x = place(one);
    return one.crack != other.crack && (place(other) - x).norm() <= touching_ &&
           on_the_way(before(one), x, before(other), touching_) && distance_to_boundary(outline_, x) > touching_ &&
           count_at(x, one.crack, other.crack) == 0;
  }

  /// Returns the joints of cracks that continue each other, by the numbers of the cracks.
  std::vector<Joint> continued() const {
    std::multimap<double, CrackEnd> by_x;
    for (std::size_t c = 0; c < cracks_.size(); ++c)
      for (const bool at_back : {false, true}) by_x.emplace(place({c, at_back}).x(), CrackEnd{c, at_back});
    std::vector<Joint> result;
    for (std::size_t c = 0; c < cracks_.size(); ++c)
      for (const bool at_back : {false, true}) {
        const CrackEnd end{c, at_back};
        const auto last = by_x.upper_bound(place(end).x() + touching_);
        for (auto near = by_x.lower_bound(place(end).x() - touching_); near != last; ++near)
          if (near->second.crack > c && continues(end, near->second))
            result.push_back({c, near->second.crack, place(end)});
      }
    std::ranges::stable_sort(result, {}, [](const Joint& joint) { return std::pair(joint.one, joint.other); });
    return result;
  }

  /// Puts one piece behind the other, unless both belong to one crack already, which would close it.
  void join(std::size_t one, std::size_t other, const Point& at) {
    if (one == other) return;
    const auto first = std::min(one, other), second = std::max(one, other);
    auto &head = cracks_[first], &tail = cracks_[second];
    const auto turn = [&](std::size_t crack) {
      std::ranges::reverse(cracks_[crack]);
      std::swap(ends_[crack].front, ends_[crack].back);
    };
    if ((head.back() - at).norm() > touching_) turn(first);
    if ((tail.front() - at).norm() > touching_) turn(second);
    ends_[first].back = ends_[second].back;
    head.insert(head.end(), tail.begin() + 1, tail.end());
    tail.clear();
    std::ranges::replace(number_, second, first);
    continuations_.push_back({second, first});
  }

  const Outline& outline_;
  double touching_;
  std::vector<Polyline> cracks_;
  std::vector<std::size_t> number_;  // of the crack that each one belongs to
  /// Pieces that the two ends of a crack belonged to.
  struct Ends {
    std::size_t front, back;
  };
  std::vector<Ends> ends_;
  std::vector<Continuation> continuations_;
};

}  // namespace

Merged merged(const Outline& outline, std::vector<Polyline> cracks) {
  return Merger(outline, std::move(cracks))();
}

}  // namespace geometry
