#pragma once
#include "cases/input/case_file.hpp"
#include "post/factors/tip_methods.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/recorder.hpp"
#include "post/report/conclusion.hpp"
#include "post/report/html/pictures.hpp"
#include "post/report/reactions.hpp"

namespace fracture {
class MovingGrowth;
}

namespace plate {
class Formulation;
class Stopwatch;
struct Instant;
struct Mode;
}  // namespace plate

namespace cases {

struct RunOptions;

/// The points about the probes of a case.
std::vector<post::Probe> probes_of(const Case& c, const plate::Formulation& plate);

/// Throws CaseError where the folder holds something but no results of a run.
void check_folder(const std::filesystem::path& folder);

/// A recorder for the results of a case. What an earlier run wrote into its folder goes, and that is said.
post::Recorder recorder_of(const Case& c, const RunOptions& options);

/// Where report.html goes; nothing where none is wanted.
std::optional<std::filesystem::path> report_folder(const Case& c, const RunOptions& options);

/// Writes report.html into the folder of a finished run.
void write_report(const Case& c, const std::filesystem::path& folder, const post::Pictures& pictures);

/// The results of a run on one plate: rows, factors and frames as the solver goes, then all tables and the summary.
class Results {
public:
  /// `methods` of every tip. All must outlive this. `growth`: of the run, where cracks grow.
  Results(const CaseFile& file, const plate::Formulation& plate, const std::vector<post::TipMethods>& methods,
          const RunOptions& options);

  /// The growth of the run, which must outlive it.
  void grows(fracture::MovingGrowth& growth) { growth_ = &growth; }
  /// How the discretisation was found.
  void found(post::AccuracySummary accuracy) { accuracy_ = std::move(accuracy); }
  post::FactorRows& factors() { return factors_; }

  /// A row of history, probes and intensity factors; of the last, all rings go into the summary.
  void sample(const plate::Instant& now, bool last);
  void frame(const plate::Instant& now);
  /// A row of frequencies.csv and a frame, number `number` (from 1).
  void mode(std::size_t number, const plate::Mode& mode);
  /// Writes the tables and, last, the summary; returns it complete.
  post::Summary finish(post::Summary summary, plate::Stopwatch& stopwatch);

  double strain_energy() const { return strain_energy_; }

private:
  const Case& case_;
  const plate::Formulation& plate_;
  const std::vector<post::TipMethods>& tip_methods_;
  post::Recorder recorder_;
  std::optional<std::filesystem::path> report_;  // its folder, where one is wanted
  post::Pictures pictures_;                      // for it
  std::vector<post::Probe> probes_;
  post::FactorRows factors_;
  post::ReactionRows reactions_;
  post::Extremes extremes_;
  std::vector<double> times_;
  std::vector<post::Frequency> frequencies_;
  std::optional<post::AccuracySummary> accuracy_;
  std::optional<double> residual_;  // of the energies of a growth
  double strain_energy_ = 0;
  fracture::MovingGrowth* growth_ = nullptr;
};

}  // namespace cases
