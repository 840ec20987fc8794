#pragma once
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "plate/model/state.hpp"

namespace post {

struct Probe;
struct ResponsePeak;
struct Srif;
struct Table;

/// A quantity of a vibration at one frequency, (A + i B) with the load as its real part; its error bounds the
/// amplitude.
struct Response {
  double frequency;            // [1/time]
  std::string place;           // "tip 0", the name of a probe, "support left"
  std::string quantity;        // K1, K2, K3; w, theta_x, theta_y; force, moment_x, moment_y
  std::complex<double> value;  // in the quantity's own units
  std::optional<double> error;
  bool resolved = true;
};

/// K1, K2, K3 of every tip from those of A and of B, by recommended methods.
std::vector<Response> responses_of(double frequency, const std::vector<Srif>& in_phase,
                                   const std::vector<Srif>& quadrature);
/// Deflection and rotations of a probe, without errors, as those of the points are not known; `change`: what the
/// vectors leave, of the largest of w, theta times thickness: what is no larger is not resolved.
std::vector<Response> responses_of(double frequency, const Probe& probe, const plate::State& in_phase,
                                   const plate::State& quadrature, double change, double thickness);
/// w and theta times the thickness of a probe, as functionals (rows) of the state flattened.
Eigen::MatrixXd functionals(const Probe& probe, std::size_t points, double thickness);

/// frequency, place, quantity, amplitude, phase (degrees ahead of the load, in (-180, 180]), estimated_error; no
/// amplitude where it is not resolved.
Table response_table(const std::vector<Response>& all);

/// The largest amplitude of every quantity at every place, in the order of the first; what is below a millionth of the
/// largest of its kind is left out.
std::vector<ResponsePeak> largest_responses(const std::vector<Response>& all, double thickness);

/// Returns the largest responses as lines of text. `si`: with units.
std::string printed_responses(const std::vector<ResponsePeak>& peaks, bool si);

}  // namespace post
