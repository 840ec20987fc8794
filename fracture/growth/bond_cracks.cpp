#include "fracture/growth/bond_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/shape/crack_extension.hpp"

namespace fracture {
namespace {

constexpr double jump = 2;          // spacings that a tip may seem to go at once: it stands between points
constexpr double static_jump = 20;  // spacings
constexpr double speed_way = 8;     // spacings

bool neighbours(const geometry::Point& p, const geometry::Point& q) {
  return std::abs((p - q).norm() - 1) < 0.01;
}

}  // namespace

BondCracks::BondCracks(const plate::Formulation& plate, std::optional<double> fastest)
    : units_(plate.cloud().units),
      given_(plate.paths()),
      fastest_(fastest),
      lattice_(plate.boundary().lattice.begin(),
               plate.boundary().lattice.begin() + std::ptrdiff_t(plate.cloud().plate_points)) {
  geometry::Point low = lattice_.front(), high = low;
  for (const auto& x : lattice_) low = low.cwiseMin(x), high = high.cwiseMax(x);
  low_ = {int(std::floor(low.x())), int(std::floor(low.y()))};
  columns_ = int(std::ceil(high.x())) - low_[0] + 1, rows_ = int(std::ceil(high.y())) - low_[1] + 1;
  cells_.assign(std::size_t(columns_ * rows_), 0);
  std::map<geometry::CrackGraph::Corner, std::uint32_t> at;
  for (std::uint32_t k = 0; k < lattice_.size(); ++k) {
    const int x = int(std::floor(lattice_[k].x())) - low_[0], y = int(std::floor(lattice_[k].y())) - low_[1];
    at[{x, y}] = k;
    for (const int corner :
         {y * columns_ + x, y * columns_ + x + 1, (y + 1) * columns_ + x, (y + 1) * columns_ + x + 1})
      ++cells_[std::size_t(corner)];
  }
  const auto paths = geometry::to_lattice(plate.paths(), units_);
  for (const auto& [cell, k] : at)
    for (const auto& next : {geometry::CrackGraph::Corner{cell[0] + 1, cell[1]}, {cell[0], cell[1] + 1}}) {
      const auto found = at.find(next);
      if (found == at.end()) continue;
      for (const auto& path : paths)
        if (geometry::severs(path, lattice_[k], lattice_[found->second]))
          graph_.part(lattice_[k], lattice_[found->second], 0);
    }
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
  lines_ = graph_.lines([this](const geometry::CrackGraph::Corner& corner) {
    return cells_[std::size_t((corner[1] - low_[1]) * columns_ + corner[0] - low_[0])] == 4;
  });
  for (auto& line : lines_) {
    for (auto& x : line.vertices) x = units_.from_lattice(x);
    line.length *= units_.spacing;
  }
}

bool BondCracks::broke(const std::vector<LoadedBond>& bonds, double time) {
  const auto before = graph_.sides();
  for (const auto& [bond, demand] : bonds)
    if (const auto& p = lattice_[bond[0]], &q = lattice_[bond[1]]; neighbours(p, q))
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

/// The nearest tip of the last look that no other has come from, moved on; or a new one.
BondTip BondCracks::seen_again(const geometry::Tip& tip, double time, std::vector<char>& taken) {
  double least = fastest_ ? jump * units_.spacing + *fastest_ * (time - time_) : static_jump * units_.spacing;
  std::size_t same = tips_.size();
  for (std::size_t i = 0; i < tips_.size(); ++i)
    if (const double away = (tips_[i].tip.position - tip.position).norm(); !taken[i] && away <= least)
      least = away, same = i;
  if (same == tips_.size()) return {seen_++, tip, 0, {{time, tip.position}}};
  taken[same] = 1;
  BondTip result = tips_[same];
  result.tip = tip;
  const auto far = [&](const auto& place) {
    return (place.second - tip.position).norm() >= speed_way * units_.spacing;
  };
  while (result.way.size() > 1 && far(result.way[1])) result.way.pop_front();
  const auto& [then, there] = result.way.front();
  if (time > then && far(result.way.front())) result.speed = (tip.position - there).norm() / (time - then);
  result.way.emplace_back(time, tip.position);
  return result;
}

void BondCracks::look(double time, Record& record, double advance) {
  find_lines();
  std::vector<BondTip> found;
  std::vector<char> taken(tips_.size(), 0);
  for (const auto& tip : geometry::tips(paths())) found.push_back(seen_again(tip, time, taken));
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
