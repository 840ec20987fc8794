#include "cases/driver/bond_growth_run.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/driver/bond_results.hpp"
#include "cases/driver/gate.hpp"
#include "cases/driver/progress.hpp"
#include "cases/driver/scene.hpp"
#include "cases/driver/static_solution.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/bonds/levels/two_level_plate.hpp"

namespace cases {
namespace {

/// A plate that loses bonds, solved anew after each loss with the factor of the plate at the start.
class BreakingPlate {
public:
  /// All must outlive this.
  BreakingPlate(const Case& content, const Assembly& assembly, fracture::SeveredPlate& plate)
      : case_(content), assembly_(assembly), plate_(plate), load_(total_load(assembly)),
        state_(plate::State::Zero(3, load_.cols())) {
    const auto& constraints = assembly.boundary.constraints;
    diagonal_ = plate::folded_diagonal(plate, constraints);
    norm_ = norm(load_);
    if (!assembly.may_move)  // the factor would enlarge the rounding of a motion without resistance
      factor_ = std::make_unique<plate::TwoLevelPlate>(*assembly.ordinary(), assembly.boundary, content.section, content.discretization);
  }

  fracture::LoadedState operator()() {
    const bool broken = plate_.broken().points() > 0;
    if (auto free = broken ? free_pieces() : ""; !free.empty()) return {std::move(free), 0, nullptr};
    try {
      solve();
    } catch (const plate::NotPositive&) {
      if (!broken) throw;
      return {"a part hangs by its last bonds and can turn about them", 0, nullptr};
    }
    return {"", load_.cwiseProduct(state_).sum(), &state_};
  }

  const plate::StaticSolution& solution() const { return solution_; }  // without its state

private:
  std::string free_pieces() const {
    std::string free;
    for (const auto& piece : plate::pieces(assembly_.boundary, plate_.families()))
      if (piece.free_modes > 0)
        free += fmt::format("{}the piece of {} points about ({:g}, {:g}) is not held", free.empty() ? "" : "; ", piece.points,
                            piece.position.x(), piece.position.y());
    return free;
  }

  /// The residual of the last state is the load of its change.
  void solve() {
    plate::Forces rest;
    plate_.internal_force(state_, rest);
    rest += load_;
    const double left = norm(rest) / norm_;
    const double tolerance = std::min(case_.analysis.tolerance, 1e-6);
    if (left > tolerance) {
      const auto change = plate::conjugate_gradients(plate_, assembly_.boundary.constraints, rest,
                                                     {tolerance / left, case_.analysis.max_iterations, {}}, factor_.get());
      solution_ = {{}, solution_.iterations + change.iterations, change.residual * left, change.converged, change.stop_reason};
      if (!change.converged)
        throw plate::NumericalError(fmt::format("cg: {}, residual {:.2e} above tolerance {:.1e}", change.stop_reason,
                                                solution_.residual, tolerance));
      state_ += change.state;
    }
  }

  /// As StaticOptions counts residuals.
  double norm(plate::Forces force) const {
    assembly_.boundary.constraints.fold(force);
    double sum = 0;
    for (Eigen::Index i = 0; i < force.size(); ++i)
      if (diagonal_.data()[i] > 0) sum += force.data()[i] * force.data()[i] / diagonal_.data()[i];
    return std::sqrt(sum);
  }

  const Case& case_;
  const Assembly& assembly_;
  fracture::SeveredPlate& plate_;
  plate::Forces load_, diagonal_;
  plate::State state_;
  std::unique_ptr<plate::Preconditioner> factor_;
  double norm_ = 0;
  plate::StaticSolution solution_;
};

post::Summary summary_of(const CaseFile& file, const Assembly& assembly, const plate::StaticSolution& solution) {
  auto summary = about(file.content, assembly);
  describe(summary.analysis, "cg", solution, file.content.analysis.tolerance);
  summary.outcome = "done";
  return summary;
}

}  // namespace

post::Summary break_bonds(const CaseFile& file, const RunOptions& options) {
  Stopwatch stopwatch;
  const Case& c = file.content;
  const auto assembly = assemble(file, stopwatch);
  tip_methods(file, assembly);  // for what they refuse
  fracture::SeveredPlate severed(*assembly.ordinary(), assembly.boundary, {c.section, c.discretization});
  const fracture::BondLimits limits(*c.growth, c.section, c.discretization);
  fracture::BondCheck check(*c.growth, limits, severed, assembly.boundary);
  BondCracks cracks(assembly);
  BreakingPlate plate(c, assembly, severed);
  BondResults results(file, assembly, severed, cracks, options.folder);
  stopwatch.lap("solve");

  Progress progress(options.quiet, "growth");
  bool new_lines = false;
  std::vector<std::string> warnings;
  const auto observe = [&](const fracture::BondEvent& event) -> std::string {
    stopwatch.lap("solve");
    if (new_lines) cracks.look(double(event.advance));
    const bool longest = c.growth->max_length && cracks.length() >= *c.growth->max_length * (1 - 1e-9);
    if (event.advance == 0)
      require_motion(assembly, {total_load(assembly)}, *event.plate.state, event.plate.displacement, warnings);
    results.event(event, new_lines, longest);
    stopwatch.lap("output");
    progress.update(double(event.advance) / double(c.growth->max_advances),
                    fmt::format("advance {}, load factor {:.4g}, {} bonds broken, crack length {:.4g}", event.advance,
                                event.load.factor(), cracks.broken(), cracks.length()));
    if (longest) return "the largest length of cracks";
    new_lines = cracks.broke(event.breaks, double(event.advance));
    return "";
  };
  try {
    const auto broken = fracture::break_at_rest(*c.growth, severed, check, std::ref(plate), observe);
    progress.done();
    if (new_lines) cracks.look(double(broken.advances));
    auto summary = summary_of(file, assembly, plate.solution());
    summary.warnings.insert(summary.warnings.end(), warnings.begin(), warnings.end());
    return results.finish(std::move(summary), broken.outcome, stopwatch);
  } catch (const plate::NumericalError& error) {
    auto summary = summary_of(file, assembly, plate.solution());
    const auto outcome = summary.outcome = fmt::format("failed: {}", error.what());
    summary.analysis.stop_reason = error.what();
    results.finish(std::move(summary), outcome, stopwatch);
    throw;
  }
}

}  // namespace cases
