#include "geometry/shape/crack_graph.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/shape/crack_path.hpp"

namespace geometry {
namespace {

using Corner = CrackGraph::Corner;
using Meeting = std::map<Corner, std::set<Corner>>;

/// Follows a chain from one corner along sides that meet no third one.
std::vector<Corner> chain(const Meeting& meeting, const Corner& from, const Corner& next) {
  std::vector<Corner> result{from, next};
  while (result.back() != from) {
    const auto& ways = meeting.at(result.back());
    if (ways.size() != 2) break;
    const Corner before = result[result.size() - 2];
    result.push_back(*ways.begin() == before ? *ways.rbegin() : *ways.begin());
  }
  return result;
}

/// Returns all chains once: between corners where not two sides meet, then closed ones.
std::vector<std::vector<Corner>> chains(const Meeting& meeting) {
  std::vector<std::vector<Corner>> result;
  std::set<std::pair<Corner, Corner>> gone;
  const auto follow = [&](const Corner& from) {
    for (const auto& next : meeting.at(from)) {
      if (gone.contains({from, next})) continue;
      result.push_back(chain(meeting, from, next));
      const auto& corners = result.back();
      for (std::size_t i = 1; i < corners.size(); ++i)
        gone.insert({corners[i - 1], corners[i]}), gone.insert({corners[i], corners[i - 1]});
    }
  };
  for (const auto& [corner, ways] : meeting)
    if (ways.size() != 2) follow(corner);
  for (const auto& [corner, ways] : meeting)
    if (ways.size() == 2) follow(corner);
  return result;
}

Point point(const Corner& corner) {
  return {corner[0], corner[1]};
}

constexpr double equal = 1e-9;  // spacings: what rounding leaves between mirror images

/// Corners between two of a chain that are farthest from the line between these: the first and the last of them, so
/// that a chain gives the same ones from either end.
struct Farthest {
  std::size_t first, last;
  double away;
};

Farthest farthest(const std::vector<Corner>& corners, std::size_t first, std::size_t last) {
  Farthest result{first, first, 0};
  for (std::size_t i = first + 1; i < last; ++i) {
    const double away = distance({point(corners[first]), point(corners[last])}, point(corners[i]));
    if (away > result.away + equal)
      result = {i, i, away};
    else if (away > result.away - equal)
      result.last = i;
  }
  return result;
}

/// Keeps of a staircase the corners that stand out from the line between those kept (Douglas and Peucker 1973).
void keep(const std::vector<Corner>& corners, std::size_t first, std::size_t last, std::vector<char>& kept) {
  constexpr double stands_out = 1.1 + equal;  // corners of the staircase along a straight line do by less than 1
  const auto [begin, end, away] = farthest(corners, first, last);
  if (away <= stands_out) return;
  kept[begin] = kept[end] = 1;
  keep(corners, first, begin, kept), keep(corners, begin, end, kept), keep(corners, end, last, kept);
}

/// Numbers of the corners of a closed chain that are farthest from a place; the last corner, which is the first, is
/// left out.
std::vector<std::size_t> farthest_from(const Point& place, const std::vector<Corner>& corners) {
  std::vector<std::size_t> result;
  double most = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const double away = (point(corners[i]) - place).norm();
    if (away > most + equal) result.clear(), most = away;
    if (away > most - equal) result.push_back(i);
  }
  return result;
}

Point middle(const std::vector<Corner>& closed) {
  Point sum(0, 0);
  for (std::size_t i = 1; i < closed.size(); ++i) sum += point(closed[i]);
  return sum / double(closed.size() - 1);
}

/// Lets a closed chain that meets no other begin at a corner farthest from its middle.
void begin_far_out(std::vector<Corner>& closed) {
  const auto first = farthest_from(middle(closed), closed).front();
  closed.pop_back();
  std::ranges::rotate(closed, closed.begin() + std::ptrdiff_t(first));
  closed.push_back(closed.front());
}

/// Numbers of the corners of a closed chain that are kept before any other, ascending: its ends, those farthest from
/// where it begins (where it meets no other, `alone`, from its middle), and where these are but two, what stands out
/// most from the line between them.
std::vector<std::size_t> kept_of_closed(const std::vector<Corner>& corners, bool alone) {
  std::vector<std::size_t> result{0, corners.size() - 1};
  const auto add = [&](const std::vector<std::size_t>& more) {
    result.insert(result.end(), more.begin(), more.end());
    std::ranges::sort(result);
    result.erase(std::ranges::unique(result).begin(), result.end());
  };
  if (alone) add(farthest_from(middle(corners), corners));
  if (result.size() == 2) add(farthest_from(point(corners.front()), corners));
  if (result.size() > 3) return result;
  const auto there = farthest(corners, 0, result[1]), back = farthest(corners, result[1], result[2]);
  for (const auto& half : {there, back})
    if (half.away > std::max(there.away, back.away) - equal) add({half.first, half.last});
  return result;
}

/// When the crack got to a corner of a chain: the earlier of the sides that it has there.
double arrival(const std::map<CrackGraph::Side, double>& times, const std::vector<Corner>& corners, std::size_t i) {
  const std::size_t last = corners.size() - 1;
  const bool closed = corners.front() == corners.back();
  const auto of_side = [&](std::size_t to) {
    const auto side = std::minmax(corners[to - 1], corners[to]);
    return times.at({side.first, side.second});
  };
  if (i > 0 && i < last) return std::min(of_side(i), of_side(i + 1));
  if (closed) return std::min(of_side(1), of_side(last));
  return of_side(i == 0 ? 1 : last);
}

}  // namespace

