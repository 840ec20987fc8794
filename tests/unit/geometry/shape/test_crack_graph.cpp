// Cracks as sides of the lattice's cells, followed from tip to tip.
#include "geometry/shape/crack_graph.hpp"

#include <random>
#include <set>
#include <tuple>

#include "tests/catch.hpp"

using namespace geometry;

namespace {

/// A plate of 20 x 20 cells.
bool inside(const CrackGraph::Corner& corner) {
  return corner[0] > 0 && corner[0] < 20 && corner[1] > 0 && corner[1] < 20;
}

/// Parts all neighbours that a straight crack severs.
void cut(CrackGraph& graph, const Point& from, const Point& to, double time) {
  const CrackPath path{{from, to}, End::tip, End::tip};
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y) {
      const Point p(x + 0.5, y + 0.5);
      for (const auto& q : {Point(p + Point(1, 0)), Point(p + Point(0, 1))})
        if (q.x() < 20 && q.y() < 20 && separates(path, p, q)) graph.part(p, q, time);
    }
}

std::size_t count(const std::vector<GraphLine>& lines, End kind) {
  std::size_t sum = 0;
  for (const auto& line : lines) sum += (line.front == kind) + (line.back == kind);
  return sum;
}

}  // namespace

TEST_CASE("crack graph: a crack along the lattice is one line between its tips, with the times of its ends") {
  CrackGraph graph;
  cut(graph, {5.2, 10}, {9.2, 10}, 1);
  cut(graph, {9.2, 10}, {12.2, 10}, 2);
  const auto lines = graph.lines(inside);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].vertices == Polyline{{5, 10}, {12, 10}});
  CHECK(lines[0].times == std::vector<double>{1, 2});
  CHECK(lines[0].length == Approx(7));
  CHECK(count(lines, End::tip) == 2);
}

TEST_CASE("crack graph: a straight crack under any angle stays straight, within two spacings of its length") {
  for (const double degrees : {10.0, 15.0, 30.0, 45.0, 60.0, 80.0}) {
    CrackGraph graph;
    const Point along{std::cos(degrees * 3.14159265358979 / 180), std::sin(degrees * 3.14159265358979 / 180)};
    cut(graph, Point(3.3, 2.2), Point(3.3, 2.2) + 15 * along, 0);
    const auto lines = graph.lines(inside);
    CAPTURE(degrees);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].vertices.size() == 2);
    CHECK(lines[0].length == Approx(15).margin(2));
  }
}

TEST_CASE("crack graph: a branch is three lines that meet in a junction, a crack from an edge has a mouth") {
  CrackGraph graph;
  cut(graph, {-1, 10}, {10, 10}, 0);
  cut(graph, {10, 10}, {16, 16}, 0);
  cut(graph, {10, 10}, {16, 4}, 0);
  const auto lines = graph.lines(inside);
  CHECK(lines.size() == 3);
  CHECK(count(lines, End::tip) == 2);
  CHECK(count(lines, End::mouth) == 1);
  CHECK(count(lines, End::junction) == 3);
}

TEST_CASE("crack graph: short spurs and single sides are no cracks, a closed crack has no tip") {
  CrackGraph graph;
  cut(graph, {5, 10}, {15, 10}, 0);
  graph.part({9.5, 10.5}, {10.5, 10.5}, 1);  // one side up from (10, 10)
  graph.part({3.5, 3.5}, {4.5, 3.5}, 1);
  CHECK(graph.lines(inside).size() == 1);
  CHECK(graph.lines(inside, 1).size() == 4);

  CrackGraph closed;
  for (const auto& [from, to] : {std::pair{Point(5.5, 4.5), Point(5.5, 5.5)},
                                 {Point(5.5, 6.5), Point(5.5, 5.5)},
                                 {Point(4.5, 5.5), Point(5.5, 5.5)},
                                 {Point(6.5, 5.5), Point(5.5, 5.5)}})
    closed.part(from, to, 0);
  const auto lines = closed.lines(inside);
  REQUIRE(lines.size() == 1);
  CHECK(count(lines, End::tip) == 0);
  CHECK(lines[0].vertices.size() == 5);  // all corners: none is before the others
  CHECK(lines[0].length == Approx(4));
}

