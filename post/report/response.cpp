#include "post/report/response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "plate/model/space.hpp"
#include "post/files/recorder.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"

namespace post {
namespace {

constexpr std::array factor_names{"K1", "K2", "K3"};

/// Quantities of one kind are compared with each other.
std::string kind_of(const std::string& quantity) {
  return quantity.starts_with('K') ? "K" : quantity.substr(0, quantity.find('_'));
}

/// Amplitude in the units of K1, for comparison of the three factors.
double size_of(const std::string& quantity, double amplitude, double thickness) {
  return quantity == "K3" ? amplitude * thickness : amplitude;
}

}  // namespace

std::vector<Response> responses_of(double frequency, const std::vector<Srif>& in_phase,
                                   const std::vector<Srif>& quadrature) {
  const auto real = recommended(in_phase), imaginary = recommended(quadrature);
  std::vector<Response> result;
  for (std::size_t t = 0; t < real.size(); ++t)
    for (std::size_t k = 0; k < factor_names.size(); ++k) {
      double values[2]{}, error = 0;
      bool known = true;
      for (const auto* part : {real[t], imaginary.at(t)}) {
        const double value = std::array{part->K1, part->K2, part->K3}[k];
        values[part == imaginary[t]] = value;
        known = known && part->errors[k];
        const double own = part->errors[k].value_or(0);
        error = std::hypot(error, part->resolved[k] ? own : std::max(own, std::abs(value)));
      }
      const std::complex value(values[0], values[1]);
      const bool resolved = std::abs(value) > 0 && error < std::abs(value);
      result.push_back({frequency, fmt::format("tip {}", real[t]->tip), factor_names[k], value,
                        known ? std::optional(error) : std::nullopt, resolved});
    }
  return result;
}

std::vector<Response> responses_of(double frequency, const Probe& probe, const plate::State& in_phase,
                                   const plate::State& quadrature, double change, double thickness) {
  const plate::PointValues a = plate::value_at(probe.shares, in_phase), b = plate::value_at(probe.shares, quadrature);
  double largest = 0;
  for (Eigen::Index c = 0; c < plate::unknowns_per_point; ++c)
    largest = std::max(largest, std::hypot(a[c], b[c]) * (c == 0 ? 1 : thickness));
  std::vector<Response> result;
  for (Eigen::Index c = 0; c < plate::unknowns_per_point; ++c) {
    const double error = change * largest / (c == 0 ? 1 : thickness);
    const std::complex value(a[c], b[c]);
    result.push_back({frequency,
                      probe.name,
                      std::array{"w", "theta_x", "theta_y"}[std::size_t(c)],
                      value,
                      {},
                      error < std::abs(value) || error == 0});
  }
  return result;
}

Eigen::MatrixXd functionals(const Probe& probe, std::size_t points, double thickness) {
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(plate::unknowns_per_point, plate::unknowns_per_point * Eigen::Index(points));
  for (std::uint32_t c = 0; c < plate::unknowns_per_point; ++c)
    for (const auto& [dof, factor] : plate::terms_of(probe.shares, c))
      result(c, Eigen::Index(plate::index_in_state(dof, points))) = factor * (c == 0 ? 1 : thickness);
  return result;
}

Table response_table(const std::vector<Response>& all) {
  Table table{{"frequency", "place", "quantity", "amplitude", "phase", "estimated_error"}, {}};
  for (const auto& one : all) {
    const double degrees = std::arg(one.value) * 180 / std::numbers::pi;
    table.rows.push_back({one.frequency, one.place, one.quantity, one.resolved ? Cell(std::abs(one.value)) : Cell(),
                          one.resolved ? Cell(degrees) : Cell(), cell(one.error)});
  }
  return table;
}

std::vector<ResponsePeak> largest_responses(const std::vector<Response>& all, double thickness) {
  constexpr double nothing = 1e-6;
  std::vector<ResponsePeak> result;
  for (const auto& one : all) {
    if (!one.resolved) continue;
    const double amplitude = std::abs(one.value);
    const auto same = std::ranges::find_if(
        result, [&](const ResponsePeak& peak) { return peak.place == one.place && peak.quantity == one.quantity; });
    const ResponsePeak peak{one.place, one.quantity, amplitude, one.frequency, one.error};
    if (same == result.end())
      result.push_back(peak);
    else if (amplitude > same->amplitude)
      *same = peak;
  }
  const auto most = [&](const ResponsePeak& peak) {
    double largest = 0;
    for (const auto& other : result)
      if (kind_of(other.quantity) == kind_of(peak.quantity))
        largest = std::max(largest, size_of(other.quantity, other.amplitude, thickness));
    return largest;
  };
  std::vector<ResponsePeak> felt;
  for (const auto& peak : result)
    if (size_of(peak.quantity, peak.amplitude, thickness) > nothing * most(peak)) felt.push_back(peak);
  return felt;
}

std::string printed_responses(const std::vector<ResponsePeak>& peaks, bool si) {
  std::string text;
  const bool opens = std::ranges::find(peaks, "K1", &ResponsePeak::quantity) != peaks.end();
  if (!peaks.empty())
    fmt::format_to(std::back_inserter(text), "largest amplitudes{}:\n",
                   opens ? ", for crack faces that a static load keeps apart" : "");
  const auto unit = [&](const std::string& quantity) {
    if (!si || quantity.starts_with("theta")) return "";
    if (quantity == "force") return " N";
    if (quantity.starts_with("moment")) return " N m";
    return quantity == "w" ? " m" : quantity == "K3" ? " N m^-1/2" : " N m^1/2";
  };
  for (const auto& one : peaks)
    fmt::format_to(std::back_inserter(text), "{:>12} {:<8} {:>13.6g}{} at the frequency {:.6g}{}\n", one.place,
                   one.quantity, one.amplitude, unit(one.quantity), one.frequency,
                   one.error ? fmt::format(" +- {:.2g}", *one.error) : "");
  return text;
}

}  // namespace post
