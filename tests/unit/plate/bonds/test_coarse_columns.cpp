#include "plate/bonds/preconditioners.hpp"

#include <map>
#include <mutex>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("coarse columns: found for many coarse points at once they are those of one at a time") {
  Problem problem;
  problem.outline = geometry::rectangle(0, 0, 0.22, 0.16);
  problem.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  problem.supports = {{SupportKind::clamped, {"left"}, {}}, {SupportKind::symmetry, {"top"}, {}}};
  problem.loads = {Load{}};
  problem.cracks = {{{0.07, 0.061}, {0.149, 0.102}}};
  problem.discretization.spacing = 0.01;
  problem.discretization.horizon_ratio = 1.5;  // as the plate that two levels are made of
  problem.discretization.formulation = &ordinary;
  const auto plate = discretise(problem).plate;
  const Transfer transfer(plate->families(), plate->boundary());
  const auto points = std::uint32_t(transfer.coarse_points());
  std::map<std::array<std::uint32_t, 2>, Eigen::Matrix3d> found;
  std::mutex one_by_one;
  for_each_coarse_column(*plate, transfer, plate->constraints(), CoarseCells(transfer.cells()),
                         [&](std::uint32_t i, std::uint32_t j, int component, const Eigen::Vector3d& K_ij) {
                           const std::lock_guard guard(one_by_one);
                           found.try_emplace({i, j}, Eigen::Matrix3d::Zero()).first->second.col(component) = K_ij;
                         });
  double largest = 0, apart = 0;
  State coarse(3, Eigen::Index(points)), fine(3, Eigen::Index(plate->points()));
  Forces force;
  for (std::uint32_t j = 0; j < points; ++j)
    for (int component = 0; component < 3; ++component) {
      coarse.setZero(), fine.setZero();
      coarse(component, j) = 1;
      transfer.prolong(coarse, fine);
      plate->constraints().impose(fine);
      plate->internal_force(fine, force);
      plate->constraints().fold(force);
      transfer.restrict_to(coarse, force);
      for (std::uint32_t i = 0; i < points; ++i) {
        const auto entry = found.find({i, j});
        const Eigen::Vector3d K = entry == found.end() ? Eigen::Vector3d(0, 0, 0) : entry->second.col(component);
        largest = std::max(largest, coarse.col(i).cwiseAbs().maxCoeff());
        apart = std::max(apart, (K + coarse.col(i)).cwiseAbs().maxCoeff());
      }
    }
  CHECK(largest > 0);
  CHECK(apart < 1e-13 * largest);  // measured: 0
}
