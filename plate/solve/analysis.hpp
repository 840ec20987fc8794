#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "plate/model/numerical_method.hpp"

namespace plate {

/// Growth of loads with large deflections at rest: by their factor, or along the path of equilibria, on which the
/// factor is an unknown, through limit points.
enum class LoadControl : bool { load, arc_length };

enum class AnalysisKind { static_, dynamic, frequencies, harmonic, buckling };

/// Kind of analysis of a plate, with its methods and parameters.
struct Analysis {
  using Kind = AnalysisKind;
  enum class Method { adr, cg, direct, central_difference, lanczos };
  enum class Precision { double_, mixed };
  enum class Start { undeformed, equilibrium };
  Kind kind = Kind::static_;
  Method method = Method::cg;
  Preconditioning preconditioner = Preconditioning::automatic;  // of cg
  double tolerance = 1e-6;                   // static: residual / load; frequencies: of the eigenpairs, 1e-4 by default
  std::size_t max_iterations = 200000;       // static; frequencies: of each solution
  bool nonlinear = false;                    // static, dynamic: large deflections
  LoadControl control = LoadControl::load;   // static, with large deflections
  std::uint32_t max_steps = 500;             // by arc length
  std::size_t modes = 6;                     // frequencies, buckling
  double duration = 0;                       // dynamic [time]
  std::optional<double> time_step;           // dynamic; absent: from the computed bound
  Start start = Start::undeformed;           // dynamic; equilibrium: under the loads of time 0
  double rotary_inertia = 1;                 // dynamic: over that of the plate
  Precision precision = Precision::double_;  // dynamic; mixed: internal forces in single
  double safety = 0.95;                      // dynamic: share of the stable step that is used
  std::optional<Damping> damping = {};       // dynamic, harmonic
  std::optional<Sweep> sweep = {};           // harmonic

  /// Method of statics; in dynamics conjugate gradients.
  StaticMethod static_method() const {
    return method == Method::adr      ? StaticMethod::adr
           : method == Method::direct ? StaticMethod::direct
                                      : StaticMethod::cg;
  }
  /// True where an equilibrium is wanted, for itself or to start from.
  bool finds_equilibrium() const {
    return kind == Kind::static_ || kind == Kind::harmonic || kind == Kind::buckling ||
           (kind == Kind::dynamic && start == Start::equilibrium);
  }
};

/// Name of a kind of analysis in case files and results.
inline const char* name_of(AnalysisKind kind) {
  switch (kind) {
    case AnalysisKind::static_:
      return "static";
    case AnalysisKind::dynamic:
      return "dynamic";
    case AnalysisKind::frequencies:
      return "frequencies";
    case AnalysisKind::buckling:
      return "buckling";
    case AnalysisKind::harmonic:
      break;
  }
  return "harmonic";
}

/// Kind of analysis of a name; none of any other text.
inline std::optional<AnalysisKind> analysis_kind(std::string_view name) {
  using enum AnalysisKind;
  for (const auto kind : {static_, dynamic, frequencies, harmonic, buckling})
    if (name == name_of(kind)) return kind;
  return std::nullopt;
}

}  // namespace plate
