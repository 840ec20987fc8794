#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "post/files/summary.hpp"

namespace plate {
class Formulation;
struct Analysis;
}  // namespace plate

namespace post {

/// Output of a run beside its solution.
struct Given {
  bool factors = false, fields = false;  // intensity factors, fields for ParaView
};

/// The parts of the program that a run uses, each with the memory that it takes. What is not listed is not there.
std::vector<ScenePart> scene(const plate::Formulation& plate, const plate::Analysis& analysis, const Given& given);

/// Summary of a run as it is known before the run, without title and warnings.
Summary about(const plate::Formulation& plate, const plate::Analysis& analysis, const Given& given);

/// a u + b v with neither a nor b below zero, through two values: through the second where both cannot be met.
class TwoTerms {
public:
  struct Value {
    double u, v, is;
  };
  TwoTerms(const Value& first, const Value& second);

  double operator()(double u, double v) const { return a_ * u + b_ * v; }

private:
  double a_ = 0, b_ = 0;
};

/// A finished run of a plate with fewer points, or with less to do.
struct SampleRun {
  Summary summary;
  double spacing = 1;           // that of the whole plate is 1
  double rings = 0;             // the largest radius of rings about tips [spacings]
  double rows = 1, frames = 1;  // written, those of the start and the end among them
  double files = 0;             // [bytes]
  double share = 1;             // of the elapsed time in which the program computed: below 1 on a busy machine

  double points() const { return double(summary.points); }
  double steps() const { return double(summary.analysis.steps.value_or(0)); }
  /// Computing time of the stage of this name, or of all stages, on a machine that is otherwise idle [time].
  double seconds(const std::string& stage = "total") const;
};

/// Runs of samples of a plate: `small` and `large` without intensity factors and with the least of steps, then the
/// large one with factors, and with more steps and rows.
struct Samples {
  SampleRun small, large;
  std::optional<SampleRun> factors, longer;
  double opening = 0;  // of libraries, once [time]
};

/// Size of the run whose cost is estimated, and the orders of its solution's cost in the number of points.
struct RunSize {
  double points = 0, rings = 0;
  double steps = 0, rows = 1, frames = 1;  // in motion
  double iterations_order = 0, seconds_order = 1;
  double advances = 0;  // of a quasi-static growth, each an equilibrium of its own; 0 where none grows
};

/// Estimated cost of a run.
struct CostEstimate {
  std::vector<std::pair<std::string, double>> seconds;  // setting up, solution, factors, files
  double iterations = 0, files = 0;                     // files: [bytes]

  double total() const;
};

/// Points, or bonds, of the whole plate: their numbers follow its area and, at edges, its sides.
double total_points(const Samples& samples);
double total_bonds(const Samples& samples);
/// Memory of its parts, as the samples tell it [bytes]; a factor is none of them.
double bytes_of_parts(const Samples& samples, double points);
/// Memory for the unit fields of rings of so many spacings: measured 30 MB for 24, 13 for 15 [bytes].
double bytes_of_rings(double radius);
/// Memory of a program that has opened nothing, and of the libraries for files of fields [bytes]: measured 14 MB, 23
/// MB.
double bytes_of_program(bool fields);
/// The stable step of the whole plate: the highest frequency is that of waves as short as the spacing, or of rotations,
/// which the thickness gives.
double stable_step_of_run(const Samples& samples);

CostEstimate estimated_cost(const Samples& samples, const RunSize& whole);

}  // namespace post
