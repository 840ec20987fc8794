#pragma once
#include <numbers>

#include "cases/driver/prepared.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/solve/statics.hpp"

/// Plates for verification, turned into points and bonds by the very function that the program uses.
namespace verified_plate {

inline const plate::Section section{1000, 0.3, 0.1, 5.0 / 6, 2};

/// A free plate of bonds; the kind "dynamic" lets it be assembled without supports.
cases::Case free_plate(const geometry::Outline& outline, double spacing);

/// 2 x 2, edges left, right, bottom, top.
cases::Case square(double spacing);

/// A hole and an oblique crack beside it, 12 x 10 points.
cases::Case cracked_with_hole();

plate::Support held(plate::SupportKind kind, std::vector<std::string> edges);

plate::Support held_all_round(plate::SupportKind kind);

std::unique_ptr<plate::Formulation> assembled(const cases::Case& c);

plate::StaticSolution solved(const plate::Formulation& a, double tolerance = 1e-10);

Eigen::Index size(const plate::Formulation& a);

/// Random at free degrees of freedom, what the constraints say at all others.
plate::State random_state(const plate::Formulation& a, unsigned seed);

/// P^T f of a state u = P q.
plate::Forces folded_force(const plate::Formulation& a, const plate::State& u);

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
