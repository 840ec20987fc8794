#include <fmt/format.h>

#include "cases/runs/analyses.hpp"
#include "cases/runs/results.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/buckling.hpp"
#include "plate/solve/coupled_modes.hpp"
#include "plate/solve/coupled_plate.hpp"
#include "plate/solve/large_deflections.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "post/files/result_checks.hpp"
#include "post/report/curve_plot.hpp"
#include "post/report/curves.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

/// Equilibrium of a plate whose middle plane stretches.
class LargeDeflectionRun : public AnalysisWithResults {
public:
  using AnalysisWithResults::AnalysisWithResults;

  void solve() override;
  void finish() override;
};

bool is_constant(const plate::TimedLoad& load) {
  return load.history.kind == plate::History::Kind::constant;
}

/// The loads that are constant, or those that grow, beside which the constant ones act.
plate::PlateLoads loads_of(const plate::Formulation& plate, const plate::Formulation& membrane, bool constant) {
  plate::PlateLoads result{plate::zero_forces(plate.points()), plate::zero_forces(plate.points())};
  std::vector<double> shares;
  for (std::size_t i = 0; i < plate.loads().size(); ++i) {
    shares.push_back(is_constant(plate.loads()[i]) == constant ? 1 : 0);
    result.across += shares[i] * plate.loads()[i].forces, result.in_plane += shares[i] * membrane.loads()[i].forces;
  }
  result.heat = plate::stiffness_of_heat(membrane, plate::heat_of(membrane, shares));
  if (!plate::heated(plate.problem())) return result;
  result.stored = [&, constant](double share, const plate::State& bending, const plate::State& in_plane) {
    std::vector<double> now;
    for (const auto& load : plate.loads()) now.push_back(is_constant(load) == constant ? share : constant ? 0 : 1);
    return plate::stored(plate, plate::heat_of(plate, now), bending) +
           plate::stored(membrane, plate::heat_of(membrane, now), in_plane);
  };
  return result;
}

void LargeDeflectionRun::solve() {
  const auto& analysis = content().analysis;
  auto& summary = this->summary();
  post::Progress progress(quiet(), "large deflections");
  const plate::LargeDeflectionOptions options{
      analysis.tolerance,
      [&](double factor, std::size_t iteration, double residual) {
        progress.update(factor,
                        fmt::format("load factor {:.3g}, iteration {}, residual {:.1e}", factor, iteration, residual));
      },
      analysis.control, analysis.max_steps};
  const auto& membrane = *ready_.membrane;
  const auto heat = plate::heat_of(membrane, 1);
  const auto constant = loads_of(plate_, membrane, true);
  auto loads = loads_of(plate_, membrane, false);
  if (std::ranges::any_of(plate_.loads(), is_constant)) loads.constant = &constant;
  const auto found = plate::StretchedPlate(plate_, membrane).equilibrium(loads, options);
  progress.done();
  stopwatch().lap("solve");

  auto& about = summary.analysis;
  about.method = "newton", about.iterations = found.iterations, about.tolerance = analysis.tolerance;
  about.residual = found.steps.empty() ? 0 : found.steps.back().residual, about.stop_reason = found.stop_reason;
  summary.load_steps = load_steps(found.steps, analysis.control);
  summary.scene.push_back({"factor", "", double(found.factor_bytes) / double(plate_.cloud().plate_points), 0});
  auto in_plane = membrane_results(plate_, membrane, found, membrane.total_load(), heat,
                                   {content().srif, ready_.membrane_methods}, "in the plane");
  const double strain = found.strain_energy() + in_plane.stored, work = found.external_work + in_plane.stored;
  plate::Instant end{found.iterations, 0, found.bending, {}, 0, work, strain, 0, 0};
  end.stretched = &found.on_bending;
  const double stretching = in_plane.summary.strain_energy, stored = in_plane.stored;
  results_.in_plane(membrane, std::move(in_plane));
  if (content().faces_touch()) results_.touching(faces_found(found.touching, plate_));
  results_.sample(end, true);
  summary.membrane->external_work = results_.external_work();  // of all loads, with what heat across the plate puts in
  stopwatch().lap("srif");
  results_.frame(end);
  summary.energy = {{"strain", results_.strain_energy()},
                    {"bending", found.bending_energy + (results_.strain_energy() - strain)},
                    {"stretching", stretching},
                    {"external_work", results_.external_work()}};
  if (content().coupled()) summary.energy.emplace_back("coupling", found.coupling_energy);
  if (strain == 0 && found.converged)
    post::require_motion(plate_, post::forces_of(plate_), found.bending, found.external_work, summary.warnings);
  outputs_.warn(warnings_about(found, stored, content()));
  if (!found.converged) throw plate::NumericalError("large deflections: " + found.stop_reason);
}

void LargeDeflectionRun::finish() {
  auto& recorder = outputs_.recorder();
  const auto& steps = summary().load_steps;
  recorder.table("load_steps", steps);
  if (content().analysis.control == plate::LoadControl::arc_length && recorder.plots())
    recorder.picture("curves", post::to_svg(post::curves_of_path(content().title, steps, content().si())));
  results_.finish();
}

