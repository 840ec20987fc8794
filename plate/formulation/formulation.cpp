#include "plate/formulation/formulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plate {

bool Formulation::held() const {
  return std::ranges::all_of(pieces(), [](const Piece& piece) { return piece.free_modes == 0; });
}

Forces Formulation::total_load() const {
  Forces load = loads().front().forces;
  for (std::size_t i = 1; i < loads().size(); ++i) load += loads()[i].forces;
  return load;
}

Forces Formulation::first_load() const {
  Forces load = Forces::Zero(3, loads().front().forces.cols());
  for (const auto& one : loads()) load += plate::factor(one.history, 0) * one.forces;
  return load;
}

Forces Formulation::mass(double rotary) const {
  return plate::mass(section(), cloud().areas, boundary().active, constraints(), rotary);
}

std::size_t Formulation::bonds() const {
  std::size_t count = 0;
  for (std::size_t k = 0; k < cloud().plate_points; ++k)
    for (const auto& bond : families()[k]) count += boundary().is_plate(bond.neighbour);
  return count;
}

std::size_t Formulation::fictitious_bonds() const {
  return families().bonds() - bonds();
}

std::unique_ptr<Preconditioner> Formulation::factor() const {
  throw std::logic_error("a factor was asked of a formulation that does not offer it");
}

Discretised discretise(const Problem& problem) {
  return problem.discretization.formulation->discretise(problem);
}

std::vector<geometry::CrackPath> crack_paths(const Problem& problem) {
  return geometry::crack_paths(problem.outline, problem.cracks, geometry::tolerance(problem.outline));
}

double lowest_wave(const Formulation& plate) {
  const auto [low, high] = geometry::bounding_box(plate.problem().outline);
  const geometry::Point sides = high - low;
  std::array<bool, 2> held{sides.x() >= sides.y(), sides.y() >= sides.x()};
  for (const auto& side : plate.boundary().sides) {
    if (side.kind == SupportKind::free || side.kind == SupportKind::symmetry) continue;
    for (const int axis : {0, 1})
      if (side.circle || side.normal_axis() == axis || side.normal_axis() < 0) held[std::size_t(axis)] = true;
  }
  return std::numbers::pi * std::hypot(held[0] / sides.x(), held[1] / sides.y());
}

}  // namespace plate
