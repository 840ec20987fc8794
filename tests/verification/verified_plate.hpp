#pragma once
#include <numbers>
#include <random>

#include "cases/driver/discretised.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/solve/statics.hpp"

/// Plates for verification, turned into points and bonds by the very function that the program uses.
namespace verified_plate {

inline const plate::Section section{1000, 0.3, 0.1, 5.0 / 6, 2};

/// A free plate of bonds; the kind "dynamic" lets it be assembled without supports.
inline cases::Case free_plate(const geometry::Outline& outline, double spacing) {
  cases::Case c;
  c.section = section;
  c.outline = outline;
  c.discretization.formulation = &plate::ordinary;
  c.discretization.spacing = spacing;
  c.analysis.kind = cases::Analysis::Kind::dynamic;
  plate::Load pressure;
  pressure.value = 1;
  c.loads = {pressure};
  return c;
}

/// 2 x 2, edges left, right, bottom, top.
inline cases::Case square(double spacing) {
  return free_plate(geometry::rectangle(-1, -1, 1, 1), spacing);
}

/// A hole and an oblique crack beside it, 12 x 10 points.
inline cases::Case cracked_with_hole() {
  auto outline = geometry::rectangle(0, 0, 1.2, 1.0);
  outline.holes.push_back(geometry::Circle{{0.78, 0.52}, 0.17, "hole0"});
  auto c = free_plate(outline, 0.1);
  c.section.thickness = 0.25;
  c.cracks = {{{0.21, 0.23}, {0.47, 0.81}}};
  return c;
}

inline plate::Support held(plate::SupportKind kind, std::vector<std::string> edges) {
  return {kind, std::move(edges), {}};
}

inline plate::Support held_all_round(plate::SupportKind kind) {
  return held(kind, {"left", "right", "bottom", "top"});
}

inline std::unique_ptr<plate::Formulation> assembled(const cases::Case& c) {
  return cases::discretised({c, {}}).plate;
}

inline plate::StaticSolution solved(const plate::Formulation& a, double tolerance = 1e-10) {
  return plate::conjugate_gradients(a, a.constraints(), a.total_load(), {tolerance, 100000, {}});
}

inline Eigen::Index size(const plate::Formulation& a) {
  return static_cast<Eigen::Index>(a.points());
}

/// Random at free degrees of freedom, what the constraints say at all others.
inline plate::State random_state(const plate::Formulation& a, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  plate::State u = plate::State::NullaryExpr(3, size(a), [&] { return uniform(random); });
  a.constraints().impose(u);
  return u;
}

/// P^T f of a state u = P q.
inline plate::Forces folded_force(const plate::Formulation& a, const plate::State& u) {
  plate::Forces force;
  a.internal_force(u, force);
  a.constraints().fold(force);
  return force;
}

/// A field (w, theta_x, theta_y) at every point, fictitious ones too.
template <typename Field>
plate::State field(const plate::Formulation& a, const Field& at) {
  plate::State u(3, size(a));
  for (Eigen::Index k = 0; k < u.cols(); ++k) u.col(k) = at(a.cloud().positions[std::size_t(k)]);
  return u;
}

inline const auto surface_corrections = {plate::SurfaceCorrection::none, plate::SurfaceCorrection::volume,
                                         plate::SurfaceCorrection::arbitrary_horizon,
                                         plate::SurfaceCorrection::position_aware};

}  // namespace verified_plate
