#include "plate/galerkin/stretched_stiffeners.hpp"

namespace plate {
namespace {

/// Elongation and force of an element of a stiffener by a state.
struct Pulled {
  double turned = 0, rise = 0;  // elongation of the axis by rotations of the plate, difference of the deflections
  double force = 0;             // in the axis [force]

  Pulled(const AxialElement& element, const State& bending, const State& membrane) {
    const auto sum = [](const std::vector<FormTerm>& form, const State& state) {
      double result = 0;
      for (const auto& [dof, factor] : form) result += factor * at_dof(state, dof);
      return result;
    };
    turned = element.eccentricity * sum(element.pull, bending), rise = sum(element.rise, bending);
    force = element.stiffness * (sum(element.pull, membrane) + turned + rise * rise / (2 * element.length));
  }
};

void add_form(const std::vector<FormTerm>& form, double share, Forces& forces) {
  for (const auto& [dof, factor] : form) at_dof(forces, dof) += share * factor;
}

}  // namespace

/// All of an element goes to its first point.
Eigen::VectorXd StretchedStiffeners::energies(const State& bending, const State& membrane) const {
  Eigen::VectorXd result = plane_->energies(bending, membrane);
  for (const auto& element : elements_) {
    const Pulled now(element, bending, membrane);
    const double own = element.stiffness * now.turned * now.turned;
    result[Eigen::Index(element.rise.front().dof.point)] += (now.force * now.force / element.stiffness - own) / 2;
  }
  return result;
}

void StretchedStiffeners::internal_force(const State& bending, const State& membrane, Forces& on_bending,
                                         Forces& on_membrane) const {
  plane_->internal_force(bending, membrane, on_bending, on_membrane);
  for (const auto& element : elements_) {
    const Pulled now(element, bending, membrane);
    add_form(element.pull, -now.force, on_membrane);
    add_form(element.pull, -element.eccentricity * (now.force - element.stiffness * now.turned), on_bending);
    add_form(element.rise, -now.force * now.rise / element.length, on_bending);
  }
}

PointMatrix StretchedStiffeners::stiffness(const State& bending, const State& membrane) const {
  const auto points = std::uint32_t(bending.cols());
  ElasticSupportSum sum(2 * std::size_t(points));
  for (const auto& element : elements_) {
    const Pulled now(element, bending, membrane);
    std::vector<FormTerm> all, turned;
    for (const auto& [dof, factor] : element.pull) {
      all.push_back({{dof.point + points, dof.component}, factor});
      if (element.eccentricity != 0) turned.push_back({dof, element.eccentricity * factor});
    }
    all.insert(all.end(), turned.begin(), turned.end());
    for (const auto& [dof, factor] : element.rise) all.push_back({dof, factor * now.rise / element.length});
    sum.add(element.stiffness, all), sum.add(-element.stiffness, turned);
    sum.add(now.force / element.length, element.rise);
  }
  return with(plane_->stiffness(bending, membrane), ElasticSupports({std::move(sum).taken("stiffeners", {}, false)}));
}

/// Axial forces of stiffeners come by Formulation::with_coupling_forces(), which knows the rotations too.
PointMatrix StretchedStiffeners::geometric_stiffness(const State& membrane) const {
  return plane_->geometric_stiffness(membrane);
}

Stretch StretchedStiffeners::stretch(const State& bending) const {
  Stretch result = plane_->stretch(bending);
  const State flat = zero_like(bending);
  for (const auto& element : elements_) add_form(element.pull, -Pulled(element, bending, flat).force, result.forces);
  return result;
}

}  // namespace plate
