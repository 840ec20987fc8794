#include "tests/verification/verified_plate.hpp"

#include <random>

namespace verified_plate {

cases::Case free_plate(const geometry::Outline& outline, double spacing) {
  cases::Case c;
  c.section = section;
  c.outline = outline;
  c.discretization.formulation = &plate::ordinary;
  c.discretization.spacing = spacing;
  c.analysis.kind = cases::Analysis::Kind::dynamic;
  c.loads = {plate::Load{plate::Pressure{.value = 1}}};
  return c;
}

cases::Case square(double spacing) {
  return free_plate(geometry::rectangle(-1, -1, 1, 1), spacing);
}

cases::Case cracked_with_hole() {
  auto outline = geometry::rectangle(0, 0, 1.2, 1.0);
  outline.holes.push_back(geometry::Circle{{0.78, 0.52}, 0.17, "hole0"});
  auto c = free_plate(outline, 0.1);
  c.section.thickness = 0.25;
  c.cracks = {{{0.21, 0.23}, {0.47, 0.81}}};
  return c;
}

plate::Support held(plate::SupportKind kind, std::vector<std::string> edges) {
  return {kind, std::move(edges), {}};
}

plate::Support held_all_round(plate::SupportKind kind) {
  return held(kind, {"left", "right", "bottom", "top"});
}

std::unique_ptr<plate::Formulation> assembled(const cases::Case& c) {
  return cases::discretised({c, {}}).plate;
}

plate::StaticSolution solved(const plate::Formulation& a, double tolerance) {
  return plate::conjugate_gradients(a, a.constraints(), a.total_load(), {tolerance, 100000, {}});
}

Eigen::Index size(const plate::Formulation& a) {
  return static_cast<Eigen::Index>(a.points());
}

plate::State random_state(const plate::Formulation& a, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  plate::State u = plate::State::NullaryExpr(3, size(a), [&] { return uniform(random); });
  a.constraints().impose(u);
  return u;
}

plate::Forces folded_force(const plate::Formulation& a, const plate::State& u) {
  plate::Forces force;
  a.internal_force(u, force);
  a.constraints().fold(force);
  return force;
}

}  // namespace verified_plate
