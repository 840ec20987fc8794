#pragma once
#include <functional>

#include "cases/runs/run_plan.hpp"
#include "post/factors/tip_methods.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/frame.hpp"
#include "post/files/recorder.hpp"
#include "post/files/result_checks.hpp"
#include "post/report/conclusion.hpp"
#include "post/report/pictures.hpp"
#include "post/report/reactions.hpp"

namespace plate {
class Formulation;
}

namespace fracture {

/// Part of a distributed plate that one rank draws and stores: the points that it owns, and the cells about them, with
/// the values of the ghosts that these cells have.
class OwnedMesh {
public:
  /// `plate` must outlive this.
  explicit OwnedMesh(const plate::Formulation& plate);
  /// Constructs from `whole`: all points that the rank knows, and their cells, where these are drawn.
  OwnedMesh(const plate::Formulation& plate, const plate::Mesh& whole);

  /// Mesh whose owned points come first, in the order that they have in the plate.
  const plate::Mesh& mesh() const { return mesh_; }
  /// Reduces a frame with all points that the rank knows to those of mesh(). Collective.
  post::Frame frame(post::Frame seen) const;
  /// Columns of owned points.
  plate::State own(const plate::State& of_plate) const { return own(of_plate, own_); }

private:
  plate::State own(const plate::State& of_plate, std::size_t count) const;

  const plate::Formulation& plate_;
  plate::Mesh mesh_;
  std::size_t own_ = 0;
  std::vector<std::uint32_t> points_;  // of the plate, in the order of the mesh
};

/// Mesh of the owned points; nothing where one process holds the whole plate.
std::optional<OwnedMesh> owned_mesh(const plate::Formulation& plate, const plate::Mesh& whole);

}  // namespace fracture

namespace plate {
class Formulation;
class NumericalError;
class Stopwatch;
struct Instant;
struct Mode;
}  // namespace plate

namespace fracture {

class MovingGrowth;

/// The points about probes.
std::vector<post::Probe> probes_of(const std::map<std::string, geometry::Point>& places,
                                   const plate::Formulation& plate);

/// Summary of a run before it starts.
post::Summary about(const RunPlan& plan, const plate::Formulation& plate, std::vector<std::string> warnings);

/// Error with the message of `error`, the place of its point and, in a motion by steps, the ratio of its step to the
/// stable one.
plate::NumericalError placed(const plate::NumericalError& error, const plate::Formulation& plate,
                             const post::Summary& summary);

/// `solve`, then `finish`. Of a run that fails or is interrupted all that there is is finished too, before that is
/// thrown on.
post::Summary carried_out(post::Summary summary, const plate::Formulation& plate,
                          const std::function<void(post::Summary&)>& solve,
                          const std::function<post::Summary(post::Summary)>& finish);

/// Writes report.html into the folder of a finished run, where one is wanted.
void write_report(const RunPlan& plan, const post::Pictures& pictures);

/// The results of a run on one plate: rows, factors and frames as the solver goes, then all tables and the summary.
class Results {
public:
  /// `methods` of every tip. Plate and methods must outlive this.
  Results(const RunPlan& plan, const plate::Formulation& plate, const std::vector<post::TipMethods>& methods,
          post::Recorder recorder);
  ~Results();

  const RunPlan& plan() const { return plan_; }
  /// The growth of the run, which must outlive it.
  void grows(MovingGrowth& growth) { growth_ = &growth; }
  /// Stores the summary of the search for the discretisation.
  void found(post::AccuracySummary accuracy) { accuracy_ = std::move(accuracy); }
  post::FactorRows& factors() { return factors_; }
  post::ReactionRows& reactions() { return reactions_; }

  /// A row of history, probes and intensity factors; of the last, all rings go into the summary.
  void sample(const plate::Instant& now, bool last);
  void frame(const plate::Instant& now);
  /// Time of the next frame of a motion.
  double next_frame() const { return next_frame_; }
  /// A row of frequencies.csv and a frame, number `number` (from 1).
  void mode(std::size_t number, const plate::Mode& mode);
  /// Writes the tables and, last, the summary; returns it complete.
  post::Summary finish(post::Summary summary, plate::Stopwatch& stopwatch);

  /// Strain energy and external work of the last row: where temperatures act, the energy of kappa - kappa_0, and the
  /// work with what they put in.
  double strain_energy() const { return strain_energy_; }
  double external_work() const { return external_work_; }

  /// Saves and restores the record of a motion; all frames so far are written then. The record has what all ranks know,
  /// without state_of_largest(). Collective.
  void save(plate::OutArchive& archive);
  void restore(plate::InArchive& archive);
  /// Extremes::state().
  plate::State& state_of_largest() { return extremes_.state(); }
  double time_of_largest() const { return extremes_.time(); }

private:
  template <typename Archive>
  void memory(Archive& archive);
  post::Cracks finish_growth(post::Summary& summary);
  std::string remedy() const;

  RunPlan plan_;
  const plate::Formulation& plate_;
  const std::vector<post::TipMethods>& tip_methods_;
  post::Recorder recorder_;
  post::Pictures pictures_;             // for the report
  std::unique_ptr<OwnedMesh> drawing_;  // where the plate is distributed
  std::vector<post::Probe> probes_;
  post::FactorRows factors_;
  post::ReactionRows reactions_;
  post::Extremes extremes_;
  post::EnergyBalance energy_balance_;
  post::Table contact_forces_{{"time", "position", "velocity", "force", "largest_force", "contact_time"}, {}};
  std::vector<double> times_;
  std::vector<post::Frequency> frequencies_;
  std::optional<post::AccuracySummary> accuracy_;
  std::optional<double> residual_;  // of the energies of a growth
  double strain_energy_ = 0, external_work_ = 0, next_frame_ = 0;
  MovingGrowth* growth_ = nullptr;
};

}  // namespace fracture
