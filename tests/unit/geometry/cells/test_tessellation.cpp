#include <map>
#include <numbers>
#include <set>

#include "geometry/cells/tessellation.hpp"
#include "tests/catch.hpp"

using namespace geometry;

namespace {

struct Scene {
  Outline outline;
  std::vector<Polyline> cracks;
  double spacing;
  std::vector<Point> singles = {};
  Grading grading = {};
};

Tessellation cells_of(const Scene& scene) {
  return tessellation(scene.outline, crack_paths(scene.outline, scene.cracks, 1e-9), scene.spacing, scene.singles,
                      scene.grading);
}

Outline with_hole(const Hole& hole) {
  auto outline = rectangle(0, 0, 1.2, 1);
  outline.holes.push_back(hole);
  return outline;
}

const Outline plate = rectangle(-1, -1, 1, 1);
const Circle round_hole{{0.6, 0.5}, 0.2, "hole0"};
const Outline l_shape{{{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}}, {"a", "b", "c", "d", "e", "f"}}, {}};

/// Scenes of every kind, with what their cells must cover.
std::vector<Scene> scenes() {
  return {{plate, {}, 0.1},
          {plate, {{{-0.3, 0}, {0.3, 0}}}, 0.1},
          {plate, {{{-0.3, 0.03}, {0.3, 0.03}}}, 0.1},
          {plate, {{{-0.33, -0.2}, {0.31, 0.17}}}, 0.1},
          {plate, {{{-0.4, -0.4}, {0.4, 0.4}}}, 0.1},
          {plate, {{{-1, 0.04}, {0, 0.04}, {0.3, 0.37}}}, 0.1},
          {plate, {{{-0.5, 0}, {0.5, 0}}, {{0, -0.45}, {0, 0.45}}}, 0.1},
          {plate, {{{-0.5, 0}, {0.5, 0}}, {{0.1, 0}, {0.3, 0.4}}}, 0.1},
          {plate, {{{-1, -0.31}, {1, 0.52}}}, 0.1},
          {plate, {}, 0.13},
          {l_shape, {{{0.5, 0.5}, {0.2, 0.2}}}, 0.07},
          {with_hole(round_hole), {}, 0.1},
          {with_hole(round_hole), {{{0.8, 0.5}, {1.03, 0.5}}, {{0.4, 0.5}, {0.17, 0.44}}}, 0.07},
          {with_hole(Polygon{{{0.4, 0.3}, {0.7, 0.45}, {0.5, 0.7}}, {"hole0", "hole0", "hole0"}}), {}, 0.08},
          {with_hole(round_hole), {{{0.8, 0.5}, {1.0, 0.5}}}, 0.1, {}, {0.02, 0.05, 0.3}}};
}

double cell_area(const Tessellation& cells) {
  const auto area = [&](const auto& corners) {
    double twice = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point &a = cells.positions[corners[i]], &b = cells.positions[corners[(i + 1) % corners.size()]];
      twice += a.x() * b.y() - a.y() * b.x();
    }
    CHECK(twice > 0);
    return twice / 2;
  };
  double sum = 0;
  for (const auto& square : cells.squares) sum += area(square);
  for (const auto& triangle : cells.triangles) sum += area(triangle);
  return sum;
}

/// Area between a circle and the chords of its pieces.
double chord_area(const Tessellation& cells, const Circle& circle) {
  double polygon = 0;
  for (const auto& border : cells.borders)
    if (border.edge >= 0 && cells.names[std::size_t(border.edge)] == circle.name) {
      const Point a = cells.positions[border.from] - circle.centre, b = cells.positions[border.to] - circle.centre;
      polygon += std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
    }
  return std::numbers::pi * circle.radius * circle.radius - polygon;
}

std::size_t count(const Tessellation& cells, const std::string& name) {
  return std::size_t(std::count_if(cells.borders.begin(), cells.borders.end(), [&](const auto& border) {
    return border.edge == Curves::crack ? name == "crack" : cells.names[std::size_t(border.edge)] == name;
  }));
}

}  // namespace

TEST_CASE("cells fill the plate, each turning to the left") {
  for (const auto& scene : scenes()) {
    const auto cells = cells_of(scene);
    INFO("scene with " << cells.squares.size() << " squares, " << cells.triangles.size() << " triangles");
    double wanted = area(scene.outline);
    if (!scene.outline.holes.empty() && std::holds_alternative<Circle>(scene.outline.holes[0]))
      wanted += chord_area(cells, round_hole);
    CHECK(cell_area(cells) == Approx(wanted).epsilon(1e-12));  // measured: 2e-15
  }
}

TEST_CASE("the lattice has squares only, and a crack along it parts them") {
  const auto whole = cells_of({plate, {}, 0.1});
  CHECK(whole.squares.size() == 400);
  CHECK(whole.triangles.empty());
  CHECK(whole.positions.size() == 441);
  for (const char* edge : {"left", "right", "bottom", "top"}) CHECK(count(whole, edge) == 20);
  const auto cracked = cells_of({plate, {{{-0.3, 0}, {0.3, 0}}}, 0.1});
  CHECK(cracked.squares.size() == 400);
  CHECK(cracked.positions.size() == 441 + 5);  // six pieces, five points between the tips
  CHECK(count(cracked, "crack") == 12);
  const auto edge = cells_of({plate, {{{-1, 0}, {0.3, 0}}}, 0.1});
  CHECK(edge.positions.size() == 441 + 13);  // the mouth too
  CHECK(count(edge, "left") == 20);
}

