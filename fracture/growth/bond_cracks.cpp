#include "fracture/growth/bond_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

#include "fracture/growth/distributed_growth.hpp"
#include "geometry/shape/crack_path.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"

namespace fracture {
namespace {

constexpr double jump = 2;          // spacings that a tip may seem to go at once: it stands between points
constexpr double static_jump = 20;  // spacings
constexpr double speed_way = 8;     // spacings
constexpr double equal = 1e-9;      // spacings, or of a length: what rounding leaves between mirror images

bool neighbours(const geometry::Point& p, const geometry::Point& q) {
  return std::abs((p - q).norm() - 1) < 0.01;
}

using Corner = geometry::CrackGraph::Corner;

/// Asks how many points of the plate stand about a corner.
std::function<bool(const Corner&)> by_points(const plate::Formulation& plate) {
  const auto points = std::span(plate.boundary().lattice).first(plate.cloud().plate_points);
  geometry::Point low = points.front(), high = low;
  for (const auto& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const auto [first, below] = geometry::cell_of(low);
  const auto columns = long(std::ceil(high.x())) - first + 1, rows = long(std::ceil(high.y())) - below + 1;
  std::vector<char> cells(std::size_t(columns * rows), 0);
  for (const auto& u : points) {
    const auto [x, y] = geometry::cell_of(u);
    for (const long corner : {0L, 1L, columns, columns + 1})
      ++cells[std::size_t((y - below) * columns + x - first + corner)];
  }
  return [cells = std::move(cells), columns, first = first, below = below](const Corner& corner) {
    return cells[std::size_t((corner[1] - below) * columns + corner[0] - first)] == 4;
  };
}

/// Predicate by the outline, as points are discretised by it.
std::function<bool(const Corner&)> by_outline(const plate::Formulation& plate) {
  return [outline = geometry::to_lattice(plate.problem().outline, plate.cloud().units)](const Corner& corner) {
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        if (!geometry::contains(outline, {corner[0] + x, corner[1] + y})) return false;
    return true;
  };
}

/// Neighbours that the given cracks part, of all processes.
std::vector<std::array<geometry::Point, 2>> parted(const plate::Formulation& plate) {
  const auto& boundary = plate.boundary();
  const auto plate_points = std::uint32_t(plate.cloud().plate_points);
  const geometry::CellIndex at({boundary.lattice.begin(), boundary.lattice.begin() + plate_points});
  const auto paths = geometry::to_lattice(plate.paths(), plate.cloud().units);
  std::vector<std::array<double, 4>> own;
  for (std::uint32_t k = 0; k < plate_points && !paths.empty(); ++k) {
    if (!boundary.owns(k)) continue;
    const geometry::Point& u = boundary.lattice[k];
    for (const geometry::Point& next : {geometry::Point(u.x() + 1, u.y()), geometry::Point(u.x(), u.y() + 1)})
      if (const auto j = at.at(next))
        for (const auto& path : paths)
          if (const auto& v = boundary.lattice[*j]; geometry::separates(path, u, v))
            own.push_back({u.x(), u.y(), v.x(), v.y()});
  }
  own = plate::gathered(plate, own);
  std::vector<std::array<geometry::Point, 2>> result;
  for (const auto& [x, y, z, t] : own) result.push_back({geometry::Point(x, y), geometry::Point(z, t)});
  return result;
}

}  // namespace

BondCracks::BondCracks(const plate::Formulation& plate, std::optional<double> fastest)
    : units_(plate.cloud().units),
      given_(plate.paths()),
      fastest_(fastest),
      numbers_(std::make_shared<const PointNumbers>(plate.boundary())),
      inside_(plate.distributed() ? by_outline(plate) : by_points(plate)) {
  for (const auto& [p, q] : parted(plate)) graph_.part(p, q, 0);
  first_sides_ = graph_.sides();
  find_lines();
  first_length_ = length();
}

void BondCracks::find_lines() {
  if (graph_.sides() == first_sides_) {  // as they were given
    lines_.clear();
    for (const auto& path : given_)
      lines_.push_back({path.vertices, std::vector<double>(path.vertices.size(), 0), path.front, path.back,
                        geometry::length(path.vertices)});
    return;
  }
  lines_ = graph_.lines(inside_);
  for (auto& line : lines_) {
    for (auto& x : line.vertices) x = units_.from_lattice(x);
    line.length *= units_.spacing;
  }
}

bool BondCracks::broke(const std::vector<LoadedBond>& bonds, double time) {
  const auto before = graph_.sides();
  for (const auto& [bond, demand] : bonds)
    if (const auto p = numbers_->place(bond[0]), q = numbers_->place(bond[1]); neighbours(p, q))
      if (graph_.part(p, q, time)) grown_.part(p, q, time);
  broken_ += bonds.size();
  return graph_.sides() > before;
}

std::vector<geometry::CrackPath> BondCracks::paths() const {
  std::vector<geometry::CrackPath> result;
  for (const auto& line : lines_) result.push_back({line.vertices, line.front, line.back});
  return result;
}

std::vector<geometry::CrackPath> BondCracks::cuts() const {
  constexpr double bridged = 1.5;  // spacings from the end of a given crack to where the first bond beside it broke
  const auto place = [&](const geometry::CrackGraph::Corner& corner) {
    return units_.from_lattice(geometry::Point(corner[0], corner[1]));
  };
  auto result = given_;
  const auto tips = geometry::tips(given_);
  std::vector<geometry::Polyline> bridges(tips.size());
  for (const auto& [from, to] : grown_.runs()) {
    result.push_back({{place(from), place(to)}, geometry::End::tip, geometry::End::tip});
    for (std::size_t i = 0; i < tips.size(); ++i)
      for (const auto& x : result.back().vertices) {
        const double away = (x - tips[i].position).norm();
        const double least = bridges[i].empty() ? bridged * units_.spacing : geometry::length(bridges[i]);
        if (away < least) bridges[i] = {tips[i].position, x};
      }
  }
  for (auto& bridge : bridges)
    if (!bridge.empty()) result.push_back({std::move(bridge), geometry::End::tip, geometry::End::tip});
  return result;
}

double BondCracks::length_now() {
  find_lines();
  return length();
}

std::vector<std::pair<std::size_t, geometry::Tip>> BondCracks::tips_of_cracks() const {
  constexpr double least = 8;  // spacings
  std::vector<std::pair<std::size_t, geometry::Tip>> result;
  for (const auto& one : tips_)
    if (lines_[one.tip.crack].length >= least * units_.spacing * (1 - 1e-9)) result.emplace_back(one.number, one.tip);
  return result;
}

double BondCracks::length() const {
  double sum = 0;
  for (const auto& line : lines_) sum += line.length;
  return sum;
}

/// Finds for each tip the nearest one of the last look that no other has come from, nearest pairs first. Where several
/// are equally near, as mirror images are, none of them is the same.
std::vector<BondCracks::Origin> BondCracks::origins(const std::vector<geometry::Tip>& tips, double time) const {
  struct Pair {
    double away;
    std::size_t tip, earlier;
  };
  const double farthest = fastest_ ? jump * units_.spacing + *fastest_ * (time - time_) : static_jump * units_.spacing;
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < tips.size(); ++i)
    for (std::size_t j = 0; j < tips_.size(); ++j)
      if (const double away = (tips_[j].tip.position - tips[i].position).norm();
          away <= farthest + equal * units_.spacing)
        pairs.push_back({away, i, j});
  std::ranges::sort(pairs, {}, &Pair::away);
  std::vector<Origin> result(tips.size());
  std::vector<char> found(tips.size(), 0), taken(tips_.size(), 0);
  for (auto begin = pairs.begin(); begin != pairs.end();) {
    const auto end = std::find_if(begin, pairs.end(), [&, least = begin->away](const Pair& pair) {
      return pair.away > least + equal * units_.spacing;
    });
    std::vector<Pair> free;
    std::copy_if(begin, end, std::back_inserter(free),
                 [&](const Pair& pair) { return !found[pair.tip] && !taken[pair.earlier]; });
    for (const auto& [away, tip, earlier] : free) {
      const auto ways = std::ranges::count(free, tip, &Pair::tip),
                 heirs = std::ranges::count(free, earlier, &Pair::earlier);
      if (ways == 1) result[tip] = {earlier, heirs == 1};
      found[tip] = taken[earlier] = 1;
    }
    begin = end;
  }
  return result;
}

/// A tip as it is seen now, with the way that it has come.
BondTip BondCracks::seen_again(const geometry::Tip& tip, const Origin& origin, double time) {
  BondTip result{0, tip};
  if (origin.earlier) result = tips_[*origin.earlier], result.tip = tip;
  if (!origin.same) result.number = seen_++;
  const auto far = [&](const auto& place) {
    return (place.second - tip.position).norm() >= speed_way * units_.spacing * (1 - equal);
  };
  while (result.way.size() > 1 && far(result.way[1])) result.way.pop_front();
  if (!result.way.empty() && time > result.way.front().first && far(result.way.front()))
    result.speed = (tip.position - result.way.front().second).norm() / (time - result.way.front().first);
  result.way.emplace_back(time, tip.position);
  return result;
}

void BondCracks::look(double time, Record& record, double advance) {
  find_lines();
  const auto tips = geometry::tips(paths());
  const auto from = origins(tips, time);
  std::vector<BondTip> found;
  for (std::size_t i = 0; i < tips.size(); ++i) found.push_back(seen_again(tips[i], from[i], time));
  tips_ = std::move(found);
  time_ = time;
  for (const auto& one : tips_) {
    TipRow row{advance, {}, double(one.number), double(one.tip.crack), one.tip.position.x(), one.tip.position.y()};
    row.angle = std::atan2(one.tip.direction.y(), one.tip.direction.x()) * 180 / std::numbers::pi;
    row.length = lines_[one.tip.crack].length;
    if (fastest_) row.time = time, row.speed = one.speed;
    record.add(row);
  }
}

post::Cracks BondCracks::drawn() const {
  post::Cracks result;
  for (const auto& line : lines_) result.lines.push_back({line.vertices, line.times});
  for (const auto& one : tips_) result.tips.push_back({one.number, one.tip.crack, one.tip.position});
  return result;
}

}  // namespace fracture
