#include "cases/driver/growth_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "cases/input/formulations.hpp"
#include "cases/driver/gate.hpp"
#include "cases/driver/growth_results.hpp"
#include "cases/driver/progress.hpp"
#include "cases/driver/scene.hpp"
#include "cases/driver/static_solution.hpp"
#include "plate/model/numerical_error.hpp"

namespace cases {
namespace {

using Cracks = std::vector<geometry::Polyline>;

/// Where the case asks for no intensity factors, the methods that give the energy release rate.
CaseFile with_factors(CaseFile file) {
  auto& c = file.content;
  if (!c.srif) c.srif.emplace().methods = {"virtual_crack_extension", "domain_integral"};
  return file;
}

/// Solves the plate anew with every length of its cracks, and keeps the last solution.
class GrowingPlate {
public:
  GrowingPlate(const CaseFile& file, Stopwatch& stopwatch) : file_(with_factors(file)), stopwatch_(stopwatch) {}

  fracture::LoadedPlate operator()(const Cracks& cracks) {
    CaseFile file = file_;
    file.content.cracks = cracks;
    try {
      auto assembly = assemble(file, stopwatch_);
      return solved(std::move(file), std::move(assembly));
    } catch (const CaseError& error) {
      if (!last_) throw;  // as the case is written
      std::string why;
      for (const auto& problem : error.problems()) why += (why.empty() ? "" : "; ") + problem.what;
      return {why, 0, {}};
    }
  }

  const std::shared_ptr<const GrownPlate>& last() const { return last_; }
  const plate::StaticSolution& solution() const { return solution_; }
  const std::string& method() const { return method_; }

private:
  fracture::LoadedPlate solved(CaseFile file, Assembly assembly) {
    const Case& c = file.content;
    fracture::LoadedPlate result;
    if (!last_) check_growing_tips(file, assembly);
    for (const auto& tip : assembly.tips)
      if (!ringed(c, assembly.paths, tip)) result.tips.push_back({tip, {}, std::nullopt});
    if (!result.tips.empty()) return result;  // they break through
    const auto methods = tip_methods(file, assembly);
    for (std::size_t i = 0; i < methods.size(); ++i)
      if (!methods[i].works()) throw CaseError({{file.place("srif"), "srif", left_out(assembly, methods).front()}});
    const auto solve = solve_at_rest(c, assembly, {c.analysis.tolerance, c.analysis.max_iterations, {}});
    stopwatch_.lap("solve");
    solution_ = solve.solution;
    method_ = solve.method;
    solution_.state.resize(3, 0);
    if (!solve.solution.converged)
      throw plate::NumericalError(fmt::format("{}: {}, residual {:.2e} above tolerance {:.1e}", solve.method,
                                              solve.solution.stop_reason, solve.solution.residual, c.analysis.tolerance));
    require_finite(solve.solution.state, "at rest");
    auto found = srifs(c, assembly, methods, solve.solution.state);
    require_finite(found, "under the whole load");
    stopwatch_.lap("srif");
    const auto load = total_load(assembly);
    result.displacement = load.cwiseProduct(solve.solution.state).sum();
    require_finite({{"work", result.displacement}}, "under the whole load");
    if (!moves(solve.solution.state, result.displacement))
      require_motion(assembly, {load}, solve.solution.state, result.displacement, assembly.warnings);
    for (std::size_t i = 0; i < assembly.tips.size(); ++i) {
      const auto srif = std::ranges::find_if(found, [i](const auto& one) { return one.tip == i && one.G; });
      if (srif == found.end()) throw plate::NumericalError(no_energy(assembly, methods, i));
      result.tips.push_back({assembly.tips[i], {srif->K1, srif->K2, srif->K3}, srif->G});
    }
    last_ = std::make_shared<GrownPlate>(
        GrownPlate{std::move(file), std::move(assembly), solve.solution.state, std::move(found)});
    return result;
  }

  /// Why a tip has no energy release rate although a ring fits about it.
  static std::string no_energy(const Assembly& assembly, const std::vector<post::TipMethods>& methods,
                               std::size_t tip) {
    const auto& x = assembly.tips[tip].position;
    return fmt::format("no energy release rate at the tip at ({:g}, {:g}): {}", x.x(), x.y(),
                       fmt::join(methods[tip].left_out(), "; "));
  }

  CaseFile file_;
  Stopwatch& stopwatch_;
  std::shared_ptr<const GrownPlate> last_;
  plate::StaticSolution solution_;  // without its state
  std::string method_;
};

/// The plate at rest as it has grown, a hundredth above the load that is there, and what it does then.
CaseFile in_motion(CaseFile file, const fracture::Grown& grown, double load_factor) {
  Case& c = file.content;
  c.analysis.kind = Analysis::Kind::dynamic;
  c.analysis.method = Analysis::Method::central_difference;
  c.analysis.start = Analysis::Start::equilibrium;
  c.analysis.duration = c.growth->duration;
  c.growth->unstable = fracture::Growth::Unstable::jump;
  c.output.every = c.growth->duration / 10;
  c.cracks = grown.cracks;
  const double factor = 1.01 * load_factor;
  for (auto& load : c.loads) {
    load.value *= factor, load.twist *= factor;
    for (auto& component : load.tensor) component *= factor;
    load.history = {};
  }
  return file;
}

post::Summary summary_of(const CaseFile& file, const GrowingPlate& plate) {
  post::Summary summary;
  if (plate.last()) summary = about(file.content, plate.last()->assembly);
  summary.title = file.content.title;
  summary.formulation = formulation_name(file.content.discretization.formulation);
  summary.formulation_reason = file.content.formulation_reason;
  summary.analysis.kind = "static";
  describe(summary.analysis, plate.method(), plate.solution(), file.content.analysis.tolerance);
  summary.outcome = "done";
  return summary;
}

}  // namespace

post::Summary grow(const CaseFile& file, const RunOptions& options) {
  Stopwatch stopwatch;
  const Case& c = file.content;
  GrowingPlate plate(file, stopwatch);
  std::optional<GrowthResults> results;
  const auto begin = [&] {
    if (!results) results.emplace(file, options.folder);
  };
  Progress progress(options.quiet, "growth");
  const auto observe = [&](const fracture::Event& event) {
    begin();
    results->event(event, plate.last());
    stopwatch.lap("output");
    double longest = 0;
    for (const auto& crack : event.cracks) longest = std::max(longest, geometry::length(crack));
    progress.update(double(event.advance) / double(c.growth->max_advances),
                    fmt::format("advance {}, load factor {:.4g}, longest crack {:.4g}", event.advance, event.load_factor, longest));
  };
  const double spacing = c.discretization.tip_spacing.value_or(c.discretization.spacing);
  try {
    const auto grown = fracture::grow_at_rest(*c.growth, c.section, c.outline, c.cracks, spacing, std::ref(plate), observe);
    progress.done();
    auto summary = results->finish(summary_of(file, plate), grown, stopwatch);
    if (grown.outcome == fracture::unstable_advance && c.growth->unstable == fracture::Growth::Unstable::move)
      run(in_motion(file, grown, results->load_factor()), {options.folder / "motion", options.quiet});
    return summary;
  } catch (const plate::NumericalError& error) {
    begin();
    auto summary = summary_of(file, plate);
    const auto outcome = summary.outcome = fmt::format("failed: {}", error.what());
    summary.analysis.stop_reason = error.what();
    results->finish(std::move(summary), {outcome, 0, {}, {}}, stopwatch);
    throw;
  }
}

}  // namespace cases
