#include "cases/driver/neighbouring_cracks.hpp"

#include <fmt/format.h>
#include <cmath>

#include "plate/formulation/discretised.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/statics.hpp"
#include "plate/solve/validation.hpp"
#include "post/factors/tip_section.hpp"
#include "post/files/table.hpp"

namespace cases {
namespace {

double strain_energy(const plate::Formulation& plate, plate::Analysis analysis) {
  analysis.method = plate::Analysis::Method::cg;
  const auto result = plate::static_solution(plate, analysis, {1e-9, analysis.max_iterations, {}});
  const auto& solution = result.solution;
  if (!solution.converged) throw plate::NumericalError("energy check: conjugate gradients: " + solution.stop_reason);
  const auto load = plate.total_load();
  const auto lift = plate::total_lift(plate);  // of supports, which hold what they move while the crack grows
  const auto& strained = result.what_strains();
  return plate.strain_energy(strained) - 2 * plate::PrescribedDisplacements(plate, load, lift).work(strained);
}

/// Strain energies of a plate, and of the plate in its plane, where loads act there.
struct StrainEnergies {
  double bending, in_plane;
};

StrainEnergies strain_energies(const plate::Problem& problem, const plate::Analysis& analysis) {
  const auto [plate, membrane, warnings, stopwatch] = plate::discretise(problem);
  auto refusals = plate::validate(*plate, analysis).refusals;
  if (refusals.empty() && membrane) refusals = plate::loose(*membrane);
  if (!refusals.empty()) throw plate::Refused(std::move(refusals));
  return {strain_energy(*plate, analysis), membrane ? strain_energy(*membrane, analysis) : 0};
}

/// The problem with the tip moved straight ahead by `step`.
plate::Problem moved(plate::Problem problem, const geometry::Tip& tip, double step) {
  auto& vertices = problem.cracks[tip.crack];
  auto& end = tip.at_back ? vertices.back() : vertices.front();
  end += step * tip.direction;
  return problem;
}

}  // namespace

post::Table energy_check(const plate::Problem& problem, const plate::Analysis& analysis) {
  if (problem.coupled())
    throw plate::Refused({{plate::Subject::cracks, 0,
                           "the energy check is of plates whose bending and stretching are not coupled: leave --energy "
                           "out"}});
  const auto paths = plate::crack_paths(problem);
  post::Table table{{"tip", "x", "y", "step", "G", "K"}, {}};
  const bool in_plane = plate::loaded_in_plane(problem);
  if (in_plane) table.columns.insert(table.columns.end(), {"G_in_plane", "N"});
  const auto tips = geometry::tips(paths);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const auto& tip = tips[i];
    const bool along_lattice = tip.direction.cwiseAbs().minCoeff() < 1e-9;
    const double step = (along_lattice ? 1 : 6) * problem.discretization.spacing;
    const auto& v = paths[tip.crack].vertices;
    const double last = tip.at_back ? (v.back() - v[v.size() - 2]).norm() : (v.front() - v[1]).norm();
    if (last <= 2 * step)
      throw plate::Refused(
          {{plate::Subject::cracks, 0,
            fmt::format("the energy check moves the tip at ({:g}, {:g}) by {:g}, the crack is {:g} long there",
                        tip.position.x(), tip.position.y(), step, last)}});
    const auto longer = strain_energies(moved(problem, tip, step), analysis),
               shorter = strain_energies(moved(problem, tip, -step), analysis);
    const double G = (longer.bending - shorter.bending) / (2 * step);
    auto section = problem.section.at(tip.position);
    const auto factor = [&](double release) {
      return std::sqrt(std::max(release, 0.0) / post::TipSection(section, tip.direction).unit_release()[0]);
    };
    table.rows.push_back({double(i), tip.position.x(), tip.position.y(), step, G, factor(G)});
    if (!in_plane) continue;
    const double G_in_plane = (longer.in_plane - shorter.in_plane) / (2 * step);
    section.law = plate::PlateLaw::membrane;
    table.rows.back().insert(table.rows.back().end(), {G_in_plane, factor(G_in_plane)});
  }
  return table;
}

}  // namespace cases
