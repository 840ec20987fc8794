#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/runs/analyses.hpp"
#include "cases/runs/bonds_error.hpp"
#include "cases/runs/outputs.hpp"
#include "cases/runs/results.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/coupled_modes.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "plate/solve/motion/harmonic.hpp"
#include "plate/solve/statics.hpp"
#include "plate/solve/stretching.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/result_checks.hpp"
#include "post/report/reactions.hpp"
#include "post/report/response.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

/// The response as it is found.
class ResponseRun : public PlateAnalysis {
public:
  ResponseRun(const ValidatedPlate& ready, Outputs& outputs)
      : PlateAnalysis(ready, outputs),
        coupled_(content().coupled() ? std::make_unique<const plate::CoupledPlate>(plate_, *ready.membrane) : nullptr),
        reactions_(coupled_ ? post::HarmonicReactions(plate_, *content().analysis.damping, coupled_->of_both(),
                                                      plate::coupled_inertia(plate_, 1, coupled_->constraints()))
                            : post::HarmonicReactions(plate_, *content().analysis.damping)) {}

  void solve() override;
  void finish() override;

private:
  plate::HarmonicResponse response(post::Progress& progress) const;
  Eigen::MatrixXd of_values(const Eigen::MatrixXd& functionals) const;
  plate::State of_plate(const plate::State& state) const { return coupled_ ? plate::of_plate(state) : state; }
  void look(double frequency, const std::pair<plate::State, plate::State>& parts);
  std::vector<post::Srif> factors(const plate::State& state, const plate::Heat& heat) const;
  void draw_period(double frequency, const std::pair<plate::State, plate::State>& parts);

  std::unique_ptr<const plate::CoupledPlate> coupled_;  // where bending and stretching are; states are then stacked
  post::HarmonicReactions reactions_;
  std::vector<post::Response> found_;
  std::vector<std::vector<double>>
      unknown_;          // of every tip, of every probe and of reactions, what the vectors leave, relative
  double largest_ = -1;  // deflection of all frequencies
  double where_ = 0;     // its frequency
};

/// Functionals of states of the plate as those of what is solved.
Eigen::MatrixXd ResponseRun::of_values(const Eigen::MatrixXd& functionals) const {
  if (!coupled_ || functionals.rows() == 0) return functionals;
  const auto points = Eigen::Index(plate_.points());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(functionals.rows(), 2 * functionals.cols());
  for (Eigen::Index c = 0; c < plate::unknowns_per_point; ++c)
    result.middleCols(2 * c * points, points) = functionals.middleCols(c * points, points);
  return result;
}

plate::HarmonicResponse ResponseRun::response(post::Progress& progress) const {
  const auto& analysis = content().analysis;
  auto load = plate::zero_forces(plate_.points());
  for (const auto& one : plate_.loads()) load += one.forces;
  if (coupled_) load = plate::stacked(load, ready_.membrane->total_load());
  plate::HarmonicOptions options;
  options.sweep = *analysis.sweep, options.tolerance = analysis.tolerance, options.damping = *analysis.damping;
  options.watched.resize(3);  // factors, probes, reactions
  for (const auto& tip : ready_.tip_methods) options.watched[0].push_back(of_values(tip.functionals()));
  for (const auto& probe : outputs_.probes())
    options.watched[1].push_back(of_values(post::functionals(probe, plate_.points(), plate_.section().thickness)));
  options.watched[2].push_back(reactions_.functionals());
  options.progress = [&](std::size_t vectors, double change) {
    progress.update(std::min(0.5, double(vectors) / 200), fmt::format("{} vectors, change {:.1e}", vectors, change));
  };
  if (coupled_)
    return {coupled_->of_both(),
            coupled_->constraints(),
            plate::coupled_inertia(plate_, 1, coupled_->constraints()),
            load,
            coupled_->inverse(),
            options};
  return {plate_, plate_.constraints(), plate_.inertia(1), load, *plate::inverse_of(plate_), options};
}

