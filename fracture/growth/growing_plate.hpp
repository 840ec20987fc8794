#pragma once
#include "fracture/growth/quasi_static_tips.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/tip_methods.hpp"
#include "post/files/summary.hpp"

namespace fracture {

/// The plate of a problem, discretised and solved anew with every length of its cracks.
class GrowingPlate : public QuasiStaticTips {
public:
  /// `first`: the problem with its cracks as they are at the start. `factors`: whose methods give the energy release
  /// rate. `analysis`: by which states between advances are found. Seconds go to `stopwatch`. All references must
  /// outlive this.
  GrowingPlate(const Growth& growth, const plate::Problem& problem, plate::Discretised first, post::SrifOptions factors,
               const plate::Analysis& analysis, plate::Stopwatch& stopwatch);

  /// Makes the last solution the one that the accessors return, then chooses the advance.
  void choose(const Equilibrium& state) override;
  void restore(plate::InArchive& archive) override;
  const plate::Formulation& plate() const override { return *seen_.found.plate; }
  const plate::State& state() const override { return seen_.state; }
  const plate::StaticSolution& solution() const override { return solution_; }
  const std::string& method() const { return method_; }
  double heated(double factor) const override;
  std::optional<std::vector<post::Srif>> factors(double factor) override;
  plate::Mesh draw(post::Frame& frame, const plate::State& state) const override;
  /// The plate in its plane at the last equilibrium, and its state under the whole load; null where nothing acts there.
  const plate::Formulation* membrane() const { return seen_.found.membrane.get(); }
  const plate::State& state_in_plane() const { return seen_.in_plane; }
  /// Contact of the faces of cracks at the last equilibrium, under a share of the load; none where faces may overlap.
  std::optional<post::ContactSummary> contact(double factor) const;

private:
  LoadedPlate full_load(const std::vector<geometry::Polyline>& cracks) override;
  std::string remedy() const override;
  /// A plate under the whole load.
  struct Solved {
    plate::Discretised found;
    plate::State state;
    std::vector<post::Srif> srifs;
    plate::State in_plane = plate::no_state();  // of the plate in its plane, where something acts there
    std::optional<post::ContactSummary> contact = {};

    double work() const;  // of the loads and of supports that move, as if both grew slowly
    bool moves(double work) const;
  };
  plate::Discretised discretised(const std::vector<geometry::Polyline>& cracks);
  std::string split(const plate::Discretised& found) const;
  void solve(plate::Discretised found, const std::vector<post::TipMethods>& methods);
  plate::State at_rest_in_plane(const plate::Formulation& membrane) const;
  void add_in_plane(Solved& solved, const std::vector<post::ClosedTip>& closed) const;

  plate::Problem problem_;
  const plate::Communicator& communicator_;
  std::optional<plate::Discretised> first_;
  post::SrifOptions options_of_factors_;
  const plate::Analysis& analysis_;
  plate::Stopwatch& stopwatch_;
  plate::StartOfCracks start_;
  std::optional<Solved> latest_;  // last; it may be a trial, or be followed by a failure
  Solved seen_;                   // at the last equilibrium
  double seen_factor_ = 1;        // of the load there
  plate::StaticSolution solution_;
  std::string method_;
};

}  // namespace fracture
