#include "plate/solve/motion/lanczos_space.hpp"

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/inertia.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/solve/motion/chain.hpp"

using namespace plate;

TEST_CASE(
    "Lanczos space: vectors orthonormal with the mass, the first the static answer, none of what is there already") {
  constexpr Eigen::Index points = 40;
  const spring_chain::Chain chain(points);
  const spring_chain::Inverse inverse(chain);
  Constraints constraints;
  for (std::uint32_t k = 0; k < points; ++k) constraints.fix(dof(k, 1)), constraints.fix(dof(k, 2));
  constraints.resolve();
  Forces mass = Forces::Zero(3, points), load = mass, other = mass;
  for (Eigen::Index i = 0; i < points; ++i)
    mass(0, i) = 1 + 0.1 * double(i % 7), load(0, i) = std::sin(0.3 * double(i)), other(0, i) = i == 11;
  const Inertia inertia(mass);
  LanczosSpace space(chain, constraints, inertia, inverse);
  CHECK(space.size() == 0);
  CHECK(space.add(load));
  const Eigen::VectorXd first = space.vectors().col(0);
  State state = Eigen::Map<const State>(first.data(), 3, points);
  Forces force;
  chain.internal_force(state, force);
  CHECK(force.cwiseProduct(load).sum() < 0);
  CHECK((force + load * (force.norm() / load.norm())).norm() < 1e-6 * force.norm());  // measured: 1e-16
  CHECK_FALSE(space.add(load));
  CHECK_FALSE(space.add(-3 * load));
  CHECK(space.size() == 1);
  CHECK(space.add(other));
  for (Eigen::Index i = 0; i < 8; ++i) CHECK(space.add_after(i));
  REQUIRE(space.size() == 10);
  const Eigen::MatrixXd V = space.vectors();
  Eigen::MatrixXd gram(10, 10), energy(10, 10);
  for (Eigen::Index i = 0; i < 10; ++i) {
    state = Eigen::Map<const State>(V.col(i).data(), 3, points);
    chain.internal_force(state, force);
    for (Eigen::Index j = 0; j < 10; ++j) {
      gram(j, i) = V.col(j).dot(flat(mass).cwiseProduct(V.col(i)));
      energy(j, i) = -V.col(j).dot(flat(force));
    }
  }
  CHECK((gram - Eigen::MatrixXd::Identity(10, 10)).cwiseAbs().maxCoeff() < 1e-12);  // measured: 1e-15
  CHECK((space.stiffness() - energy).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("Lanczos space: it ends with as many vectors as there are free degrees of freedom") {
  const spring_chain::Chain chain(4);
  const spring_chain::Inverse inverse(chain);
  Constraints constraints;
  for (std::uint32_t k = 0; k < 4; ++k) constraints.fix(dof(k, 1)), constraints.fix(dof(k, 2));
  constraints.resolve();
  Forces mass = Forces::Zero(3, 4), load = mass;
  mass.row(0).setOnes(), load(0, 0) = 1;
  const Inertia inertia(mass);
  LanczosSpace space(chain, constraints, inertia, inverse);
  CHECK_FALSE(space.add(Forces::Zero(3, 4)));
  CHECK(space.add(load));
  for (Eigen::Index i = 0; i < 3; ++i) CHECK(space.add_after(i));
  CHECK_FALSE(space.add_after(3));
  CHECK(space.size() == 4);
}
