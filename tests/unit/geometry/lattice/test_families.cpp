#include "geometry/lattice/families.hpp"

#include <omp.h>

#include <algorithm>
#include <set>

#include "geometry/lattice/cloud.hpp"
#include "tests/catch.hpp"

using namespace geometry;

namespace {

bool all(std::uint32_t, std::uint32_t) {
  return true;
}

/// Neighbours by distance, each pair of points compared.
std::vector<std::vector<std::uint32_t>> brute(const Cloud& cloud, double horizon) {
  std::vector<std::vector<std::uint32_t>> lists(cloud.size());
  for (std::uint32_t k = 0; k < cloud.size(); ++k)
    for (std::uint32_t j = 0; j < cloud.size(); ++j)
      if (k != j && (cloud.positions[j] - cloud.positions[k]).norm() <= horizon * (1 + 1e-7)) lists[k].push_back(j);
  return lists;
}

std::vector<std::vector<std::uint32_t>> lists_of(const Families& families) {
  std::vector<std::vector<std::uint32_t>> lists;
  for (std::size_t k = 0; k < families.points(); ++k) {
    lists.emplace_back();
    for (const auto& bond : families[k]) lists.back().push_back(bond.neighbour);
  }
  return lists;
}

bool equal(const Families& a, const Families& b) {
  if (a.points() != b.points() || a.vectors() != b.vectors() || lists_of(a) != lists_of(b)) return false;
  for (std::size_t k = 0; k < a.points(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i)
      if (a[k][i].vector_id != b[k][i].vector_id) return false;
  return true;
}

Cloud plate() {
  Outline outline = rectangle(0.2, -0.3, 1.5, 0.8);
  outline.holes.push_back(Circle{{0.8, 0.2}, 0.21, "hole"});
  return lattice(outline, 0.1);
}

}  // namespace

TEST_CASE("families: the same neighbours, ascending, as comparing all pairs") {
  const Cloud cloud = plate();
  const double ratio = GENERATE(1.0, 3.0, 3.015, 4.7);
  const Families found = families(cloud, ratio * 0.1, all);
  CHECK(found.points() == cloud.size());
  CHECK(found.bonds() > 300);
  CHECK(lists_of(found) == brute(cloud, ratio * 0.1));
}

TEST_CASE("families: bonds in both directions, each with its vector and the opposite") {
  const Cloud cloud = plate();
  const Families found = families(cloud, 0.3015, all);
  const auto lists = lists_of(found);
  REQUIRE(found.bonds() > 1000);
  for (std::uint32_t k = 0; k < found.points(); ++k)
    for (const auto& bond : found[k]) {
      const auto j = bond.neighbour;
      REQUIRE(std::binary_search(lists[j].begin(), lists[j].end(), k));
      const Point xi = cloud.positions[j] - cloud.positions[k];
      REQUIRE((found.vectors()[bond.vector_id] - xi).norm() < 1e-14);  // measured: 2e-16
    }
}

TEST_CASE("families: 28 bonds inside at horizon 3.015, 28 vectors in all") {
  const Cloud cloud = lattice(rectangle(0, 0, 10, 9), 1);
  const Families found = families(cloud, 3.015, all);
  CHECK(found.vectors().size() == 28);
  std::size_t interior = 0;
  for (std::size_t k = 0; k < found.points(); ++k) {
    const Point& x = cloud.positions[k];
    const auto bonds = found[k].size();
    const bool inside = x.x() > 3 && x.x() < 7 && x.y() > 3 && x.y() < 6;
    CHECK((bonds == 28) == inside);
    interior += inside;
  }
  CHECK(interior == 4 * 3);
  CHECK(found[0].size() == 10);  // a corner: 3 + 3 on the axes, 4 between
}

TEST_CASE("families: a bond as long as the horizon belongs to it, decimal spacing or not") {
  for (const double spacing : {0.1, 0.008, 1.0 / 3, 7.0}) {
    const Cloud cloud = lattice(rectangle(0, 0, 9 * spacing, 9 * spacing), spacing);
    const Families found = families(cloud, 3 * spacing, all);
    CHECK(found[40].size() == 28);
  }
}

TEST_CASE("families: pairs that do not see each other are left out, asked with the smaller index first") {
  const Cloud cloud = plate();
  std::size_t wrong = 0;
  const auto sees = [&](std::uint32_t k, std::uint32_t j) {
    if (k >= j) {
#pragma omp atomic
      ++wrong;
    }
    return (k + j) % 3 != 0;
  };
  auto expected = brute(cloud, 0.3015);
  std::size_t dropped = 0;
  for (std::uint32_t k = 0; k < expected.size(); ++k)
    dropped += std::erase_if(expected[k], [&](std::uint32_t j) { return (k + j) % 3 == 0; });
  CHECK(dropped > 100);
  CHECK(lists_of(families(cloud, 0.3015, sees)) == expected);
  CHECK(wrong == 0);
}

TEST_CASE("without: what is cut goes, the rest keeps its vectors") {
  const Cloud cloud = plate();
  const Families whole = families(cloud, 0.3015, all);
  const auto across = [&](std::uint32_t k, std::uint32_t j) {
    return (cloud.positions[k].x() < 0.9) != (cloud.positions[j].x() < 0.9);
  };
  const Families rest = without(whole, across);
  CHECK(rest.bonds() < whole.bonds());
  CHECK(lists_of(rest) ==
        lists_of(families(cloud, 0.3015, [&](std::uint32_t k, std::uint32_t j) { return !across(k, j); })));
  for (std::uint32_t k = 0; k < rest.points(); ++k)
    for (const auto& bond : rest[k])
      REQUIRE((rest.vectors()[bond.vector_id] - cloud.positions[bond.neighbour] + cloud.positions[k]).norm() <
              1e-14);  // measured: 2e-16
  const Families same = without(whole, [](std::uint32_t, std::uint32_t) { return false; });
  CHECK(equal(same, whole));
}

TEST_CASE("families: the same for any number of threads") {
  const Cloud cloud = plate();
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Families one = families(cloud, 0.3015, all);
  omp_set_num_threads(3);
  const Families three = families(cloud, 0.3015, all);
  omp_set_num_threads(before);
  CHECK(equal(one, three));
  CHECK(one.bytes() == three.bytes());
}

TEST_CASE("families: a single point has none") {
  const Families found = families(lattice(rectangle(0, 0, 1, 1), 1), 3, all);
  CHECK(found.points() == 1);
  CHECK(found.bonds() == 0);
}
