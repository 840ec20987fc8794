#pragma once
#include "cases/runs/membrane.hpp"
#include "cases/runs/outputs.hpp"
#include "post/factors/tip_methods.hpp"
#include "post/files/result_checks.hpp"
#include "post/report/conclusion.hpp"
#include "post/report/reactions.hpp"

namespace plate {
struct Heat;
struct Instant;
struct Mode;
}  // namespace plate

namespace fracture {
class MovingGrowth;
}

namespace cases {

/// Adds the part of the strain energy that foundations and springs have to a summary.
void add_elastic_support_energy(const plate::Formulation& plate, const plate::State& state, post::Summary& summary);

/// Results of one plate at rest, in motion or by its frequencies, for the outputs of its run: rows, factors and
/// frames as the solver goes, then the tables.
class Results {
public:
  /// `methods` of every tip. Outputs, plate and methods must outlive this.
  Results(Outputs& outputs, const plate::Formulation& plate, const std::vector<post::TipMethods>& methods);

  Outputs& outputs() { return outputs_; }
  const Case& content() const { return outputs_.content(); }
  /// The growth of the run, which must outlive it.
  void grows(fracture::MovingGrowth& growth) { growth_ = &growth; }
  post::FactorRows& factors() { return factors_; }
  post::ReactionRows& reactions() { return reactions_; }

  /// Adds what a plate does in its plane, which must outlive this, to all that follows.
  void in_plane(const plate::Formulation& membrane, MembraneResult result);
  /// Adds where faces of cracks touch to all that follows.
  void touching(FacesFound found);
  /// A row of history, probes and intensity factors; of the last, all rings go into the summary.
  void sample(const plate::Instant& now, bool last);
  void frame(const plate::Instant& now);
  /// Time of the next frame of a motion.
  double next_frame() const { return next_frame_; }
  /// A row of frequencies.csv and a frame, number `number` (from 1). `membrane`: of a coupled plate its plane.
  void mode(std::size_t number, const plate::Mode& mode, const plate::Formulation* membrane = nullptr);
  /// A frame of the shape of a mode, with displacements of the plane where these have columns.
  void shape(std::size_t number, const plate::State& bending, const plate::State& in_plane,
             const plate::Formulation* membrane);
  /// Gives the outputs all tables, and what the summary says of them.
  void finish();

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
  void look_at_stress(const plate::Instant& now, const plate::Heat& heat);
  post::Cracks finish_growth();
  std::string remedy() const;

  Outputs& outputs_;
  const plate::Formulation& plate_;
  const std::vector<post::TipMethods>& tip_methods_;
  post::FactorRows& factors_;
  post::ReactionRows reactions_;
  post::Extremes extremes_;
  post::EnergyBalance energy_balance_;
  post::Table contact_forces_{{"time", "position", "velocity", "force", "largest_force", "contact_time"}, {}};
  std::vector<double> times_;
  std::vector<post::Frequency> frequencies_;
  std::optional<double> residual_;  // of the energies of a growth
  double strain_energy_ = 0, external_work_ = 0, next_frame_ = 0;
  fracture::MovingGrowth* growth_ = nullptr;
  const plate::Formulation* membrane_ = nullptr;
  std::optional<MembraneResult> in_plane_;
  std::vector<post::ClosedTip> closed_;  // of every tip, where faces of cracks may touch
  post::Table faces_;                    // contact.csv
};

/// Analysis of a plate with the usual results.
class AnalysisWithResults : public PlateAnalysis {
public:
  /// Begins the summary, and opens the outputs. Both must outlive this.
  AnalysisWithResults(const ValidatedPlate& ready, Outputs& outputs);

  void finish() override { results_.finish(); }

protected:
  Results results_;
};

}  // namespace cases