TEST_CASE("crack graph: sides that follow each other are one run, and parting twice counts once") {
  CrackGraph graph;
  for (const double x : {0.5, 1.5, 2.5, 5.5}) CHECK(graph.part({x, 0.5}, {x, 1.5}, 1));
  for (const double y : {1.5, 2.5}) CHECK(graph.part({2.5, y}, {3.5, y}, 2));
  CHECK_FALSE(graph.part({1.5, 0.5}, {1.5, 1.5}, 3));
  const auto runs = graph.runs();
  REQUIRE(runs.size() == 3);
  CHECK(runs[0] == CrackGraph::Side{{0, 1}, {3, 1}});
  CHECK(runs[1] == CrackGraph::Side{{3, 1}, {3, 3}});
  CHECK(runs[2] == CrackGraph::Side{{5, 1}, {6, 1}});
}

namespace {

/// Lines of a graph as sets of vertices with their times, mapped by one of the eight symmetries of the lattice's plate;
/// so is each line, from whichever end it runs.
std::multiset<std::multiset<std::array<double, 3>>> mapped(const CrackGraph& graph, int symmetry) {
  std::multiset<std::multiset<std::array<double, 3>>> result;
  for (const auto& line : graph.lines(inside)) {
    std::multiset<std::array<double, 3>> vertices;
    const bool closed = line.vertices.front() == line.vertices.back();
    for (std::size_t i = closed; i < line.vertices.size(); ++i) {
      double x = line.vertices[i].x(), y = line.vertices[i].y();
      if (symmetry & 1) x = 20 - x;
      if (symmetry & 2) y = 20 - y;
      if (symmetry & 4) std::swap(x, y);
      vertices.insert({x, y, line.times[i]});
    }
    result.insert(vertices);
  }
  return result;
}

}  // namespace

TEST_CASE("crack graph: the lines of a mirrored or turned graph are mirrored or turned") {
  std::mt19937 random(7);
  std::size_t lines = 0, bends = 0;
  for (int trial = 0; trial < 200; ++trial) {
    // random walks over the sides, which branch, close and leave spurs, and single sides
    std::vector<std::tuple<Point, Point, double>> parted;
    const int walks = 1 + int(random() % 4);
    for (int walk = 0; walk < walks; ++walk) {
      Point at(2 + double(random() % 17), 2 + double(random() % 17));
      const int bias = int(random() % 4);
      for (int step = 0; step < 40; ++step) {
        const int way = random() % 2 ? bias : int(random() % 4);
        const Point along = way % 2 ? Point(0, way - 2) : Point(way - 1, 0), across(-along.y() / 2, along.x() / 2);
        const Point to = at + along, middle = (at + to) / 2;
        if (to.minCoeff() < 0 || to.maxCoeff() > 20 || middle.minCoeff() <= 0 || middle.maxCoeff() >= 20) break;
        parted.emplace_back(middle - across, middle + across, double(random() % 5));
        at = to;
      }
    }
    CrackGraph graph;
    for (const auto& [p, q, time] : parted) graph.part(p, q, time);
    const auto expected = graph.lines(inside);
    lines += expected.size();
    for (const auto& line : expected) bends += line.vertices.size() - 2;
    for (int symmetry = 0; symmetry < 8; ++symmetry) {
      const auto map = [&](Point x) {
        if (symmetry & 1) x.x() = 20 - x.x();
        if (symmetry & 2) x.y() = 20 - x.y();
        if (symmetry & 4) std::swap(x.x(), x.y());
        return x;
      };
      CrackGraph other;
      for (const auto& [p, q, time] : parted) other.part(map(p), map(q), time);
      CAPTURE(trial, symmetry);
      REQUIRE(mapped(graph, symmetry) == mapped(other, 0));
    }
  }
  CHECK(lines > 500);
  CHECK(bends > 100);
}
