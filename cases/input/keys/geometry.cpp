#include "cases/input/keys.hpp"
#include "plate/model/problem.hpp"

namespace cases {
namespace {

using geometry::Circle;
using geometry::Hole;
using geometry::Outline;
using geometry::Point;
using geometry::Polygon;

/// The corners of an outline that was given as a rectangle; absent for any other.
std::optional<std::pair<Point, Point>> corners(const Outline& outline) {
  const auto& outer = outline.outer;
  if (outer.vertices.size() != 4) return std::nullopt;
  const Point low = outer.vertices[0].cwiseMin(outer.vertices[2]), high = outer.vertices[0].cwiseMax(outer.vertices[2]);
  const Polygon same = geometry::rectangle(low.x(), low.y(), high.x(), high.y()).outer;
  if (same.vertices != outer.vertices || same.edge_names != outer.edge_names) return std::nullopt;
  return std::pair(low, high);
}

void read_rectangle(const Value& given, Outline& outline) {
  const auto x = given.numbers(4, "[xmin, ymin, xmax, ymax]");
  if (!x) return;
  if (!((*x)[0] < (*x)[2] && (*x)[1] < (*x)[3]))
    return given.refuse("[xmin, ymin, xmax, ymax] with xmin < xmax and ymin < ymax");
  outline.outer = geometry::rectangle((*x)[0], (*x)[1], (*x)[2], (*x)[3]).outer;
}

std::string rectangle_text(const Outline& outline) {
  const auto found = corners(outline);
  if (!found) return "";
  const auto& [low, high] = *found;
  return fmt::format("[{}, {}, {}, {}]", number_text(low.x()), number_text(low.y()), number_text(high.x()),
                     number_text(high.y()));
}

void read_polygon(const Value& given, Polygon& polygon) {
  const auto points = given.points();
  if (!points) return;
  if (points->size() < 3) return given.refuse("a list of at least three points");
  polygon.vertices = *points;
  polygon.edge_names.clear();
  for (std::size_t i = 0; i < points->size(); ++i) polygon.edge_names.push_back(fmt::format("edge{}", i));
}

void read_edges(const Value& given, Outline& outline) {
  if (corners(outline)) return given.complain("is used with a polygon only: a rectangle has left, right, bottom, top");
  const auto names = given.texts();
  if (!names) return;
  const std::size_t size = outline.outer.vertices.size();
  for (const auto& name : *names)
    if (name.empty() || name.starts_with("hole"))
      return given.complain(fmt::format("\"{}\" given, must not be empty nor begin with 'hole'", name));
  if (size > 0 && names->size() != size)
    return given.complain(
        fmt::format("{} names given, must be one for each of the {} edges of the outline", names->size(), size));
  outline.outer.edge_names = *names;
}

void check_outline(const Value& given, Outline&) {
  const auto& reading = given.reading();
  const bool rectangle = reading.given(given.below("rectangle")), polygon = reading.given(given.below("polygon"));
  if (rectangle == polygon)
    given.refuse("either { rectangle = [xmin, ymin, xmax, ymax] } or { polygon = [[x, y], ...] }");
}

Fields<Outline> outline_fields() {
  return {
      value<Outline>({"rectangle", "length", "[xmin, ymin, xmax, ymax]", "this or polygon",
                      "rectangle with the edges left, right, bottom, top"},
                     read_rectangle, rectangle_text),
      value<Outline>(
          {"polygon", "length", "[[x, y], ...], counter-clockwise", "", "polygon instead of the rectangle"},
          [](const Value& given, Outline& outline) { read_polygon(given, outline.outer); },
          [](const Outline& outline) {
            return outline.outer.vertices.empty() || corners(outline) ? "" : text_of(outline.outer.vertices);
          }),
      value<Outline>({"edges", "-", "one name per edge", "edge0, edge1, ...",
                      "names of the polygon's edges, the first from vertex 0 to 1"},
                     read_edges,
                     [](const Outline& outline) {
                       return outline.outer.vertices.empty() || corners(outline) ? ""
                                                                                 : text_of(outline.outer.edge_names);
                     }),
  };
}

void read_cracks(const Value& given, plate::Problem& content) {
  const auto cracks = given.elements("a list of polylines [ [[x, y], [x, y]], ... ]");
  if (!cracks) return;
  for (const auto& crack : *cracks)
    if (const auto points = crack.points()) content.cracks.push_back(*points);
}

std::string cracks_text(const plate::Problem& content) {
  std::vector<std::string> texts;
  for (const auto& crack : content.cracks) texts.push_back(text_of(crack));
  return texts.empty() ? "" : fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

Fields<Hole> hole_fields(const std::string& round, const std::string& polygonal) {
  return {
      value<Hole>(
          {"circle", "length", "[x, y, radius]", "", round},
          [](const Value& given, Hole& hole) {
            if (const auto x = given.numbers(3, "[x, y, radius]")) hole = Circle{{(*x)[0], (*x)[1]}, (*x)[2], ""};
          },
          [](const Hole& hole) -> std::string {
            const auto* circle = std::get_if<Circle>(&hole);
            return !circle ? ""
                           : fmt::format("[{}, {}, {}]", number_text(circle->centre.x()),
                                         number_text(circle->centre.y()), number_text(circle->radius));
          }),
      value<Hole>(
          {"polygon", "length", "[[x, y], ...]", "", polygonal},
          [](const Value& given, Hole& hole) { read_polygon(given, hole.emplace<Polygon>()); },
          [](const Hole& hole) -> std::string {
            const auto* polygon = std::get_if<Polygon>(&hole);
            return polygon && !polygon->vertices.empty() ? text_of(polygon->vertices) : "";
          }),
  };
}

void check_hole(const Value& given, Hole&) {
  const auto& reading = given.reading();
  if (reading.given(given.below("circle")) == reading.given(given.below("polygon")))
    given.refuse("either { circle = [x, y, radius] } or { polygon = [[x, y], ...] }");
}

Fields<plate::Problem> geometry_fields() {
  using P = plate::Problem;
  auto outline = table<P, Outline>("outline", Layout::inline_, &P::outline, outline_fields(), check_outline);
  outline.needed = any_kind;
  const auto holes = [](auto& content) -> auto& {
    return content.outline.holes;
  };
  return {
      std::move(outline),
      tables<P, Hole>("holes", Layout::inline_, holes,
                      hole_fields("round hole; the holes are the edges hole0, hole1, ...",
                                  "polygonal hole; all its edges are one, hole0, hole1, ..."),
                      check_hole),
      value<P>(
          {"cracks", "length", "[ [[x, y], [x, y], ...], ... ]", "",
           "polylines; an end inside the plate is a tip, one on an edge or hole a mouth, one on a crack a junction"},
          read_cracks, cracks_text),
  };
}

void name_holes(const Value&, plate::Problem& content) {
  for (std::size_t i = 0; i < content.outline.holes.size(); ++i) {
    const std::string name = fmt::format("hole{}", i);
    if (auto* circle = std::get_if<Circle>(&content.outline.holes[i]))
      circle->name = name;
    else
      for (auto& edge : std::get<Polygon>(content.outline.holes[i]).edge_names) edge = name;
  }
}

}  // namespace cases
