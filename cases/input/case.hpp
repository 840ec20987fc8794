#pragma once
#include <map>
#include <optional>
#include "fracture/growth/criteria.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/solver_choices.hpp"
#include "post/factors/srif.hpp"

/// The application: case files in, results out.
namespace cases {

struct Analysis {
  enum class Kind { static_, dynamic, frequencies };
  enum class Method { adr, cg, direct, central_difference, lanczos };
  enum class Precision { double_, mixed };
  enum class Start { undeformed, equilibrium };
  Kind kind = Kind::static_;
  Method method = Method::cg;
  plate::Preconditioning preconditioner = plate::Preconditioning::automatic;  // of cg
  double tolerance = 1e-6;                   // static: residual / load; frequencies: of the eigenpairs, 1e-4 by default
  std::size_t max_iterations = 200000;       // static; frequencies: of each solution
  std::size_t modes = 6;                     // frequencies
  double duration = 0;                       // dynamic [time]
  std::optional<double> time_step;           // dynamic; absent: from the computed bound
  Start start = Start::undeformed;           // dynamic; equilibrium: under the loads of time 0
  double rotary_inertia = 1;                 // dynamic: over that of the plate
  Precision precision = Precision::double_;  // dynamic; mixed: internal forces in single
  double safety = 0.95;                      // dynamic: share of the stable step that is used

  /// In statics; in dynamics conjugate gradients.
  plate::StaticMethod static_method() const {
    return method == Method::adr      ? plate::StaticMethod::adr
           : method == Method::direct ? plate::StaticMethod::direct
                                      : plate::StaticMethod::cg;
  }
  /// Is an equilibrium wanted, for itself or to start from?
  bool finds_equilibrium() const {
    return kind == Kind::static_ || (kind == Kind::dynamic && start == Start::equilibrium);
  }
};

struct Output {
  bool vtk = true, hdf5 = true;
  std::optional<bool> report;   // absent: where fields are written
  std::optional<double> every;  // dynamic: time between frames; absent: first and last only
  std::optional<double>
      history_every;  // dynamic: time between rows of history, probes and SRIFs; absent: duration / 400
  std::map<std::string, geometry::Point> probes;

  bool reports() const { return report.value_or(vtk || hdf5); }
};

/// One whole simulation, as plain data: a plate, and what is done with it.
struct Case : plate::Problem {
  std::string title, source, units = "none";
  std::string formulation_reason = "as the case says";  // why discretization.formulation is what it is
  Analysis analysis;
  std::optional<fracture::Growth> growth;
  std::optional<post::SrifOptions> srif;
  Output output;
};

}  // namespace cases
