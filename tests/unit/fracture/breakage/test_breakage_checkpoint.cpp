#include "fracture/breakage/breakage_checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <random>
#include <sstream>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/archive.hpp"
#include "plate/solve/gathered_archives.hpp"
#include "tests/catch.hpp"
#include "tests/unit/fracture/breakage/damaged_plate.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace fracture;

namespace {

plate::Problem problem() {
  plate::Problem result;
  result.outline = geometry::rectangle(0, 0, 0.6, 0.5);
  result.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  result.supports = {{plate::SupportKind::clamped, {"left", "top"}, {}},
                     {plate::SupportKind::simply_supported_hard, {"bottom"}, {}}};
  result.loads = {plate::Load{}};
  result.discretization.spacing = 0.01;
  result.discretization.formulation = &plate::ordinary;
  return result;
}

}  // namespace

TEST_CASE("point keys: every point has one of its own, fictitious ones too, the same in all processes") {
  std::map<PointKey, std::array<double, 2>> all;  // places of own points
  std::mutex one_by_one;
  const auto take = [&](const plate::Communicator& communicator) {
    const auto plate = plate::discretise(problem(), communicator).plate;
    const auto& boundary = plate->boundary();
    const PointKeys keys(boundary);
    const std::lock_guard guard(one_by_one);
    for (std::uint32_t k = 0; k < boundary.cloud.size(); ++k) {
      const auto key = keys.of(k);
      CHECK(keys.point(key) == k);
      const auto& x = boundary.cloud.positions[k];
      const auto [known, fresh] = all.try_emplace(key, std::array{x.x(), x.y()});
      if (!fresh) CHECK((known->second == std::array{x.x(), x.y()}));
    }
    CHECK_FALSE(keys.point({1000, 3, 0}));
    CHECK_FALSE(keys.point({1000, 3, 1}));
  };
  take(plate::single_process());
  const auto points = all.size();
  CHECK(points > 60 * 50 + 2 * 3 * 50);  // with those beyond held edges
  thread_ranks::run(3, take);
  CHECK(all.size() == points);
}

TEST_CASE("severed families of all processes come to each of them") {
  thread_ranks::run(3, [](const plate::Communicator& ranks) {
    const auto number = std::uint64_t(ranks.rank());
    DamagedFamily own{{ranks.rank(), 7, 0}, number, 2, 1.5, 3, number, {1, 0}, {1, 2, 3, 4, 5, 6}};
    const auto all = plate::gathered_archives(ranks, std::vector<DamagedFamily>(number, own));
    if (all.size() != 3) throw std::runtime_error("not all families");
    if (all.back().point != PointKey{2, 7, 0} || all.back().weights.size() != 6 || all.back().breakage != 2)
      throw std::runtime_error("not as they were");
  });
  CHECK(plate::gathered_archives(plate::single_process(), std::vector<DamagedFamily>(2)).size() == 2);
}

TEST_CASE("a restored plate breaks its bonds with the same energies to the last bit, whatever broke before") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    broken_plate::Plate one({verified_plate::held_all_round(plate::SupportKind::clamped)}), other(one.content.supports);
    const auto points = std::uint32_t(one.whole->cloud().plate_points);
    auto state = verified_plate::random_state(*one.whole, seed),
         velocity = verified_plate::random_state(*one.whole, seed + 100);
    for (auto* field : {&state, &velocity})  // energies of many sizes, whose sums are rounded
      for (Eigen::Index k = 0; k < field->cols(); ++k) field->col(k) *= std::exp(-0.1 * double(k));
    const auto breaks = [&](std::size_t count) {  // the same points lose bonds early and late
      std::vector<PointPair> bonds;
      while (bonds.size() < count) {
        const auto k = std::uint32_t(random() % points);
        const auto& family = one.whole->families()[k];
        const auto i = random() % family.size();
        const auto j = family[i].neighbour;
        const PointPair bond{std::min(k, j), std::max(k, j)};
        if (j >= points || one.damaged.broken().broken(k, i) || std::ranges::count(bonds, bond)) continue;
        bonds.push_back(bond);
      }
      return bonds;
    };
    const Motion motion{state, velocity, 0.01};
    for (int event = 0; event < 12; ++event) {
      one.damaged.break_bonds(breaks(20), 4);
      for (int step = 0; step < (event < 9 ? 4 : 1); ++step) one.damaged.carry_on_all(motion);
    }
    std::ostringstream text;
    {
      plate::OutArchive archive(text);
      one.damaged.save(archive);
    }
    std::istringstream in(text.str());
    plate::InArchive archive(in);
    other.damaged.load(archive);
    const auto next = breaks(5);
    one.damaged.break_bonds(next, 4), other.damaged.break_bonds(next, 4);
    while (one.damaged.easing()) CHECK(one.damaged.carry_on_all(motion) == other.damaged.carry_on_all(motion));
    CHECK_FALSE(other.damaged.easing());
    plate::Forces force, again;
    one.damaged.internal_force(state, force), other.damaged.internal_force(state, again);
    CHECK((force.array() == again.array()).all());
  }
}
