#include "fracture/growth/motion/moving_tips.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "fracture/growth/archive.hpp"

namespace fracture {

MovingTips::MovingTips(const Growth& growth, const plate::Formulation& start, std::optional<post::SrifOptions> factors,
                       double rotary_inertia)
    : MovingGrowth(growth, start, std::move(factors), rotary_inertia),
      cracks_(growth, start.problem(), plate_, start.paths()) {}

const Record& MovingTips::record() {
  record_ = {};
  record_.in_motion = true;
  double length = 0, spent = 0;
  for (const auto& path : start_.paths()) {
    record_.cracks.lines.push_back({path.vertices, std::vector<double>(path.vertices.size(), 0)});
    length += geometry::length(path.vertices);
  }
  for (std::size_t i = 0; i < cracks_.pieces().size(); ++i) {
    const auto& piece = cracks_.pieces()[i];
    const geometry::Point step = piece.to - piece.from;
    auto& [vertices, times] = record_.cracks.lines[piece.crack];
    vertices.insert(piece.at_back ? vertices.end() : vertices.begin(), piece.to);
    times.insert(piece.at_back ? times.end() : times.begin(), piece.end);
    TipRow tip{double(i), piece.end, double(piece.tip), double(piece.crack), piece.to.x(), piece.to.y()};
    tip.angle = std::atan2(step.y(), step.x()) * 180 / std::numbers::pi;
    tip.length = geometry::length(vertices);
    tip.begin = piece.begin, tip.piece = step.norm(), tip.speed = step.norm() / (piece.end - piece.begin),
    tip.spent = piece.spent;
    tip.reached = piece.reached;
    record_.add(tip);
    length += step.norm();
    spent += piece.spent * growth_.fracture_energy * start_.section().thickness * step.norm();
    GrowthRow row{double(i), piece.end};
    row.crack_length = length, row.tips = piece.tips, row.fracture_energy = spent;
    record_.add(row);
  }
  for (const auto& [number, tip] : cracks_.tips()) record_.cracks.tips.push_back({number, tip.crack, tip.position});
  return record_;
}

Moved MovingTips::moved() const {
  auto result = moved_so_far();
  const auto& pieces = cracks_.pieces();
  result.advances = pieces.size();
  for (const auto& piece : pieces) {
    if (!piece.reached.empty()) result.reached.push_back(piece.reached);
    result.largest_speed = std::max(result.largest_speed, (piece.to - piece.from).norm() / (piece.end - piece.begin));
  }
  for (const auto& [time, tip, position, asked, error, spent] : cracks_.stopped()) {
    const auto where = fmt::format("tip {} at ({:g}, {:g}) at t = {:.4g}", tip, position.x(), position.y(), time);
    if (spent > 0)
      result.unsteady.push_back(
          fmt::format("{} took {:.2g} times the fracture energy over five spacings", where, spent));
    else
      result.stopped.push_back(fmt::format("{} would turn by {:.0f} degrees, which is not known within {:.0f}", where,
                                           asked * 180 / std::numbers::pi, error * 180 / std::numbers::pi));
  }
  result.unseen = cracks_.unseen();
  result.spent = growth_.spent(cracks_.fracture_energy(), start_.section().thickness, cracks_.length());
  for (const auto& path : cracks_.paths()) result.lengths.push_back(geometry::length(path.vertices));
  return result;
}

void MovingTips::remember(plate::OutArchive& archive) const {
  memory(archive, *this);
  archive(cracks_);
}

void MovingTips::recall(plate::InArchive& archive) {
  memory(archive, *this);
  archive(cracks_);
}

}  // namespace fracture
