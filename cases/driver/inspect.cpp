#include <fmt/format.h>
#include <sstream>
#include "cases/driver/assembly.hpp"
#include "cases/input/formulations.hpp"
#include "cases/driver/gate.hpp"
#include "cases/driver/results.hpp"
#include "cases/driver/run.hpp"
#include "cases/driver/scene.hpp"

namespace cases {
namespace {

std::string dynamic_cost(const CaseFile& file, const Assembly& assembly) {
  if (file.content.analysis.method == Analysis::Method::lanczos)
    return fmt::format("rows          {} of Lanczos vectors, which take no steps\n", row_grid(file).steps);
  const auto& constraints = assembly.boundary.constraints;
  const double limit = plate::stable_time_step(assembly.plate(), constraints, mass_of(file.content, assembly));
  const TimeGrid grid = time_grid(file, limit);
  return fmt::format("time step     {:.6g} (stable limit {:.6g})\nsteps         {}\n", grid.time_step, limit, grid.steps);
}

}  // namespace

std::string cost(const CaseFile& file) {
  const Case& c = file.content;
  Stopwatch stopwatch;
  Assembly assembly = assemble(file, stopwatch);
  const auto& cloud = assembly.boundary.cloud;
  check_growing_tips(file, assembly);
  tip_methods(file, assembly);

  // one product, timed, as the measure of a step
  plate::State state = plate::State::Zero(3, Eigen::Index(cloud.size()));
  plate::Forces forces;
  assembly.plate().internal_force(state, forces);
  stopwatch.lap("first product");
  assembly.plate().internal_force(state, forces);
  stopwatch.lap("product");

  std::string text = fmt::format(
      "{}\nformulation   {} ({})\npoints        {} and {} fictitious\nbonds         {} and {} to fictitious points\n",
      file.content.title, formulation_name(file.content.discretization.formulation), file.content.formulation_reason,
      cloud.plate_points, assembly.boundary.fictitious.size(), assembly.bonds(), assembly.fictitious_bonds());
  text += fmt::format("tips          {}\nset-up        {:.2f} s\none step      {:.2e} s\n", assembly.tips.size(),
                      stopwatch.total() - stopwatch.seconds("product"), stopwatch.seconds("product"));
  if (file.content.analysis.kind == Analysis::Kind::dynamic) text += dynamic_cost(file, assembly);
  double bytes = 0;
  for (const auto& part : scene(file.content, assembly)) {
    text += fmt::format("  {:8.0f} bytes per point  {}\n", part.bytes_per_point, part.name);
    bytes += part.bytes_per_point;
  }
  text += fmt::format("memory        {:.3g} GB\n", bytes * double(cloud.plate_points) / 1e9);
  if (c.srif && c.srif->accuracy)
    text += "srif.accuracy finds the discretisation: these are the first points of the search\n";
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
  if (c.growth)
    throw CaseError({{file.place("growth"), "growth", "the cracks have grown since: srif.csv of the run has their factors "
                                                      "along the way"}});
  const auto run = post::read_run(folder / "state.h5");
  Stopwatch stopwatch;
  const Assembly assembly = assemble(file, stopwatch);
  const auto extract = tip_methods(file, assembly);
  const auto& cloud = assembly.boundary.cloud;
  if (!c.srif || run.positions.size() != cloud.plate_points)
    throw std::runtime_error("state.h5 does not belong to case.resolved.toml");

  post::Table table{post::srif_columns(), {}};
  plate::State state = plate::State::Zero(3, Eigen::Index(cloud.size()));
  for (std::size_t frame = 0; frame < run.times.size(); ++frame) {
    state.leftCols(Eigen::Index(cloud.plate_points)) = run.states[frame];
    assembly.boundary.constraints.impose(state);
    const auto found = srifs(c, assembly, extract, state);
    require_finite(found, fmt::format("at time {:g}", run.times[frame]));
    post::append(table, run.times[frame], found);
  }
  return table;
}

}  // namespace cases
