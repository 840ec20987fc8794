#include "plate/galerkin/multigrid.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace plate;

TEST_CASE("sums by owners: what all have of a point comes to its owner, and copies are left without") {
  for (const int processes : {1, 2, 5})
    thread_ranks::run(processes, [&](const Communicator& all) {
      const int next = (all.rank() + 1) % all.size();
      // point 0 is a copy of point 1 of the next process, point 2 of point 1 of the first
      std::vector<Copy> copies;
      if (processes > 1) copies.push_back({0, next, 1});
      if (all.rank() > 0) copies.push_back({2, 0, 1});
      const SumByOwners sum(all, copies);
      Forces forces(3, 4);
      for (Eigen::Index k = 0; k < 4; ++k) forces.col(k).setConstant(double(10 * all.rank() + k + 1));
      forces(1, 0) = 0.5;
      const Forces before = forces;
      sum.add(forces);
      Eigen::Vector3d wanted = before.col(1);
      const int last = (all.rank() + all.size() - 1) % all.size();
      if (processes > 1) wanted += Eigen::Vector3d(10 * last + 1, 0.5, 10 * last + 1);
      for (int other = 1; all.rank() == 0 && other < all.size(); ++other) wanted.array() += 10 * other + 3;
      if ((forces.col(1) - wanted).norm() > 1e-12) throw std::runtime_error("not the sum");
      if (forces.col(3) != before.col(3)) throw std::runtime_error("a point of nobody else has changed");
      for (const auto& copy : copies)
        if (!forces.col(copy.point).isZero(0)) throw std::runtime_error("a copy has kept something");
    });
}
