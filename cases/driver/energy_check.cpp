#include "cases/driver/energy_check.hpp"

#include "cases/driver/discretised.hpp"

#include <fmt/format.h>
#include <cmath>
#include "cases/driver/static_solution.hpp"
#include "plate/model/numerical_error.hpp"
#include "post/factors/tip_integrals.hpp"
#include "post/files/table.hpp"

namespace cases {
namespace {

double strain_energy(const CaseFile& file) {
  const auto found = discretised(file);
  const auto& plate = *found.plate;
  Case c = file.content;
  c.analysis.method = Analysis::Method::cg;
  const auto solution = static_solution(c, plate, {1e-9, c.analysis.max_iterations, {}}).solution;
  if (!solution.converged) throw plate::NumericalError("energy check: conjugate gradients: " + solution.stop_reason);
  return plate.strain_energy(solution.state);
}

/// The case with the tip moved straight ahead by `step`.
CaseFile moved(const CaseFile& file, const geometry::Tip& tip, double step) {
  CaseFile result = file;
  auto& vertices = result.content.cracks[tip.crack];
  auto& end = tip.at_back ? vertices.back() : vertices.front();
  end += step * tip.direction;
  return result;
}

}  // namespace

post::Table energy_check(const CaseFile& file) {
  const Case& c = file.content;
  if (c.analysis.kind != Analysis::Kind::static_)
    throw CaseError({{file.place("analysis.kind"), "analysis.kind", "the energy check needs a static case"}});
  const auto paths = plate::crack_paths(c);
  post::Table table{{"tip", "x", "y", "step", "G", "K"}, {}};
  const auto tips = geometry::tips(paths);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const auto& tip = tips[i];
    const bool along_lattice = tip.direction.cwiseAbs().minCoeff() < 1e-9;
    const double step = (along_lattice ? 1 : 6) * c.discretization.spacing;
    const auto& v = paths[tip.crack].vertices;
    const double last = tip.at_back ? (v.back() - v[v.size() - 2]).norm() : (v.front() - v[1]).norm();
    if (last <= 2 * step)
      throw CaseError(
          {{file.place("geometry.cracks"), "geometry.cracks",
            fmt::format("the energy check moves the tip at ({:g}, {:g}) by {:g}, the crack is {:g} long there",
                        tip.position.x(), tip.position.y(), step, last)}});
    const double G = (strain_energy(moved(file, tip, step)) - strain_energy(moved(file, tip, -step))) / (2 * step);
    table.rows.push_back({double(i), tip.position.x(), tip.position.y(), step, G,
                          std::sqrt(std::max(G, 0.0) / post::unit_release(c.section)[0])});
  }
  return table;
}

}  // namespace cases
