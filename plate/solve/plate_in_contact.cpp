#include "plate/solve/plate_in_contact.hpp"

#include <fmt/format.h>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/statics.hpp"

namespace plate {
namespace {

constexpr auto flies = "nothing holds the plate any more where its soil lets it lift off: it tips or flies off";

/// Collective: true where foundations are in contact at the same places on all ranks.
bool same_everywhere(const Formulation& plate, const ContactState& one, const ContactState& other) {
  bool differ = false;
  const auto& parts = plate.boundary().elastic_supports.parts();
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t p = 0; p < one[i].size(); ++p)
      if (one[i][p] != other[i][p] && plate.boundary().owns(parts[i]->contact->point(p, plate.points()))) differ = true;
  return largest_of(plate, differ) == 0;
}

}  // namespace

PointMatrix with_contact_at(const ContactState& touching, const ElasticSupports& elastic_supports,
                            PointMatrix everywhere) {
  const auto points = everywhere.points();
  ElasticSupportSum lifted(points);
  for (std::size_t i = 0; i < touching.size(); ++i)
    for (std::size_t p = 0; p < touching[i].size(); ++p) {
      if (touching[i][p]) continue;
      const auto place = elastic_supports.parts()[i]->contact->place(p);
      std::vector<FormTerm> form;
      for (const auto& [index, factor] : place.form) form.push_back({dof_at(index, points), factor});
      lifted.add(-place.stiffness, form);
    }
  return with(std::move(everywhere), ElasticSupports({std::move(lifted).taken("lifted", {})}));
}

void require_contact(const Formulation& plate, const Forces& load, const State& lift, const State& state) {
  constexpr double left = 1e-3;  // of the load
  if (PrescribedDisplacements(plate, load, lift).residual(state).share > left) throw NumericalError(flies);
}

double potential(const Formulation& plate, const Forces& load, const State& state) {
  return -ordered_sum<1>(plate, plate.points(), [&](std::size_t k) {
    const auto i = Eigen::Index(k);
    return std::array<double, 1>{plate.boundary().owns(k) ? load.col(i).dot(state.col(i)) : 0};
  })[0];
}

/// The energy is convex and has a continuous slope: a step of Newton that does not lower it is halved until it does.
StaticSolution contact_with_soil(const Formulation& plate, const RestOnSoil& rest) {
  constexpr int most = 60, halvings = 12;
  std::size_t iterations = 0;
  auto touching = everywhere(plate.boundary().elastic_supports);
  State state;
  for (int n = 0;; ++n) {
    StaticSolution solution;
    try {
      solution = rest.solve(touching, n == 0 ? nullptr : &state);
    } catch (const NotPositive&) {
      throw NumericalError(flies);
    }
    iterations += solution.iterations;
    solution.iterations = iterations;
    if (!solution.converged) {
      solution.stop_reason += fmt::format(", in step {} of the search for what soil touches", n + 1);
      return solution;
    }
    auto now = rest.touching(solution.state);
    if (same_everywhere(plate, now, touching)) {
      solution.stop_reason += fmt::format(", what soil touches found in {} steps", n + 1);
      return solution;
    }
    if (n == most) {
      solution.converged = false;
      solution.stop_reason = fmt::format("what soil touches still changes after {} steps", most);
      return solution;
    }
    if (n > 0) {
      const State step = solution.state - state;
      const double before = rest.energy(state);
      double share = 1;
      for (int i = 0; i < halvings && rest.energy(state + share * step) > before; ++i) share /= 2;
      if (share < 1) now = rest.touching(solution.state = state + share * step);
    }
    touching = std::move(now), state = std::move(solution.state);
  }
}

}  // namespace plate
