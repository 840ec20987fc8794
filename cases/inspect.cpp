#include "cases/assembly.hpp"
#include "cases/results.hpp"
#include "cases/run.hpp"
#include "cases/scene.hpp"
#include <fmt/format.h>
#include <sstream>

namespace cases {
namespace {

std::string dynamic_cost(const CaseFile& file, const Assembly& assembly) {
  const auto& constraints = assembly.boundary.constraints;
  const auto& cloud = assembly.boundary.cloud;
  const auto mass = plate::mass(file.content.section, cloud.areas, assembly.boundary.active, constraints);
  const double limit = plate::stable_time_step(assembly.plate, constraints, mass);
  const TimeGrid grid = time_grid(file, limit);
  return fmt::format("time step     {:.6g} (stable limit {:.6g})\nsteps         {}\n", grid.time_step, limit, grid.steps);
}

}  // namespace

std::string cost(const CaseFile& file) {
  Stopwatch stopwatch;
  const Assembly assembly = assemble(file, stopwatch);
  const auto& cloud = assembly.boundary.cloud;
  extrapolations(file, {cloud.positions.begin(), cloud.positions.begin() + std::ptrdiff_t(cloud.plate_points)},
                 assembly.paths);

  // one product, timed, as the measure of a step
  plate::State state = plate::State::Zero(3, Eigen::Index(cloud.size()));
  plate::Forces forces;
  assembly.plate.internal_force(state, forces);
  stopwatch.lap("first product");
  assembly.plate.internal_force(state, forces);
  stopwatch.lap("product");

  std::string text = fmt::format("{}\npoints        {} and {} fictitious\nbonds         {} and {} to fictitious points\n",
                                 file.content.title, cloud.plate_points, assembly.boundary.fictitious.size(),
                                 assembly.bonds(), assembly.fictitious_bonds());
  text += fmt::format("tips          {}\nset-up        {:.2f} s\none step      {:.2e} s\n", assembly.tips.size(),
                      stopwatch.total() - stopwatch.seconds("product"), stopwatch.seconds("product"));
  if (file.content.analysis.kind == Analysis::Kind::dynamic) text += dynamic_cost(file, assembly);
  double bytes = 0;
  for (const auto& part : scene(file.content, assembly)) {
    text += fmt::format("  {:8.0f} bytes per point  {}\n", part.bytes_per_point, part.name);
    bytes += part.bytes_per_point;
  }
  text += fmt::format("memory        {:.3g} GB\n", bytes * double(cloud.plate_points) / 1e9);
  for (const auto& warning : assembly.warnings) text += "warning: " + warning + "\n";
  return text;
}

post::Table srif_again(const std::filesystem::path& folder, const std::vector<std::string>& methods) {
  std::vector<std::string> overrides;
  if (!methods.empty()) {
    std::string list;
    for (const auto& method : methods) list += (list.empty() ? "" : ", ") + fmt::format("\"{}\"", method);
    overrides.push_back("srif.methods=[" + list + "]");
  }
  const CaseFile file = read_case(folder / "case.resolved.toml", overrides);
  const Case& c = file.content;
  const auto run = post::read_run(folder / "state.h5");
  const auto [low, high] = geometry::bounding_box(c.outline);
  const auto paths = geometry::crack_paths(c.outline, c.cracks, 1e-9 * (high - low).norm());
  const auto extract = extrapolations(file, run.positions, paths);

  post::Table table{post::srif_columns(), {}};
  for (std::size_t frame = 0; frame < run.times.size(); ++frame) {
    std::vector<post::Srif> srifs;
    for (std::size_t tip = 0; tip < extract.size(); ++tip) {
      srifs.push_back(extract[tip](run.states[frame]));
      srifs.back().tip = tip;
      post::normalize(srifs.back(), *c.srif, c.section.thickness);
    }
    post::append(table, run.times[frame], srifs);
  }
  return table;
}

}  // namespace cases
