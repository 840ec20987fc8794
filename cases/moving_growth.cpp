#include "cases/moving_growth.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "cases/results.hpp"
#include "post/mesh.hpp"
#include "post/vtk.hpp"

namespace cases {

MovingGrowth::MovingGrowth(const CaseFile& file, const Assembly& assembly)
    : case_(file.content), assembly_(assembly), plate_(*assembly.ordinary(), assembly.boundary, case_.section),
      cracks_(*case_.growth, case_.section, case_.outline, plate_, assembly.paths, case_.discretization.spacing,
              [this](const auto& paths, const auto& tip) { return gauge(paths, tip); }) {}

post::TipMethods MovingGrowth::methods(const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip,
                                       const post::SrifOptions& options, double reach) const {
  const auto& cloud = assembly_.boundary.cloud;
  const post::BondedPlate plate{cloud.positions,    cloud.areas,   plate_.families(),           assembly_.ordinary()->shapes(),
                                cloud.plate_points, case_.section, case_.discretization.spacing};
  return {plate, post::TipPlace{tip, paths[tip.crack], std::min(reach, clear_distance(case_, paths, tip))},
          case_.discretization.horizon(), options};
}

fracture::Gauge MovingGrowth::gauge(const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip) const {
  post::SrifOptions options;
  options.methods = {"virtual_crack_extension"};
  options.first_ring_only = true;
  const double near = 7.6 * case_.discretization.spacing;  // rings of 7 spacings: a quarter of the work of the usual 16
  try {
    const auto found = std::make_shared<post::TipMethods>(methods(paths, tip, options, near));
    return [found](const plate::State& state, const plate::Forces& force) -> fracture::Drive {
      const auto srif = (*found)(state, force, false).front();
      return {*srif.G, {srif.K1, srif.K2, srif.K3}};
    };
  } catch (const std::invalid_argument&) {
    return {};  // an edge or another crack is too near
  }
}

std::vector<post::Srif> MovingGrowth::srifs(const plate::State& state) const {
  std::vector<post::Srif> result;
  if (!case_.srif) return result;
  plate::Forces force;
  plate_.internal_force(state, force);
  for (const auto& [number, tip] : cracks_.tips()) try {
      for (auto& srif : methods(cracks_.paths(), tip, *case_.srif)(state, force, false)) {
        srif.tip = number;
        post::normalize(srif, *case_.srif, case_.section.thickness);
        result.push_back(std::move(srif));
      }
    } catch (const std::invalid_argument&) {
      continue;  // an edge or another crack is too near
    }
  return result;
}

post::Mesh MovingGrowth::draw(post::Frame& frame, const plate::State& state) const {
  const auto& first = assembly_.families();
  const auto& cloud = assembly_.boundary.cloud;
  frame.resultants = plate::resultants(state, plate_.families(), assembly_.ordinary()->shapes(), cloud.areas,
                                       cloud.plate_points, case_.section);
  frame.damage.assign(cloud.plate_points, 0);
  const auto weight = [&](const geometry::Families& families, std::size_t k) {
    double sum = 0;
    for (const auto& bond : families[k]) sum += assembly_.ordinary()->shapes()[bond.vector_id].weight;
    return sum;
  };
  for (std::size_t k = 0; k < frame.damage.size(); ++k)
    if (plate_.families()[k].size() < first[k].size()) frame.damage[k] = 1 - weight(plate_.families(), k) / weight(first, k);
  return post::mesh(assembly_.boundary, plate_.families(), assembly_.cut, case_.section.thickness);
}

void MovingGrowth::write(const std::filesystem::path& folder, bool lines) const {
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

post::GrowthSummary MovingGrowth::summary() const {
  post::GrowthSummary result;
  const auto& pieces = cracks_.pieces();
  result.advances = pieces.size();
  std::vector<std::string> reached;
  result.largest_speed = 0;
  for (const auto& piece : pieces) {
    if (!piece.reached.empty()) reached.push_back(piece.reached);
    result.largest_speed = std::max(*result.largest_speed, (piece.to - piece.from).norm() / (piece.end - piece.begin));
  }
  const auto parts = plate::pieces(assembly_.boundary, plate_.families()).size();
  result.outcome = pieces.empty() ? "no growth" : fmt::format("{} pieces of crack", pieces.size());
  if (!reached.empty()) result.outcome += fmt::format(", {} reached", fmt::join(reached, ", "));
  if (parts > plate::pieces(assembly_.boundary, assembly_.families()).size())
    result.outcome += fmt::format("; the plate split in {} parts, which move on", parts);
  if (cracks_.length() > 0)
    result.spent = cracks_.fracture_energy() / (case_.growth->fracture_energy * case_.section.thickness * cracks_.length());
  for (const auto& path : cracks_.paths()) result.lengths.push_back(geometry::length(path.vertices));
  return result;
}

}  // namespace cases