bool CrackGraph::part(const Point& p, const Point& q, double time) {
  // the side between the cells of p and q is the cross of the bond through its middle
  const Point middle = (p + q) / 2, half{std::abs(q.y() - p.y()) / 2, std::abs(q.x() - p.x()) / 2};
  const auto corner = [](const Point& x) { return Corner{int(std::lround(x.x())), int(std::lround(x.y()))}; };
  return times_.try_emplace({corner(middle - half), corner(middle + half)}, time).second;
}

std::vector<CrackGraph::Side> CrackGraph::runs() const {
  std::vector<Side> result;
  std::map<Side, std::size_t> ending;  // the last side of every run
  for (const auto& [side, time] : times_) {
    const auto& [from, to] = side;
    const Corner before{2 * from[0] - to[0], 2 * from[1] - to[1]};
    const auto found = ending.find({before, from});
    const auto run = found == ending.end() ? result.size() : found->second;
    if (run == result.size())
      result.push_back(side);
    else
      result[run].second = to;
    ending[side] = run;
  }
  return result;
}

std::vector<GraphLine> CrackGraph::lines(const std::function<bool(const Corner&)>& inside, std::size_t least) const {
  Meeting meeting;
  for (const auto& [side, time] : times_)
    meeting[side.first].insert(side.second), meeting[side.second].insert(side.first);
  const auto is_tip = [&](const Corner& corner) { return meeting.at(corner).size() <= 1 && inside(corner); };

  auto found = chains(meeting);
  for (auto spurs = found;; spurs = found = chains(meeting)) {  // all of a look at once, whatever their order
    std::erase_if(spurs, [&](const auto& corners) {
      return corners.size() > least || !(is_tip(corners.front()) || is_tip(corners.back()));
    });
    if (spurs.empty()) break;
    for (const auto& corners : spurs)
      for (std::size_t i = 1; i < corners.size(); ++i)
        meeting[corners[i - 1]].erase(corners[i]), meeting[corners[i]].erase(corners[i - 1]);
    std::erase_if(meeting, [](const auto& one) { return one.second.empty(); });
  }

  const auto end = [&](const Corner& corner) {
    return !inside(corner) ? End::mouth : meeting.at(corner).size() == 1 ? End::tip : End::junction;
  };
  std::vector<GraphLine> result;
  for (auto& corners : found) {
    const bool closed = corners.front() == corners.back(), alone = closed && meeting.at(corners.front()).size() == 2;
    if (alone) begin_far_out(corners);
    const std::size_t last = corners.size() - 1;
    const auto fixed = closed ? kept_of_closed(corners, alone) : std::vector<std::size_t>{0, last};
    std::vector<char> kept(corners.size(), 0);
    for (std::size_t i = 1; i < fixed.size(); ++i)
      kept[fixed[i - 1]] = kept[fixed[i]] = 1, keep(corners, fixed[i - 1], fixed[i], kept);
    GraphLine line{{}, {}, end(corners.front()), end(corners.back()), 0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!kept[i]) continue;
      line.vertices.push_back(point(corners[i]));
      line.times.push_back(arrival(times_, corners, i));
    }
    line.length = geometry::length(line.vertices);
    result.push_back(std::move(line));
  }
  return result;
}

}  // namespace geometry