std::vector<post::Srif> ResponseRun::factors(const plate::State& state, const plate::Heat& heat) const {
  if (!content().srif) return {};
  return post::srifs(plate_, *content().srif, ready_.tip_methods, state, true, &heat);
}

/// The largest of w = A cos - B sin at any time.
double largest_deflection(const std::pair<plate::State, plate::State>& parts, std::size_t points) {
  const auto w = [&](const plate::State& state) { return state.row(0).head(Eigen::Index(points)).array(); };
  return std::sqrt((w(parts.first).square() + w(parts.second).square()).maxCoeff());
}

void ResponseRun::look(double frequency, const std::pair<plate::State, plate::State>& parts) {
  const auto when = fmt::format("at the frequency {:g}", frequency);
  const plate::State in_phase = of_plate(parts.first), quadrature = of_plate(parts.second);
  post::require_finite(in_phase, when, plate_);
  post::require_finite(quadrature, when, plate_);
  const auto& probes = outputs_.probes();
  for (std::size_t i = 0; i < probes.size(); ++i)
    std::ranges::move(
        post::responses_of(frequency, probes[i], in_phase, quadrature, unknown_[1][i], plate_.section().thickness),
        std::back_inserter(found_));
  auto first = factors(in_phase, plate::heat_of(plate_, 1.0)), second = factors(quadrature, plate::Heat{});
  post::require_finite(first, when), post::require_finite(second, when);
  const double h = plate_.section().thickness;
  for (auto* all : {&first, &second})
    for (auto& srif : *all) post::widen(srif, unknown_[0][srif.tip] * post::largest_factor(srif, h), h);
  std::ranges::move(post::responses_of(frequency, first, second), std::back_inserter(found_));
  std::ranges::move(reactions_.at(frequency, parts.first, parts.second), std::back_inserter(found_));
}

void ResponseRun::draw_period(double frequency, const std::pair<plate::State, plate::State>& parts) {
  if (!outputs_.takes_frames()) return;
  constexpr std::size_t frames = 8;
  for (std::size_t n = 0; n < frames; ++n) {
    const double turn = double(n) / double(frames), angle = 2 * std::numbers::pi * turn;
    const plate::State state = std::cos(angle) * parts.first - std::sin(angle) * parts.second;
    const auto heat = plate::heat_of(plate_, std::cos(angle));
    auto frame = post::frame_of(plate_, turn / frequency, n, of_plate(state), true, &heat);
    if (coupled_)
      add_in_plane(frame, plate_, *ready_.membrane,
                   results_of_shape(plate_, *ready_.membrane, {of_plate(state), plate::of_plane(state)},
                                    plate::heat_of(*ready_.membrane, std::cos(angle)), "of a period"));
    outputs_.frame(plate_, std::move(frame));
  }
}

void ResponseRun::solve() {
  auto& summary = this->summary();
  post::Progress progress(quiet(), "response");
  const auto response = this->response(progress);
  const auto& frequencies = response.frequencies();
  stopwatch().lap("solve");
  summary.analysis.method = "lanczos";
  summary.analysis.tolerance = content().analysis.tolerance;
  summary.analysis.iterations = response.vectors();
  summary.analysis.residual = response.change();
  unknown_ = response.watched_change();
  reactions_.known_to(unknown_[2].front());
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    plate::stop_if_asked("a response", plate_.constraints());
    const auto parts = response.at(i);
    look(frequencies[i], parts);
    if (const double w = largest_deflection(parts, plate_.cloud().plate_points); w > largest_)
      largest_ = w, where_ = frequencies[i];
    progress.update(0.5 + 0.5 * double(i + 1) / double(frequencies.size()), fmt::format("f = {:.4g}", frequencies[i]));
    stopwatch().lap("srif");
  }
  draw_period(where_, response.at(std::size_t(std::ranges::find(frequencies, where_) - frequencies.begin())));
  progress.done();
  stopwatch().lap("output");
  summary.resonances = response.resonances();
  summary.analysis.stop_reason =
      fmt::format("{} frequencies, {} Lanczos vectors", frequencies.size(), response.vectors());
}

