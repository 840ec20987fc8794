#include "plate/solve/motion/contact_and_damping.hpp"

#include "plate/formulation/constraints.hpp"
#include "plate/model/nodal_forces.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/solve/motion/chain.hpp"

using namespace plate;
using spring_chain::Chain;

namespace {

/// A point that nothing holds.
class Free : public Operator {
public:
  std::size_t points() const override { return 1; }
  void internal_force(const State&, Forces& forces) const override { forces = Forces::Zero(3, 1); }
  void absolute_product(const State&, Forces& forces) const override { forces = Forces::Zero(3, 1); }
  Forces diagonal() const override { return Forces::Zero(3, 1); }
};

struct Seen {
  std::vector<double> force, velocity, of_point, energy, time, work;
  double largest = 0, touching = 0;
};

Seen hit(const Operator& plate, double mass_of_point, const Impactor& impactor, double step, std::size_t steps,
         bool held = false) {
  Constraints constraints;
  if (held) constraints.fix(dof(0, 0));
  constraints.fix(dof(0, 1)), constraints.fix(dof(0, 2));
  constraints.resolve();
  Forces mass = Forces::Zero(3, 1);
  mass(0, 0) = held ? 0 : mass_of_point;
  DynamicOptions options{step, steps, 1};
  options.impact = impactor, options.given = impactor.mass * impactor.velocity * impactor.velocity / 2;
  Seen result;
  central_differences(plate, constraints, mass, {}, options, [&](const Instant& now) {
    result.largest = now.contact_force->largest, result.touching = now.contact_force->touching;
    result.force.push_back(now.contact_force->force), result.velocity.push_back(now.contact_force->velocity);
    result.of_point.push_back(now.velocity()(0, 0)), result.time.push_back(now.time);
    result.energy.push_back(now.strain_energy + now.kinetic_energy), result.work.push_back(now.external_work);
  });
  return result;
}

}  // namespace

TEST_CASE("impact: two bodies part with the velocities of an elastic impact after half a period of the contact") {
  const Free plate;
  for (const double M : {0.2, 1.0, 50.0})
    for (const double v : {3.0, -3.0}) {
      const double m = 2, k = 800, reduced = m * M / (m + M), half = std::acos(-1) * std::sqrt(reduced / k);
      const auto seen = hit(plate, M, {{{dof(0, 0), 1.0}}, m, v, k}, half / 2000, 2600);
      CAPTURE(M, v);
      CHECK(seen.velocity.back() == Approx((m - M) / (m + M) * v).epsilon(1e-4).margin(1e-4));
      CHECK(seen.of_point.back() == Approx(2 * m / (m + M) * v).epsilon(1e-4));
      double most = 0, last = 0;
      for (std::size_t i = 0; i < seen.force.size(); ++i) {
        CHECK(m * seen.velocity[i] + M * seen.of_point[i] == Approx(m * v).epsilon(1e-12));  // momentum
        CHECK(seen.force[i] * v >= 0);                                                       // it does not pull
        CHECK(seen.energy[i] == Approx(seen.work[i]).epsilon(1e-5));
        most = std::max(most, std::abs(seen.force[i]));
        if (seen.force[i] != 0) last = seen.time[i];
      }
      CHECK(most == Approx(std::abs(v) * std::sqrt(k * reduced)).epsilon(1e-4));
      CHECK(last == Approx(half).epsilon(2e-3));
      CHECK(std::abs(seen.largest) == most);
      CHECK(seen.largest * v >= 0);
      CHECK(seen.touching == Approx(half).epsilon(2e-3));
    }
}

TEST_CASE("impact: what is held throws the mass back as it came") {
  const Free plate;
  const double m = 2, k = 800, half = std::acos(-1) * std::sqrt(m / k);
  const auto seen = hit(plate, 1, {{{dof(0, 0), 1.0}}, m, -5, k}, half / 2000, 2400, true);
  CHECK(seen.velocity.back() == Approx(5).epsilon(1e-5));
}

TEST_CASE("impact: the step is stable for the plate with the spring tied to it, and short for the contact") {
  Constraints constraints;
  constraints.fix(dof(0, 1)), constraints.fix(dof(0, 2));
  constraints.resolve();
  Forces mass = Forces::Zero(3, 1);
  mass(0, 0) = 0.5;  // of a chain of one: omega = 2
  for (const double k : {1e-3, 7.0, 1e9}) {
    const Impactor impactor{{{dof(0, 0), 1.0}}, 3, 1, k};
    Eigen::Matrix2d K, M;
    K << 2 + k, -k, -k, k;
    M << 0.5, 0, 0, 3;
    const double omega = std::sqrt((M.inverse() * K).eigenvalues().real().maxCoeff());
    const double step = stable_step(1, impactor, constraints, mass), contact = std::sqrt(k * (1.0 / 3 + 2));
    CHECK(step <= 2 / omega);
    CHECK(step == Approx(k < 1 ? 2 / omega : 0.1 / contact).epsilon(1e-3));
  }
}
