#include "plate/formulation/formulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plate/formulation/discretised.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/formulation/layout.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/process.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"

namespace plate {
Formulation::Formulation(Layout layout) {
  if (!layout.sections) layout.sections.emplace(layout.problem.section);
  layout_ = std::make_unique<Layout>(std::move(layout));
}

Formulation::~Formulation() = default;

const FormulationKind& Formulation::kind() const {
  return *discretization().formulation;
}

const Problem& Formulation::problem() const {
  return layout_->problem;
}

const Section& Formulation::section() const {
  return problem().section;
}

const PointSections& Formulation::sections() const {
  return *layout_->sections;
}

const Discretization& Formulation::discretization() const {
  return problem().discretization;
}

const std::vector<geometry::CrackPath>& Formulation::paths() const {
  return layout_->paths;
}

const std::vector<geometry::Tip>& Formulation::tips() const {
  return layout_->tips;
}

const Boundary& Formulation::boundary() const {
  return layout_->boundary;
}

const Communicator& Formulation::communicator() const {
  return *layout_->boundary.map.communicator;
}

bool Formulation::distributed() const {
  return boundary().map.distributed();
}

const geometry::Cloud& Formulation::cloud() const {
  return boundary().cloud;
}

bool Formulation::here(const geometry::Point& x) const {
  return boundary().here(x);
}

const Constraints& Formulation::constraints() const {
  return boundary().constraints;
}

Constraints Formulation::constraints_about() const {
  return constraints();
}

const std::vector<double>& Formulation::cut() const {
  return layout_->cut;
}

const std::vector<TimedLoad>& Formulation::loads() const {
  return layout_->loads;
}

const std::vector<Piece>& Formulation::pieces() const {
  return layout_->pieces;
}

const Mechanisms& Formulation::mechanisms() const {
  return layout_->mechanisms;
}

bool Formulation::may_move() const {
  return mechanisms().motions > 0 || !mechanisms().searched;
}

bool Formulation::held() const {
  return std::ranges::all_of(pieces(), [](const Piece& piece) { return piece.free_modes == 0; });
}

double Formulation::strain_energy(const State& state) const {
  return sum_of_points(energies(state));
}

double Formulation::sum_of_points(const Eigen::VectorXd& values) const {
  return ordered_sum<1>(*this, std::size_t(values.size()), [&](std::size_t k) {
    return std::array<double, 1>{boundary().owns(k) ? values[Eigen::Index(k)] : 0};
  })[0];
}

Forces Formulation::total_load() const {
  if (loads().empty()) return zero_forces(points());
  Forces load = loads().front().forces;
  for (std::size_t i = 1; i < loads().size(); ++i) load += loads()[i].forces;
  return load;
}

Forces Formulation::first_load() const {
  Forces load = zero_forces(loads().front().forces.cols());
  for (const auto& one : loads()) {
    const double share = plate::factor(one.history, 0);
    load += share * one.forces;
    if (one.moving) load += share * one.moving->whole(0, std::size_t(load.cols()));
  }
  return load;
}

Forces Formulation::mass(double rotary) const {
  return plate::mass(sections(), cloud().areas, boundary().active, constraints(), rotary);
}

Inertia Formulation::inertia(double rotary) const {
  return Inertia(mass(rotary));
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

std::size_t Formulation::fictitious_points() const {
  return boundary().fictitious.size();
}

std::unique_ptr<Preconditioner> Formulation::inverse_of_shifted(double) const {
  return held() && distributed() ? preconditioner(Preconditioning::automatic).inverse : nullptr;  // as at rest
}

std::unique_ptr<Preconditioner> Formulation::factor() const {
  throw std::logic_error("a factor was asked of a formulation that does not offer it");
}

void require_memory(const Problem& problem) {
  constexpr double least = 300;  // bytes per point: a million in motion by bonds, nothing written, took 350
  const double spacing = problem.discretization.spacing, points = geometry::area(problem.outline) / (spacing * spacing);
  const double there = free_memory();
  if (there > 0 && points * least > there)
    throw Refused({{Subject::spacing, 0,
                    fmt::format("{:g} given makes {:.2g} points, which take {:.3g} GB at the very least; {:.3g} GB are "
                                "free on this machine",
                                spacing, points, points * least / 1e9, there / 1e9)}});
}

std::vector<MemoryPart> memory_of(const Formulation& plate, bool single) {
  const double all = double(plate.cloud().size()), fictitious = double(plate.fictitious_points());
  std::vector<MemoryPart> parts{{"points", "geometry", all * (2 * sizeof(geometry::Point) + sizeof(double))},
                                {"families, by patterns of bonds", "families", double(plate.families().bytes())}};
  for (auto& part : plate.memory(single)) parts.push_back(std::move(part));
  if (fictitious > 0)
    parts.push_back({"fictitious points (part of the points)", "",
                     fictitious * (sizeof(FictitiousPoint) + unknowns_per_point * sizeof(Constraints::Tie))});
  if (const auto& elastic_supports = plate.boundary().elastic_supports; !elastic_supports.parts().empty())
    parts.push_back({"foundations and springs", "parameters", double(elastic_supports.bytes())});
  if (!plate.loads().empty())
    parts.push_back({"loads", "", double(plate.loads().size()) * unknowns_per_point * sizeof(double) * all});
  return parts;
}

double lowest_wave(const Formulation& plate) {
  const auto [low, high] = geometry::bounding_box(plate.problem().outline);
  const geometry::Point sides = high - low;
  std::array<bool, 2> held{sides.x() >= sides.y(), sides.y() >= sides.x()};
  for (const auto& side : plate.boundary().sides) {
    if (side.kind == SupportKind::free || side.kind == SupportKind::symmetry || side.support) continue;
    for (const int axis : {0, 1})
      if (side.circle || side.normal_axis() == axis || side.normal_axis() < 0) held[std::size_t(axis)] = true;
  }
  return std::numbers::pi * std::hypot(held[0] / sides.x(), held[1] / sides.y());
}

std::vector<std::string> warnings_about_rotary_inertia(const Formulation& plate, double factor) {
  if (factor == 1) return {};
  const double kh = lowest_wave(plate) * plate.section().thickness, share = kh * kh / 12;
  const double lower = 1 - std::sqrt((1 + share) / (1 + factor * share));
  return {fmt::format(
      "rotary inertia is {:g} times that of the plate: its lowest frequency is about {:.2g} % lower, higher "
      "ones more; set `rotary_inertia` = 1",
      factor, 100 * lower)};
}

}  // namespace plate