void ResponseRun::finish() {
  const auto& section = plate_.section();
  auto& summary = this->summary();
  if (largest_ >= 0) {
    summary.response = post::largest_responses(found_, section.thickness);
    summary.response.push_back({"plate", "w", largest_, where_, {}});
    summary.deflection_over_thickness = largest_ / section.thickness;
  }
  outputs_.recorder().table("response", post::response_table(found_));
  outputs_.given_cracks(plate_);
  if (content().srif) outputs_.warn(post::left_out(plate_.tips(), ready_.tip_methods, *content().srif));
}

/// Frequencies and shapes of a plate, also under its membrane forces.
class FrequencyRun : public AnalysisWithResults {
public:
  using AnalysisWithResults::AnalysisWithResults;

  void solve() override;

private:
  plate::FrequencySolution solution(const plate::FrequencyOptions& options);
};

plate::FrequencySolution FrequencyRun::solution(const plate::FrequencyOptions& options) {
  const auto& analysis = content().analysis;
  const auto* membrane = ready_.membrane.get();
  if (content().coupled()) {
    if (!plate::loaded_in_plane(content()))
      return plate::coupled_frequencies(plate_, *membrane, analysis.rotary_inertia, nullptr, options);
    const auto [at_rest, geometric] = plate::coupled_prestress(plate_, *membrane);
    outputs_.warn(warnings_about_pressed_faces(*membrane, analysis, &at_rest.membrane));
    return plate::coupled_frequencies(plate_, *membrane, analysis.rotary_inertia, &geometric, options);
  }
  const auto mass = plate_.mass(analysis.rotary_inertia);
  if (!membrane) return plate::frequencies(plate_, plate_.constraints(), mass, options);
  outputs_.warn(warnings_about_pressed_faces(*membrane, analysis));
  return plate::frequencies_under_load(*membrane, plate_, mass, options);
}

void FrequencyRun::solve() {
  const auto& analysis = content().analysis;
  auto& summary = this->summary();
  const auto [low, high] = geometry::bounding_box(content().outline);
  post::Progress progress(quiet(), "Lanczos iteration");
  const double usual = 4 * double(analysis.modes) + 12;  // solutions; 35 for 6 modes of a rectangle
  const double shift = plate::shift_of(plate_.section(), (high - low).maxCoeff());
  const auto inverse = content().coupled() ? nullptr : plate_.inverse_of_shifted(shift);
  const plate::FrequencyOptions options{
      analysis.modes, analysis.tolerance, analysis.max_iterations, shift, inverse.get(), [&](std::size_t solution) {
        plate::stop_if_asked("frequencies", plate_.constraints());
        progress.update(std::min(double(solution) / usual, 0.99), fmt::format("solution {}", solution + 1));
      }};
  summary.analysis.method = "lanczos";
  summary.analysis.tolerance = analysis.tolerance;
  const auto solution = this->solution(options);
  progress.done();
  stopwatch().lap("solve");

  summary.analysis.iterations = solution.iterations;
  summary.analysis.residual = 0;
  if (!ready_.membrane && !solution.modes.empty())
    compare_first_frequency(plate_, solution.modes.front().frequency, content(), options, analysis.rotary_inertia,
                            summary.warnings);
  stopwatch().lap("second_formulation");
  const auto* both = content().coupled() ? ready_.membrane.get() : nullptr;
  for (std::size_t i = 0; i < solution.modes.size(); ++i) {
    results_.mode(i + 1, solution.modes[i], both);
    summary.analysis.residual = std::max(*summary.analysis.residual, solution.modes[i].residual);
  }
  stopwatch().lap("output");
  summary.analysis.stop_reason = fmt::format("{} modes in {} solutions", solution.modes.size(), solution.solutions);
}

}  // namespace

std::unique_ptr<PlateAnalysis> harmonic_response(const ValidatedPlate& ready, Outputs& outputs) {
  return std::make_unique<ResponseRun>(ready, outputs);
}

std::unique_ptr<PlateAnalysis> frequencies(const ValidatedPlate& ready, Outputs& outputs) {
  return std::make_unique<FrequencyRun>(ready, outputs);
}

}  // namespace cases
