#pragma once
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace plate {

/// Subject of a refusal: the item of a problem or of its analysis that a discretisation cannot carry.
enum class Subject {
  geometry,
  section,
  thickness_factor,
  young_factor,
  thermal_expansion,
  region,        // of the section
  region_shape,  // where it lies
  cracks,
  crack,  // one of them
  spacing,
  volume_correction,
  surface_correction,
  edge_method,
  support,
  support_kind,
  support_points,
  support_in_plane,
  support_line,
  support_patch,
  support_edges,
  support_direction,  // of its edges
  load_position,
  load_edges,
  load_patch,
  load_line,
  load_expression,
  load_mean,
  settlement,
  load_table,
  load_path,
  foundation,
  foundation_patch,
  spring,
  spring_edges,
  spring_line,
  spring_position,
  spring_cracks,
  spring_depth,
  stiffener,
  stiffener_edges,
  stiffener_line,
  // of its analysis
  preconditioner,
  precision,
  modes,
  time_step,
  duration,
  rows,
  density
};

/// Refusal of a problem that a discretisation cannot carry.
struct Refusal {
  Subject subject;
  std::size_t number;  // of the support or load
  std::string what;
};

/// A discretisation that cannot carry its problem: all reasons together.
class Refused : public std::runtime_error {
public:
  explicit Refused(std::vector<Refusal> reasons)
      : std::runtime_error(reasons.front().what), reasons_(std::move(reasons)) {}
  const std::vector<Refusal>& reasons() const { return reasons_; }

private:
  std::vector<Refusal> reasons_;
};

/// The numbers failed: not finite, or an iteration that does not converge. The message says where and when.
class NumericalError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
  NumericalError(const std::string& message, std::size_t at) : std::runtime_error(message), point(at) {}

  std::optional<std::size_t> point = {};  // where it is one
};

/// A stiffness that is not positive: something can move without resistance.
class NotPositive : public NumericalError {
public:
  using NumericalError::NumericalError;
};

}  // namespace plate
