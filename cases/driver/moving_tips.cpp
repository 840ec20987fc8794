#include "cases/driver/moving_tips.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "cases/driver/severed_frame.hpp"
#include "post/files/table.hpp"
#include "post/files/vtk.hpp"

namespace cases {

MovingTips::MovingTips(const CaseFile& file, const Assembly& assembly)
    : MovingGrowth(file, assembly),
      cracks_(*case_.growth, case_.section, case_.outline, plate_, assembly.paths, case_.discretization.spacing,
              [this](const auto& now, const auto& tip) { return gauge(now, tip); }) {}

fracture::Gauge MovingTips::gauge(const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip) const {
  post::SrifOptions options;
  options.methods = {"virtual_crack_extension"};
  options.first_ring_only = true;
  const double near = 7.6 * case_.discretization.spacing;  // rings of 7 spacings: a quarter of the work of the usual 16
  try {
    const auto found = std::make_shared<post::TipMethods>(severed_tip_methods(case_, assembly_, plate_.families(), paths, tip, options, near));
    return [found](const plate::State& state, const plate::Forces& force) -> fracture::Drive {
      const auto srif = (*found)(state, force, false).front();
      return {*srif.G, {srif.K1, srif.K2, srif.K3}};
    };
  } catch (const std::invalid_argument&) {
    return {};  // an edge or another crack is too near
  }
}

void MovingTips::write(const std::filesystem::path& folder, bool lines) const {
  post::Table growth{{"time", "end", "crack", "at_back", "x", "y", "angle", "length", "speed", "spent", "reached"}, {}};
  std::vector<post::CrackLine> cracks;
  for (const auto& path : assembly_.paths) cracks.push_back({path.vertices, std::vector<double>(path.vertices.size(), 0)});
  for (const auto& piece : cracks_.pieces()) {
    const geometry::Point step = piece.to - piece.from;
    growth.rows.push_back({piece.begin, piece.end, double(piece.crack), double(piece.at_back), piece.to.x(), piece.to.y(),
                           std::atan2(step.y(), step.x()) * 180 / std::numbers::pi, step.norm(),
                           step.norm() / (piece.end - piece.begin), piece.spent, piece.reached});
    auto& [vertices, times] = cracks[piece.crack];
    vertices.insert(piece.at_back ? vertices.end() : vertices.begin(), piece.to);
    times.insert(piece.at_back ? times.end() : times.begin(), piece.end);
  }
  post::write_csv(folder / "growth.csv", growth);
  post::Table table{{"crack", "vertex", "x", "y", "time"}, {}};
  for (std::size_t c = 0; c < cracks.size(); ++c)
    for (std::size_t i = 0; i < cracks[c].vertices.size(); ++i)
      table.rows.push_back({double(c), double(i), cracks[c].vertices[i].x(), cracks[c].vertices[i].y(), cracks[c].advances[i]});
  post::write_csv(folder / "cracks.csv", table);
  if (lines) post::write_crack_lines(folder / "cracks.vtp", cracks);
}

post::GrowthSummary MovingTips::summary() const {
  post::GrowthSummary result;
  const auto& pieces = cracks_.pieces();
  result.advances = pieces.size();
  std::vector<std::string> reached;
  result.largest_speed = 0;
  for (const auto& piece : pieces) {
    if (!piece.reached.empty()) reached.push_back(piece.reached);
    result.largest_speed = std::max(*result.largest_speed, (piece.to - piece.from).norm() / (piece.end - piece.begin));
  }
  result.outcome = pieces.empty() ? "no growth" : fmt::format("{} pieces of crack", pieces.size());
  if (!reached.empty()) result.outcome += fmt::format(", {} reached", fmt::join(reached, ", "));
  result.outcome += parts();
  if (cracks_.length() > 0)
    result.spent = cracks_.fracture_energy() / (case_.growth->fracture_energy * case_.section.thickness * cracks_.length());
  for (const auto& path : cracks_.paths()) result.lengths.push_back(geometry::length(path.vertices));
  return result;
}

}  // namespace cases