/// Equilibrium of a plate whose bending and stretching are coupled.
class CoupledRun : public AnalysisWithResults {
public:
  using AnalysisWithResults::AnalysisWithResults;

  void solve() override;
};

void CoupledRun::solve() {
  const auto& analysis = content().analysis;
  auto& summary = this->summary();
  post::Progress progress(quiet(), "factorisation");
  const auto& membrane = *ready_.membrane;
  const plate::PlateLoads loads{plate_.total_load(), membrane.total_load()};
  const plate::CoupledPlate both(plate_, membrane);
  const auto lift = plate::total_lift(plate_);
  const auto found = both.equilibrium(loads, {analysis.tolerance, analysis.max_iterations, {}}, lift);
  progress.done();
  stopwatch().lap("solve");

  post::describe(summary.analysis, "direct", found.of_both, analysis.tolerance);
  summary.scene.push_back({"factor", "", double(both.factor_bytes()) / double(plate_.cloud().plate_points), 0});
  require_equilibrium(plate_, found.of_both, analysis.tolerance, "in equilibrium");
  auto in_plane = membrane_results(plate_, membrane, found, loads, plate::heat_of(membrane, 1),
                                   {content().srif, ready_.membrane_methods}, "in the plane");
  const double strain = found.strain_energy(), work = post::slow_work(plate_, loads.across, found.bending) +
                                                      post::slow_work(membrane, loads.in_plane, found.membrane) +
                                                      work_of_supports(plate_, found, loads.across, lift);
  const double stretching = in_plane.summary.strain_energy, stored = in_plane.stored;
  plate::Instant end{found.of_both.iterations, 0, found.bending, {}, 0, work + stored, strain + stored, 0, -2 * work};
  end.stretched = &found.on_bending;
  if (found.strained.cols() > 0) end.rest = &found.strained;
  results_.in_plane(membrane, std::move(in_plane));
  summary.lifted = found.lifted;
  if (found.touching) results_.touching(faces_found(*found.touching, plate_));
  results_.sample(end, true);
  stopwatch().lap("srif");
  results_.frame(end);
  summary.energy = {{"strain", results_.strain_energy()},
                    {"bending", found.bending_energy + (results_.strain_energy() - strain - stored)},
                    {"stretching", stretching},
                    {"coupling", found.coupling_energy},
                    {"external_work", results_.external_work()}};
  // of beams that act in the plane this would be a part only
  if (std::ranges::none_of(content().stiffeners, &plate::Stiffener::stretches))
    add_elastic_support_energy(plate_, found.bending, summary);
  const bool only_heat = only_stored(strain, results_.strain_energy() - strain);
  if (strain == 0 && results_.strain_energy() == 0)
    post::require_motion(plate_, post::forces_of(plate_), found.bending, work, summary.warnings);
  else if (!only_heat)
    post::EnergyBalance(post::EnergyBalance::Plate::rests)
        .check({strain + post::energy_about(plate_), strain, work}, "in equilibrium");
}

std::vector<plate::BucklingMode> buckling_modes(const Case& c, const plate::Formulation& plate,
                                                const plate::Formulation& membrane,
                                                const plate::PointMatrix& geometric) {
  const auto& [modes, tolerance] = std::tie(c.analysis.modes, c.analysis.tolerance);
  return c.coupled() ? plate::coupled_buckling(plate, membrane, geometric, modes, tolerance)
                     : plate::buckling(plate, geometric, modes, tolerance);
}

/// Factors of the same case with all spacings twice as wide; none where no such plate can be had. A plate of too few
/// points to be shared is made whole by every rank.
std::vector<double> coarser_buckling(const Case& c, const plate::Communicator& all) {
  Case coarse = c;
  coarse.discretization = widened(c.discretization, 2);
  std::vector<double> result;
  try {
    const auto made = plate::discretise(coarse, all);
    for (const auto* one : {made.plate.get(), made.membrane.get()})
      if (!one->held() || one->may_move()) return result;
    const auto geometric = c.coupled() ? plate::coupled_prestress(*made.plate, *made.membrane).geometric
                                       : plate::prestress(*made.membrane);
    for (const auto& mode : buckling_modes(c, *made.plate, *made.membrane, geometric)) result.push_back(mode.factor);
  } catch (const plate::Refused&) {
    return all.distributed() ? coarser_buckling(c, plate::single_process()) : std::vector<double>();
  } catch (const plate::NumericalError&) {
    return {};
  }
  return result;
}

/// Buckling loads and shapes of a flat plate.
class BucklingRun : public AnalysisWithResults {
public:
  using AnalysisWithResults::AnalysisWithResults;

  void solve() override;
  void finish() override;

private:
  plate::PointMatrix prestress();
  plate::PointMatrix coupled_prestress();
};

