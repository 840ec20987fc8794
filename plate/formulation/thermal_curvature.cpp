#include "plate/formulation/thermal_curvature.hpp"

#include <algorithm>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/section.hpp"

namespace plate {

std::optional<LinearStrain> linear_strain(const Problem& problem, const Load& load) {
  constexpr double rounding = 1e-12;
  constexpr double least = 9, most = 400;  // places along each side, about a spacing apart
  const auto* heat = load.as<Temperature>();
  const double alpha = problem.section.thermal_expansion;
  if (!heat || problem.section.law != PlateLaw::membrane || !problem.stiffeners.empty() || problem.section.couples())
    return std::nullopt;
  if (!heat->formula.given()) return LinearStrain{alpha * heat->value};
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const geometry::Point size = high - low;
  const auto at = [&](double a, double b) { return heat->formula(low + geometry::Point(a * size.x(), b * size.y())); };
  const double corner = at(0, 0), along = at(1, 0) - corner, up = at(0, 1) - corner;
  const double largest = std::abs(corner) + std::abs(along) + std::abs(up);
  const auto places = [&](double side) {
    return int(std::clamp(std::ceil(side / problem.discretization.spacing), least, most));
  };
  const int columns = places(size.x()), rows = places(size.y());
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const double a = (i + 0.5) / columns, b = (j + 0.5) / rows;
      if (!(std::abs(at(a, b) - corner - a * along - b * up) <= rounding * largest)) return std::nullopt;
    }
  const geometry::Point gradient = alpha * geometry::Point(along / size.x(), up / size.y());
  return LinearStrain{alpha * corner - gradient.dot(low), gradient};
}

Heat heat_of(const Formulation& plate, const std::vector<double>& shares) {
  const bool on_edges = plate.offers(Feature::graded_points);  // of bonds no linear field is exact there
  Heat result;
  for (std::size_t i = 0; i < plate.loads().size(); ++i) {
    const auto& load = plate.loads()[i];
    if (load.curvature.size() == 0 || shares[i] == 0) continue;
    if (result.none()) {
      result.curvature = Eigen::VectorXd::Zero(load.curvature.size());
      result.forces = zero_forces(load.forces.cols());
      result.linear.emplace();
    }
    const auto strain =
        on_edges && result.linear ? linear_strain(plate.problem(), plate.problem().loads[i]) : std::nullopt;
    if (strain)
      result.linear->at_origin += shares[i] * strain->at_origin,
          result.linear->gradient += shares[i] * strain->gradient;
    else
      result.linear.reset();
    result.curvature += shares[i] * load.curvature, result.forces += shares[i] * load.forces;
    const auto beside = free_curvature_beside(plate.problem().loads[i], plate.section(), plate.cloud().positions,
                                              std::size_t(load.curvature.size()));
    if (beside.size() == 0) continue;
    if (result.beside.size() == 0) result.beside = Eigen::VectorXd::Zero(beside.size());
    result.beside += shares[i] * beside;
  }
  return result;
}

Heat heat_at(const Formulation& plate, double time) {
  std::vector<double> shares;
  for (const auto& load : plate.loads()) shares.push_back(factor(load.history, time));
  return heat_of(plate, shares);
}

Heat heat_of(const Formulation& plate, double share) {
  return heat_of(plate, std::vector<double>(plate.loads().size(), share));
}

Eigen::Vector3d moments_held_flat(const Section& section) {
  if (section.expands_by_plies()) return held_plies(section).resultants;
  if (section.isotropic()) {
    const double each = section.bending_stiffness() * (1 + section.poisson);
    return {each, each, 0};
  }
  return LocalSection(section).bending * Eigen::Vector3d(1, 1, 0);
}

Eigen::Matrix3Xd held_forces(const Section& section, const Heat& heat) {
  Section coupling = section;
  coupling.law = PlateLaw::coupling;
  Eigen::Matrix3Xd result = moments_held_flat(section) * heat.curvature.transpose();
  if (heat.beside.size() > 0) result += moments_held_flat(coupling) * heat.beside.transpose();
  return result;
}

State free_field(const std::vector<geometry::Point>& positions, const geometry::Point& place,
                 const LinearStrain& strain) {
  State result = zero_state(positions.size());
  const double there = strain.at(place);
  const auto& gradient = strain.gradient;
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    const geometry::Point x = positions[std::size_t(k)] - place;
    const double across = (x.x() * x.x() - x.y() * x.y()) / 2, both = x.x() * x.y();
    const double u = there * x.x() + gradient.x() * across + gradient.y() * both,
                 v = there * x.y() - gradient.y() * across + gradient.x() * both;
    result.col(k) = PointValues(0, -v, u);
  }
  return result;
}

State free_field(const std::vector<geometry::Point>& positions, const Problem& problem, const LinearStrain& strain) {
  return free_field(positions, geometry::bounding_box(problem.outline).first, strain);
}

/// The excess where the strains of the heat are linear, and free_field() has no energy: of forces f that hold it
/// f (free_field() / 2 - u).
double stored_by_linear(const Formulation& plate, const Heat& heat, const State& state) {
  const State free = free_field(plate.cloud().positions, plate.problem(), *heat.linear);
  return ordered_sum<1>(plate, std::size_t(state.cols()), [&](std::size_t n) {
    const auto k = Eigen::Index(n);
    const bool counts = plate.boundary().owns(n);
    return std::array<double, 1>{counts ? heat.forces.col(k).dot(free.col(k) / 2 - state.col(k)) : 0};
  })[0];
}

namespace {

/// Energy per area of a plate that is held flat, by the square of its free curvature.
double energy_held_flat(const Section& section) {
  if (section.expands_by_plies()) return held_plies(section).energy;
  return moments_held_flat(section).head<2>().sum() / 2;
}

}  // namespace

double stored(const Formulation& plate, const Heat& heat, const State& state) {
  if (!heated(plate.problem())) return 0;
  if (heat.linear && heat.linear->varies()) return stored_by_linear(plate, heat, state);
  const double each = energy_held_flat(plate.section());
  Section coupling = plate.section();
  coupling.law = PlateLaw::coupling;
  const double with_other = heat.beside.size() > 0 ? energy_held_flat(coupling) : 0;  // of each of both the half
  const auto held_flat = [&](Eigen::Index k) {
    const double own = plate.cloud().areas[std::size_t(k)] * heat.curvature[k];
    return each * (own * heat.curvature[k]) + (with_other != 0 ? with_other * own * heat.beside[k] : 0);
  };
  return ordered_sum<1>(plate, std::size_t(state.cols()), [&](std::size_t n) {
    const auto k = Eigen::Index(n);
    if (heat.none() || !plate.boundary().owns(n)) return std::array<double, 1>{0};
    return std::array<double, 1>{(k < heat.curvature.size() ? held_flat(k) : 0) - heat.forces.col(k).dot(state.col(k))};
  })[0];
}

void relieve(Resultants& resultants, const Section& section, const Heat& heat) {
  if (heat.none() || resultants.moments.cols() == 0) return;
  const Eigen::Vector3d each = moments_held_flat(section);
  for (Eigen::Index k = 0; k < heat.curvature.size(); ++k)
    set_moments(resultants, k, resultants.moments.col(k) - heat.curvature[k] * each, section);
}

State cold(const State& state, const std::vector<geometry::Point>& positions, const geometry::Point& place,
           double curvature) {
  State result = state;
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    const geometry::Point x = positions[std::size_t(k)] - place;
    result.col(k) += curvature * PointValues(x.squaredNorm() / 2, x.y(), -x.x());
  }
  return result;
}

}  // namespace plate
