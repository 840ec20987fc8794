#include "fracture/growth/distributed_growth.hpp"

#include <map>
#include <mutex>

#include "plate/bonds/part_of_lattice.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "tests/catch.hpp"
#include "tests/unit/fracture/distributed_run.hpp"

TEST_CASE("shared points: a number is a place, and ascends as points do") {
  const plate::Problem problem = shared_run::tall_plate().content;
  std::map<std::uint32_t, int> owners;
  std::size_t points = 0;
  thread_ranks::run(5, [&](const plate::Communicator& all) {
    const auto plate = plate::discretise(problem, all).plate;
    const auto& boundary = plate->boundary();
    const fracture::PointNumbers numbers(boundary);
    const auto seen = fracture::overlap_of_growth(*plate, false);
    static std::mutex one_by_one;
    const std::lock_guard guard(one_by_one);
    for (std::uint32_t k = 0; k < plate->cloud().plate_points; ++k) {
      const auto number = numbers.of(k);
      if (numbers.point(number) != k || numbers.place(number) != boundary.lattice[k]) FAIL("point " << k);
      if (k > 0 && number <= numbers.of(k - 1)) FAIL("point " << k);
      if (boundary.owns(k)) ++owners[number];
      if (boundary.owns(k) && !seen->known[k]) FAIL("point " << k << " is not known to its owner");
    }
    points = std::max(points, std::size_t(owners.size()));
  });
  CHECK(points == 50 * 80);
  CHECK(std::ranges::all_of(owners, [](const auto& one) { return one.second == 1; }));
  const auto whole = plate::discretise(problem).plate;
  const fracture::PointNumbers own(whole->boundary());
  CHECK(own.of(17) == 17);
  CHECK(own.point(17) == 17U);
  CHECK(own.place(17) == whole->boundary().lattice[17]);
  CHECK_FALSE(fracture::overlap_of_growth(*whole, true));
}
