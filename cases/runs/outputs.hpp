#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/case_file.hpp"
#include "cases/runs/run_plan.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/recorder.hpp"
#include "post/files/summary.hpp"
#include "post/report/pictures.hpp"

namespace post {
class SpringsOnCracks;
class StressAround;
struct SampledLine;
}  // namespace post

namespace plate {
class NumericalError;
class Stopwatch;
}  // namespace plate

namespace cases {

class OwnedMesh;
struct ValidatedPlate;

/// Data of a case that its report shows.
post::ReportedCase reported(const Case& c);

/// Summary of a run before it starts.
post::Summary about(const Case& c, const plate::Formulation& plate, std::vector<std::string> warnings);

/// Error with the message of `error`, the place of its point and, in a motion by steps, the ratio of its step to the
/// stable one.
plate::NumericalError placed(const plate::NumericalError& error, const plate::Formulation& plate,
                             const post::Summary& summary);

/// The points about probes.
std::vector<post::Probe> probes_of(const std::map<std::string, geometry::Point>& places,
                                   const plate::Formulation& plate);

/// Outputs of a run, whatever its analysis: rows of history and probes, frames, tables, the summary, the report.
class Outputs {
public:
  /// `stopwatch` must outlive this, and all that the plan refers to.
  Outputs(const RunPlan& plan, post::Recorder recorder, plate::Stopwatch& stopwatch);
  ~Outputs();

  const RunPlan& plan() const { return plan_; }
  const Case& content() const { return plan_.content; }
  plate::Stopwatch& stopwatch() { return stopwatch_; }
  /// Tables of an analysis of its own, and the history so far.
  post::Recorder& recorder() { return recorder_; }
  post::Summary& summary() { return summary_; }
  /// Intensity factors of one plate at all times.
  post::FactorRows& factors() { return factors_; }
  void warn(std::vector<std::string> warnings);

  /// Draws and stores all frames with the cells and points of this plate, as far as they are wanted, and places the
  /// probes.
  void open(const plate::Formulation& plate);
  /// Places the probes on a plate that has new points.
  void place_probes(const plate::Formulation& plate);
  const std::vector<post::Probe>& probes() const { return probes_; }
  /// A row of history and probes.
  void row(const post::Sample& sample, const plate::Formulation& plate);
  /// True where frames are wanted, to be drawn, to go on from, or for the values at the probes of a plate at rest.
  bool takes_frames() const { return recorder_.draws() || recorder_.stores() || takes_values(); }
  /// A frame, with other cells where they are given; `velocity` [3 x points] or without columns. `governs`: the report
  /// has all of its fields.
  void frame(const plate::Formulation& plate, post::Frame frame, std::optional<plate::Mesh> mesh = {},
             const plate::State& velocity = plate::no_state(), bool governs = true);
  /// The last state, where the points of frames were not the same throughout.
  void final_state(const plate::Formulation& plate, post::Frame frame);
  /// The cracks of the plate as they were given, where there are any.
  void given_cracks(const plate::Formulation& plate, const std::vector<post::Srif>& factors = {});

  /// Compares the results with those of other points when it finishes: errors are the largest of all comparisons.
  void compare_with(std::vector<post::OtherResults> others) { others_ = std::move(others); }
  /// Writes the tables, the summary and the report; returns the summary complete.
  post::Summary finish();

  /// Saves rows and pictures; on return all frames so far are written.
  void save(plate::OutArchive& archive);
  /// Restores them, after open().
  void restore(plate::InArchive& archive);

private:
  bool takes_values() const;
  void take_values(const plate::Formulation& plate, const post::Frame& frame);
  void set_errors();

  RunPlan plan_;
  post::Recorder recorder_;
  plate::Stopwatch& stopwatch_;
  post::Summary summary_;
  post::FactorRows factors_;
  std::vector<post::Probe> probes_;
  // of the frames of a plate at rest
  std::vector<std::vector<post::ProbeValue>> values_, sums_;
  std::vector<post::SampledLine> lines_;
  std::unique_ptr<const post::SpringsOnCracks> springs_;  // where there are some
  std::unique_ptr<const post::StressAround> around_;      // likewise, singular places
  std::vector<std::vector<post::StressAtDistance>> stress_near_;
  post::Table line_rows_, spring_rows_;
  std::vector<post::OtherResults> others_;
  post::Pictures pictures_;             // for the report
  std::unique_ptr<OwnedMesh> drawing_;  // where the plate is distributed
};

/// An analysis that is carried out: it gives all that it finds to its outputs.
class RunningAnalysis {
public:
  virtual ~RunningAnalysis() = default;

  /// Throws plate::NumericalError or plate::Interrupted.
  virtual void solve() = 0;
  /// Gives the outputs what is known at the end only, also where solve() threw.
  virtual void finish() = 0;
  /// Called where solve() failed; returns the error that the user sees.
  virtual plate::NumericalError failed(const plate::NumericalError& error) = 0;
  /// Called where a signal ended solve().
  virtual void interrupted() {}
};

/// An analysis of a plate that is made once.
class PlateAnalysis : public RunningAnalysis {
public:
  plate::NumericalError failed(const plate::NumericalError& error) override;

protected:
  /// Begins the summary, and opens the outputs. Both must outlive this.
  PlateAnalysis(const ValidatedPlate& ready, Outputs& outputs);

  const Case& content() const { return outputs_.content(); }
  bool quiet() const { return outputs_.plan().options.quiet; }
  post::Summary& summary() { return outputs_.summary(); }
  plate::Stopwatch& stopwatch() { return outputs_.stopwatch(); }

  const ValidatedPlate& ready_;
  const plate::Formulation& plate_;
  Outputs& outputs_;
};

/// Solves and writes everything. Of a run that fails or is interrupted all that there is is written too, before that is
/// thrown on.
post::Summary carry_out(RunningAnalysis& analysis, Outputs& outputs);

}  // namespace cases
