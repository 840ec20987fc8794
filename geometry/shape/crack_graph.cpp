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

/// Keeps of a staircase the corners that stand out from the line between those kept (Douglas and Peucker 1973).
void keep(const std::vector<Corner>& corners, std::size_t first, std::size_t last, std::vector<char>& kept) {
  constexpr double stands_out = 1.1;  // corners of the staircase along a straight line do by less than 1
  std::size_t farthest = first;
  double most = stands_out;
  for (std::size_t i = first + 1; i < last; ++i)
    if (const double away = distance({point(corners[first]), point(corners[last])}, point(corners[i])); away > most)
      most = away, farthest = i;
  if (farthest == first) return;
  kept[farthest] = 1;
  keep(corners, first, farthest, kept), keep(corners, farthest, last, kept);
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
  for (bool pruned = true; pruned;) {
    pruned = false;
    for (const auto& corners : found) {
      if (corners.size() > least || !(is_tip(corners.front()) || is_tip(corners.back()))) continue;
      for (std::size_t i = 1; i < corners.size(); ++i)
        meeting[corners[i - 1]].erase(corners[i]), meeting[corners[i]].erase(corners[i - 1]);
      pruned = true;
    }
    std::erase_if(meeting, [](const auto& one) { return one.second.empty(); });
    if (pruned) found = chains(meeting);
  }

  std::vector<GraphLine> result;
  for (const auto& corners : found) {
    std::vector<char> kept(corners.size(), 0);
    const std::size_t last = corners.size() - 1;
    std::vector<std::size_t> fixed{0, last};
    if (corners.front() == corners.back()) fixed = {0, last / 3, 2 * last / 3, last};  // closed: three corners at least
    for (std::size_t i = 1; i < fixed.size(); ++i)
      kept[fixed[i - 1]] = kept[fixed[i]] = 1, keep(corners, fixed[i - 1], fixed[i], kept);
    const auto end = [&](const Corner& corner) {
      return !inside(corner) ? End::mouth : meeting.at(corner).size() == 1 ? End::tip : End::junction;
    };
    GraphLine line{{}, {}, end(corners.front()), end(corners.back()), 0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!kept[i]) continue;
      const auto& other = corners[i + 1 < corners.size() ? i + 1 : i - 1];
      const auto side = std::minmax(corners[i], other);
      line.vertices.push_back(point(corners[i]));
      line.times.push_back(times_.at({side.first, side.second}));
    }
    line.length = geometry::length(line.vertices);
    result.push_back(std::move(line));
  }
  return result;
}

}  // namespace geometry
