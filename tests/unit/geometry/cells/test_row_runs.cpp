#include "geometry/cells/lattice_cells.hpp"

#include <random>
#include <set>

#include "tests/catch.hpp"

using namespace geometry;

namespace {

std::set<long> places(const std::vector<Columns>& columns) {
  std::set<long> result;
  for (const auto& [from, to] : columns)
    for (long i = from; i < to; ++i) result.insert(i);
  return result;
}

/// Ascending, none empty, none that touches the next.
bool parted(const std::vector<Columns>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].first >= columns[i].second || (i > 0 && columns[i].first <= columns[i - 1].second)) return false;
  return true;
}

}  // namespace

TEST_CASE("columns of a row: what is in both, in either, in one alone, by their places") {
  std::mt19937 random(3);
  const auto some = [&] {
    std::vector<Columns> result;
    for (long at = 0; at < 40;) {
      const long from = at + 1 + long(random() % 4), to = from + 1 + long(random() % 5);
      result.emplace_back(from, to), at = to;
    }
    return result;
  };
  for (int i = 0; i < 200; ++i) {
    const auto one = some(), other = some();
    const auto a = places(one), b = places(other);
    std::set<long> both, either = a, alone;
    either.insert(b.begin(), b.end());
    for (const long x : a) (b.contains(x) ? both : alone).insert(x);
    CHECK(places(common(one, other)) == both);
    CHECK(places(joined(one, other)) == either);
    CHECK(places(without(one, other)) == alone);
    CHECK(parted(common(one, other)));
    CHECK(parted(joined(one, other)));
    CHECK(parted(without(one, other)));
  }
  CHECK(joined({{1, 4}, {2, 3}, {3, 6}, {8, 9}}, {}) == std::vector<Columns>{{1, 6}, {8, 9}});
}

TEST_CASE("runs of rows: every place has its number and every number its place, but for some") {
  RowRuns runs;
  runs.begin_row();
  runs.add({2, 5}), runs.add({5, 6}), runs.add({9, 11});
  runs.begin_row();
  runs.begin_row();
  runs.add({0, 0}), runs.add({3, 4});
  CHECK(runs.size() == 7);
  CHECK(runs.row(0).size() == 2);
  CHECK(runs.row(1).empty());
  CHECK(runs.row(3).empty());
  CHECK(runs.row(-1).empty());
  CHECK(runs.columns(0) == std::vector<Columns>{{2, 6}, {9, 11}});
  std::uint32_t count = 0;
  for (long j = -1; j < 4; ++j)
    for (long i = -1; i < 12; ++i)
      if (const auto number = runs.at(i, j)) {
        CHECK(*number == count++);
        CHECK(runs.place(*number) == std::pair(i, j));
      }
  CHECK(count == 7);
  const auto fewer = runs.except(std::vector<std::uint32_t>{0, 3, 4, 6});
  CHECK(fewer.size() == 3);
  CHECK(fewer.columns(0) == std::vector<Columns>{{3, 5}, {10, 11}});
  CHECK(fewer.at(10, 0) == 2u);
  CHECK(fewer.row(2).empty());
  CHECK(fewer.rows() == 3);
}

TEST_CASE("runs of rows: more places than numbers of 32 bits are refused") {
  RowRuns runs;
  runs.begin_row();
  runs.add({0, 2147483647});
  runs.begin_row();
  runs.add({0, 2147483647});
  CHECK(runs.size() == 4294967294U);
  runs.begin_row();
  CHECK_THROWS_AS(runs.add({0, 2}), std::length_error);
  runs.add({0, 1});
  CHECK(runs.at(0, 2) == 4294967294U);
}
