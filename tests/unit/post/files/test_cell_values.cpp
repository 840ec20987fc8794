#include "post/files/checkpoints.hpp"

#include <fstream>
#include <map>

#include "post/files/atomic_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using namespace post;

namespace {

/// 120 x 700 points: more than are read at once.
CellValues some() {
  CellValues result{3, {}, {}};
  for (long row = -3; row < 697; ++row)
    for (long column = 40; column < 160; ++column) {
      result.cells.push_back({column, row});
      for (int c = 0; c < 3; ++c) result.values.push_back(1.0 / double(1 + column + 1000 * (row + 3) + c));
    }
  return result;
}

}  // namespace

TEST_CASE("values by cells: all come back, bit for bit, and none where a file has none that are wanted") {
  const small_run::TemporaryFolder folder;
  const auto path = folder / "points";
  const auto values = some();
  const auto sum = write_cells(path, values);
  CHECK(sum.size() == 16);
  CHECK(checksum_of(path) == sum);
  std::size_t k = 0;
  bool same = true;
  const auto width = read_cells(path, {{159, 696}, {200, 700}}, [&](const geometry::Cell& cell, auto found) {
    same = same && cell == values.cells[k] && std::ranges::equal(found, std::span(values.values).subspan(3 * k, 3));
    ++k;
  });
  CHECK(width == 3);
  CHECK(k == values.cells.size());
  CHECK(same);
  for (const geometry::CellBox& beside :
       {geometry::CellBox{{160, 0}, {170, 9}}, geometry::CellBox{{50, -9}, {60, -3}}, geometry::CellBox{}})
    CHECK(read_cells(path, beside, [](const geometry::Cell&, auto) { FAIL("is not wanted"); }) == 3);
}

TEST_CASE("values by cells: a file that is damaged, cut short or another is known") {
  const small_run::TemporaryFolder folder;
  const auto path = folder / "points";
  const auto sum = write_cells(path, some());
  const auto whole = read_text(path);
  const auto nothing = [](const geometry::Cell&, auto) {};
  const geometry::CellBox all{{-1000, -1000}, {1000, 1000}};
  auto text = whole;
  text[whole.size() / 2] ^= 1;
  std::ofstream(path, std::ios::binary) << text;
  CHECK(checksum_of(path) != sum);
  std::ofstream(path, std::ios::binary) << whole.substr(0, whole.size() - 1);
  CHECK(checksum_of(path) != sum);
  CHECK_THROWS_WITH(read_cells(path, all, nothing), Catch::Contains("not whole"));
  std::ofstream(path, std::ios::binary) << "something else that is long enough to be a header of points, or not";
  CHECK_THROWS_WITH(read_cells(path, all, nothing), Catch::Contains("does not hold points"));
  CHECK(checksum_of(folder / "none").empty());
}
