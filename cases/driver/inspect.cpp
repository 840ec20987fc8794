#include <fmt/format.h>
#include <sstream>
#include "cases/driver/discretised.hpp"
#include "cases/driver/results.hpp"
#include "cases/driver/run.hpp"
#include "cases/report/scene.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/gate.hpp"
#include "post/files/hdf5/state_file.hpp"

namespace cases {
namespace {

std::string dynamic_cost(const CaseFile& file, const plate::Formulation& plate) {
  if (file.content.analysis.method == Analysis::Method::lanczos)
    return fmt::format("rows          {} of Lanczos vectors, which take no steps\n", row_grid(file).steps);
  const auto& constraints = plate.constraints();
  const double limit = plate::stable_time_step(plate, constraints, plate.mass(file.content.analysis.rotary_inertia));
  const TimeGrid grid = time_grid(file, limit);
  return fmt::format("time step     {:.6g} (stable limit {:.6g})\nsteps         {}\n", grid.time_step, limit,
                     grid.steps);
}

}  // namespace

std::string cost(const CaseFile& file) {
  const Case& c = file.content;
  auto [own, warnings, stopwatch] = discretised(file);
  const auto& plate = *own;
  const auto& cloud = plate.cloud();
  check_growing_tips(file, plate, warnings);
  tip_methods(file, plate);

  // one product, timed, as the measure of a step
  plate::State state = plate::State::Zero(3, Eigen::Index(cloud.size()));
  plate::Forces forces;
  plate.internal_force(state, forces);
  stopwatch.lap("first product");
  plate.internal_force(state, forces);
  stopwatch.lap("product");

  std::string text = fmt::format(
      "{}\nformulation   {} ({})\npoints        {} and {} fictitious\nbonds         {} and {} to fictitious points\n",
      file.content.title, plate.kind().name, file.content.formulation_reason, cloud.plate_points,
      plate.fictitious_points(), plate.bonds(), plate.fictitious_bonds());
  text += fmt::format("tips          {}\nset-up        {:.2f} s\none step      {:.2e} s\n", plate.tips().size(),
                      stopwatch.total() - stopwatch.seconds("product"), stopwatch.seconds("product"));
  if (file.content.analysis.kind == Analysis::Kind::dynamic) text += dynamic_cost(file, plate);
  double bytes = 0;
  for (const auto& part : scene(file.content, plate)) {
    text += fmt::format("  {:8.0f} bytes per point  {}\n", part.bytes_per_point, part.name);
    bytes += part.bytes_per_point;
  }
  text += fmt::format("memory        {:.3g} GB\n", bytes * double(cloud.plate_points) / 1e9);
  if (c.srif && c.srif->accuracy)
    text += "srif.accuracy finds the discretisation: these are the first points of the search\n";
  for (const auto& warning : warnings) text += "warning: " + warning + "\n";
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
    throw CaseError({{file.place("growth"), "growth",
                      "the cracks have grown since: srif.csv of the run has their factors "
                      "along the way"}});
  const auto run = post::read_run(folder / "state.h5");
  const auto own = discretised(file);
  const auto& plate = *own.plate;
  const auto extract = tip_methods(file, plate);
  const auto& cloud = plate.cloud();
  if (!c.srif || run.positions.size() != cloud.plate_points)
    throw std::runtime_error("state.h5 does not belong to case.resolved.toml");

  post::Table table{post::srif_columns(), {}};
  plate::State state = plate::State::Zero(3, Eigen::Index(cloud.size()));
  for (std::size_t frame = 0; frame < run.times.size(); ++frame) {
    state.leftCols(Eigen::Index(cloud.plate_points)) = run.states[frame];
    plate.constraints().impose(state);
    const auto found = post::srifs(plate, *c.srif, extract, state);
    post::require_finite(found, fmt::format("at time {:g}", run.times[frame]));
    post::append(table, run.times[frame], found);
  }
  return table;
}

}  // namespace cases
