#pragma once
#include "cases/runs/membrane.hpp"
#include "cases/runs/outputs.hpp"
#include "fracture/growth/quasi_static_growth.hpp"
#include "plate/formulation/discretised.hpp"
#include "post/report/reactions.hpp"

namespace fracture {
class GrowingPlate;
class QuasiStaticBonds;
}  // namespace fracture

namespace cases {

class RunCheckpoints;

/// Returns the requested options, or, where no intensity factors are requested, the methods that give the energy
/// release rate.
post::SrifOptions factors_of_growth(const std::optional<post::SrifOptions>& asked);

/// A quasi-static growth, with the number of the advance in the place of time.
class QuasiStaticRun : public RunningAnalysis {
public:
  /// The case of `plan` has a growth. `first`: the plate with the cracks as they are at the start.
  QuasiStaticRun(const RunPlan& plan, plate::Discretised first);
  ~QuasiStaticRun() override;

  /// Grows: carry_out(). `checkpoints`: of a growth that may go on later, or goes on here.
  post::Summary operator()(post::Recorder recorder, RunCheckpoints* checkpoints);

  void solve() override;
  void finish() override;
  plate::NumericalError failed(const plate::NumericalError& error) override;
  void interrupted() override;

  // of the end
  const fracture::QuasiStaticOutcome& outcome() const { return outcome_; }
  double load_factor() const { return factor_; }
  std::vector<geometry::Polyline> cracks() const;

private:
  fracture::Continuation continuation(RunCheckpoints& checkpoints, fracture::QuasiStaticLoad& load);
  template <typename Archive>
  void memory(Archive& archive);
  void observe(const fracture::Equilibrium& now);
  void frame();
  std::pair<post::Frame, plate::Mesh> drawn() const;
  std::optional<MembraneResult> in_plane() const;
  void record();
  post::GrowthSummary growth_summary() const;

  RunPlan plan_;
  const Case& content_;
  const fracture::Growth& growth_;
  plate::Stopwatch stopwatch_;
  std::vector<std::string> warnings_;
  std::unique_ptr<plate::Formulation> start_;  // of bonds
  std::unique_ptr<fracture::GrowingPlate> tips_;
  std::unique_ptr<fracture::QuasiStaticBonds> bonds_;
  fracture::QuasiStaticModel* model_ = nullptr;
  std::optional<Outputs> outputs_;
  RunCheckpoints* checkpoints_ = nullptr;
  post::ReactionRows reactions_;
  post::Table srifs_{post::srif_columns(), {}};
  std::vector<post::Srif> latest_;
  plate::State state_;  // of the last advance
  fracture::QuasiStaticOutcome outcome_;
  std::size_t advance_ = 0;  // its number
  double factor_ = 0, largest_factor_ = 0;
  double doubt_ = 0;                                  // largest estimated error of a load factor, relative
  std::size_t doubtful_ = 0;                          // the advance that has it
  std::optional<double> first_factor_, first_error_;  // of the first advance; its estimated error, relative
  bool framed_ = true;
};

}  // namespace cases