TEST_CASE("every face of a crack lies on it, once to either side") {
  for (const auto& scene : scenes()) {
    const auto cells = cells_of(scene);
    std::map<std::pair<std::pair<double, double>, std::pair<double, double>>, int> sides;
    double length = 0, cracks = 0;
    for (const auto& border : cells.borders) {
      if (border.edge != Curves::crack) continue;
      const Point &a = cells.positions[border.from], &b = cells.positions[border.to];
      ++sides[{{a.x(), a.y()}, {b.x(), b.y()}}];
      length += (b - a).norm();
      double nearest = 1;
      for (const auto& crack : scene.cracks)
        nearest = std::min({nearest, std::max(distance(crack, a), distance(crack, b))});
      CHECK(nearest < 1e-12 * scene.spacing);  // measured: 1e-15
    }
    for (const auto& [side, times] : sides) {
      CHECK(times == 1);
      CHECK(sides.count({side.second, side.first}) == 1);
    }
    for (const auto& crack : scene.cracks)
      for (std::size_t i = 0; i + 1 < crack.size(); ++i) cracks += (crack[i + 1] - crack[i]).norm();
    CHECK(length == Approx(2 * cracks).margin(1e-12));  // measured: 2e-15
  }
}

TEST_CASE("a tip is one point, a place on a crack has two, a crossing four, a place asked for has one") {
  const auto at = [](const Tessellation& cells, const Point& x) {
    return std::count_if(cells.positions.begin(), cells.positions.end(),
                         [&](const Point& p) { return (p - x).norm() < 1e-6; });
  };
  const auto crossing = cells_of({plate, {{{-0.5, 0}, {0.5, 0}}, {{0, -0.45}, {0, 0.45}}}, 0.1});
  CHECK(at(crossing, {0.5, 0}) == 1);
  CHECK(at(crossing, {0, 0.45}) == 1);
  CHECK(at(crossing, {0.1, 0}) == 2);
  CHECK(at(crossing, {0, 0}) == 4);
  const auto junction = cells_of({plate, {{{-0.5, 0}, {0.5, 0}}, {{0.13, 0}, {0.3, 0.4}}}, 0.1});
  CHECK(at(junction, {0.13, 0}) == 3);
  CHECK(at(cells_of({plate, {}, 0.1, {{0.234, 0.345}}}), {0.234, 0.345}) == 1);
  const auto cut = cells_of({plate, {{{-1, -0.31}, {1, 0.52}}}, 0.1});
  CHECK(at(cut, {-1, -0.31}) == 2);
  CHECK(at(cut, {1, 0.52}) == 2);
}

TEST_CASE("points keep their distance from each other") {
  for (const auto& scene : scenes()) {
    const bool graded = scene.grading.at_tips.has_value();
    const auto cells = cells_of(scene);
    const auto families = cell_families(cells);
    double nearest = 10;
    for (const auto& x : families.vectors()) nearest = std::min(nearest, x.norm());
    const double wanted = graded ? *scene.grading.at_tips : scene.spacing;
    INFO("scene with " << cells.squares.size() << " squares, " << cells.triangles.size() << " triangles");
    CHECK(nearest > 0.45 * wanted);  // measured: 0.5
  }
}

TEST_CASE("a grading puts points close together at tips and holes") {
  const auto cells = cells_of(scenes().back());
  CHECK(cells.squares.empty());
  const auto families = cell_families(cells);
  for (std::size_t k = 0; k < cells.positions.size(); ++k) {
    double sum = 0;
    for (const auto& bond : families[k]) sum += families.vectors()[bond.vector_id].norm() / double(families[k].size());
    const Point& x = cells.positions[k];
    const double from_tip = (x - Point(1, 0.5)).norm(), from_hole = (x - round_hole.centre).norm() - round_hole.radius;
    const double wanted = std::min({0.1, 0.02 + 0.3 * from_tip, 0.05 + 0.3 * from_hole});
    CHECK(sum > 0.4 * wanted);
    CHECK(sum < 1.7 * wanted);
  }
}

TEST_CASE("points on the faces of a crack are seen on their side") {
  const auto cells = cells_of({plate, {{{-0.3, 0}, {0.3, 0}}}, 0.1});
  const auto seen = positions_inside_faces(cells);
  for (const auto& square : cells.squares) {
    const Point middle = (cells.positions[square[0]] + cells.positions[square[2]]) / 2;
    for (const auto k : square) {
      const bool face = std::abs(cells.positions[k].y()) < 1e-9 && std::abs(cells.positions[k].x()) < 0.29;
      CHECK((seen[k] - cells.positions[k]).norm() == Approx(face ? 2e-7 : 0).margin(1e-15));
      if (face) CHECK(seen[k].y() * middle.y() > 0);
    }
  }
}