/// Geometric stiffness of the flat plate under its loads, with what the summary says of these.
plate::PointMatrix BucklingRun::prestress() {
  const auto& analysis = content().analysis;
  outputs_.warn(warnings_about_pressed_faces(*ready_.membrane, analysis));
  const std::optional<post::SrifOptions> no_factors;
  auto at_rest = membrane_at_rest(*ready_.membrane, analysis, {no_factors, ready_.membrane_methods});
  summary().membrane = at_rest.summary;
  outputs_.warn(std::move(at_rest.warnings));
  return plate::prestress(*ready_.membrane);
}

/// Geometric stiffness of a coupled plate, which its loads in the plane may bend before it buckles.
plate::PointMatrix BucklingRun::coupled_prestress() {
  constexpr double flat = 1e-3;  // of the displacements in the plane
  const auto& membrane = *ready_.membrane;
  const std::optional<post::SrifOptions> no_factors;
  auto [at_rest, geometric] = plate::coupled_prestress(plate_, membrane);
  outputs_.warn(warnings_about_pressed_faces(membrane, content().analysis, &at_rest.membrane));
  const plate::PlateLoads loads{plate::zero_forces(plate_.points()), membrane.total_load()};
  summary().membrane = membrane_results(plate_, membrane, at_rest, loads, plate::heat_of(membrane, 1),
                                        {no_factors, ready_.membrane_methods}, "in the plane")
                           .summary;
  const double w = plate::largest_of(plate_, at_rest.bending.row(0).cwiseAbs().maxCoeff());
  if (w > flat * summary().membrane->largest_displacement)
    outputs_.warn(
        {fmt::format("the loads bend the coupled plate before it buckles, w = {:.2g} at factor 1: set "
                     "analysis.kind = \"static\" with nonlinear = true",
                     w)});
  return std::move(geometric);
}

void BucklingRun::solve() {
  const auto& analysis = content().analysis;
  auto& summary = this->summary();
  post::Progress progress(quiet(), "buckling");
  const auto geometric = content().coupled() ? coupled_prestress() : prestress();
  const auto found = buckling_modes(content(), plate_, *ready_.membrane, geometric);
  const auto errors = errors_of_buckling(content(), found, plate_.communicator());
  progress.done();
  stopwatch().lap("solve");
  summary.analysis.method = "lanczos";
  summary.analysis.tolerance = analysis.tolerance;
  summary.analysis.residual = 0;
  for (const auto& mode : found) {
    const auto number = summary.buckling.size() + 1;
    post::require_finite(mode.shape, fmt::format("of buckling mode {}", number), plate_);
    summary.buckling.push_back({number, mode.factor, mode.residual, errors[number - 1]});
    summary.analysis.residual = std::max(*summary.analysis.residual, mode.residual);
    results_.shape(number, mode.shape, mode.in_plane, ready_.membrane.get());
  }
  stopwatch().lap("output");
  summary.analysis.stop_reason = fmt::format("{} modes", found.size());
  if (found.empty())
    outputs_.warn(
        {"the plate does not buckle under these loads: it is in tension; set values of the loads of the other sign"});
  else if (found.size() < analysis.modes)
    outputs_.warn(
        {fmt::format("the loads make the plate buckle in {} modes only: most of it is in tension", found.size())});
}

void BucklingRun::finish() {
  post::Table table{{"mode", "factor", "residual", "estimated_error"}, {}};
  for (const auto& one : summary().buckling)
    table.rows.push_back(
        {double(one.mode), one.factor, one.residual, one.error ? post::Cell(*one.error) : post::Cell()});
  outputs_.recorder().table("buckling", std::move(table));
  results_.finish();
}

}  // namespace

std::unique_ptr<PlateAnalysis> large_deflections(const ValidatedPlate& ready, Outputs& outputs) {
  return std::make_unique<LargeDeflectionRun>(ready, outputs);
}

std::unique_ptr<PlateAnalysis> coupled_plate(const ValidatedPlate& ready, Outputs& outputs) {
  return std::make_unique<CoupledRun>(ready, outputs);
}

std::vector<std::optional<double>> errors_of_buckling(const Case& c, const std::vector<plate::BucklingMode>& found,
                                                      const plate::Communicator& all) {
  if (found.empty()) return {};
  // flanks of cracks in thin plates are too stiff until points resolve their layer of shear, which no difference shows
  const double share = c.cracks.empty() ? 0.5 : 1.5, of_factor = c.cracks.empty() ? 0 : 0.0025;
  const auto coarser = coarser_buckling(c, all);
  std::vector<std::optional<double>> result(found.size());
  for (std::size_t i = 0; i < std::min(found.size(), coarser.size()); ++i)
    result[i] = share * std::abs(found[i].factor - coarser[i]) + of_factor * std::abs(found[i].factor);
  return result;
}

std::unique_ptr<PlateAnalysis> buckling(const ValidatedPlate& ready, Outputs& outputs) {
  return std::make_unique<BucklingRun>(ready, outputs);
}

}  // namespace cases
