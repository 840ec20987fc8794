#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

namespace plate {
class Formulation;
class LanczosMotion;
struct Analysis;
}  // namespace plate

namespace post {

class TipMethods;

/// The motion of a held Galerkin plate by Lanczos vectors that hold the factors of every tip with a fit to `truncation`
/// of the largest that it ever has, as far as LanczosOptions::watched_tolerance goes; truncated() has one entry per
/// tip, 0 without a fit; truncated_told() one for the reactions, Supports::elastic_forces(). `plate` must outlive it.
/// Throws NumericalError.
plate::LanczosMotion lanczos_motion(const plate::Analysis& analysis, const plate::Formulation& plate,
                                    const std::vector<TipMethods>& methods, const Eigen::MatrixXd& reactions,
                                    double truncation,
                                    const std::function<void(std::size_t vectors, double change)>& progress);

}  // namespace post
