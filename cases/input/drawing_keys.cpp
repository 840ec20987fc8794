#include "cases/input/drawing.hpp"

#include <set>

#include "cases/input/keys.hpp"
#include "plate/model/problem.hpp"

namespace cases {
namespace {

using geometry::Point;

/// Keys of a drawing.
struct DrawingKeys {
  std::string file;
  std::optional<double> scale, join;
  Point origin{0, 0};
  DrawingLayers layers;
};

Fields<DrawingKeys> drawing_fields() {
  using D = DrawingKeys;
  const auto none = [](const D&) { return std::string(); };
  const auto layer = [=](const char* name, std::string DrawingLayers::*member, const char* help) {
    return value<D>(
        {name, "-", "name of a layer", fmt::format("\"{}\"", name), help},
        [=](const Value& given, D& keys) {
          if (const auto text = given.text()) keys.layers.*member = *text;
        },
        none);
  };
  return {
      value<D>(
          {"file", "-", "a DXF file", "required", "a drawing of the plate, sought beside the case"},
          [](const Value& given, D& keys) { keys.file = given.text().value_or(""); }, none)
          .required(),
      number<D>("scale", "length", &D::scale, positive, "length of the unit of the drawing; it overrides $INSUNITS")
          .standard("from the unit of the drawing, where units = SI"),
      value<D>(
          {"origin", "length", "[x, y]", "[0, 0]", "where the zero of the drawing lies"},
          [](const Value& given, D& keys) { keys.origin = given.point().value_or(Point(0, 0)); }, none),
      number<D>("join", "unit of the drawing", &D::join, positive, "ends of lines that are no further apart meet")
          .standard("1e-6 of the diagonal"),
      layer("outline", &DrawingLayers::outline, "layer of the outline: one closed loop"),
      layer("holes", &DrawingLayers::holes, "layer of the holes: closed loops; circles stay circles"),
      layer("cracks", &DrawingLayers::cracks, "layer of the cracks"),
      value<D>(
          {"edges", "-", "a list of layers", "absent",
           "further layers whose lines are parts of the outline: edges with the names of these layers"},
          [](const Value& given, D& keys) { keys.layers.edges = given.texts().value_or(std::vector<std::string>()); },
          none),
  };
}

/// The length of a unit of the drawing; reports where it is not known.
double scale_of(const Value& given, const DrawingKeys& keys, int unit) {
  auto& reading = given.reading();
  const auto known = metres_of(unit);
  if (!keys.scale && known && reading.metres) return known->first;
  if (!keys.scale) {
    reading.report_error(
        given.below("scale"),
        fmt::format("is missing, must be a number > 0: the drawing {}, and the case has units = \"{}\"",
                    known ? "is in " + known->second : std::string("states no unit"), reading.metres ? "SI" : "none"));
    return 1;
  }
  if (known && reading.metres && std::abs(*keys.scale / known->first - 1) > 1e-9)
    reading.found().notes.push_back(fmt::format("{} = {:g} overrides the unit of the drawing, {} = {:g} m",
                                                given.below("scale"), *keys.scale, known->second, known->first));
  return *keys.scale;
}

/// Reports layers without lines: those that the case names, and that of the outline where there must be one.
void check_layers(const Value& given, const DrawingKeys& keys, const DxfDrawing& dxf, bool needs_outline) {
  auto& reading = given.reading();
  std::set<std::string> drawn;
  for (const auto& piece : dxf.pieces) drawn.insert(piece.layer);
  const std::vector<std::string> known(dxf.layers.begin(), dxf.layers.end());
  const auto look = [&](const char* key, const std::string& layer) {
    if (drawn.contains(layer_key(layer))) return;
    reading.report_error(given.below(key),
                         fmt::format("no line or curve has the layer \"{}\"{}; layers of the drawing: {}", layer,
                                     did_you_mean(layer, known), known.empty() ? "none" : listed(known)));
  };
  if (reading.given(given.below("holes"))) look("holes", keys.layers.holes);
  if (reading.given(given.below("cracks"))) look("cracks", keys.layers.cracks);
  for (const auto& edge : keys.layers.edges) look("edges", edge);
  const bool some_edge =
      std::ranges::any_of(keys.layers.edges, [&](const std::string& edge) { return drawn.contains(layer_key(edge)); });
  if (reading.given(given.below("outline")) || (needs_outline && !some_edge)) {
    if (!some_edge || reading.given(given.below("outline"))) look("outline", keys.layers.outline);
  }
}

void check_names(const Value& given, const DrawingKeys& keys) {
  const auto all = keys.layers.all();
  if (all.size() < 3 + keys.layers.edges.size())
    given.report_error("gives one layer two meanings: outline, holes, cracks and edges must differ");
  for (const auto& edge : keys.layers.edges)
    if (edge.empty() || edge.starts_with("hole"))
      given.reading().report_error(given.below("edges"),
                                   fmt::format("\"{}\" given, must not be empty nor begin with 'hole'", edge));
}

double diagonal(const std::vector<DrawnPiece>& pieces) {
  std::vector<Point> all;
  for (const auto& piece : pieces) all.insert(all.end(), piece.points.begin(), piece.points.end());
  if (all.empty()) return 0;
  const auto [low, high] = geometry::bounding_box(all);
  return (high - low).norm();
}

void put_into(plate::Problem& content, JoinedDrawing drawing, const DrawingKeys& keys, double scale) {
  const auto place = [&](Point& x) { x = keys.origin + scale * x; };
  for (auto& x : drawing.outline.outer.vertices) place(x);
  if (!drawing.outline.outer.vertices.empty()) content.outline.outer = std::move(drawing.outline.outer);
  for (auto& hole : drawing.outline.holes) {
    if (auto* circle = std::get_if<geometry::Circle>(&hole))
      place(circle->centre), circle->radius *= scale;
    else
      for (auto& x : std::get<geometry::Polygon>(hole).vertices) place(x);
    content.outline.holes.push_back(std::move(hole));
  }
  for (auto& crack : drawing.cracks) {
    for (auto& x : crack) place(x);
    content.cracks.push_back(std::move(crack));
  }
}

void note_drawing(const Value& given, const DrawingKeys& keys, const JoinedDrawing& drawing, double scale) {
  const auto count = [](std::size_t many, const char* name) {
    return fmt::format("{} {}{}", many, name, many == 1 ? "" : "s");
  };
  const std::set<std::string> edges(drawing.outline.outer.edge_names.begin(), drawing.outline.outer.edge_names.end());
  auto text = fmt::format("{}: \"{}\", times {:g}, has {}, {} and {}", given.key(), keys.file, scale,
                          edges.empty() ? "no outline" : count(edges.size(), "edge"),
                          count(drawing.outline.holes.size(), "hole"), count(drawing.cracks.size(), "crack"));
  if (drawing.off > 0) text += fmt::format("; chords of curves are up to {:.2g} off", scale * drawing.off);
  given.reading().found().notes.push_back(text);
}

void read_drawing(const Value& given, plate::Problem& content) {
  constexpr std::size_t most = 10000;
  auto& reading = given.reading();
  DrawingKeys keys;
  read_fields(drawing_fields(), given, keys);
  if (given.is_table()) check_names(given, keys);
  if (!reading.sound(given.key())) return;
  const bool has_outline = reading.given("geometry.outline");
  auto dxf = read_dxf(reading.folder / keys.file, keys.layers.all());
  const auto report = [&](const std::vector<std::string>& problems) {
    for (const auto& problem : problems)
      reading.report_error(given.below("file"), fmt::format("\"{}\": {}", keys.file, problem));
  };
  if (dxf.pieces.size() > most)
    dxf.problems.push_back(fmt::format("{} lines and curves, must be at most {}", dxf.pieces.size(), most));
  report(dxf.problems);
  if (!dxf.problems.empty()) return;
  check_layers(given, keys, dxf, !has_outline);
  const double scale = scale_of(given, keys, dxf.unit), join = keys.join.value_or(1e-6 * diagonal(dxf.pieces));
  auto drawing = joined(std::move(dxf.pieces), keys.layers, join, reading.spacing.value_or(0) / scale);
  report(drawing.problems);
  if (has_outline && !drawing.outline.outer.vertices.empty())
    reading.report_error("geometry.outline", "is given, and the drawing has an outline too: remove one of them");
  if (!reading.sound(given.key())) return;
  note_drawing(given, keys, drawing, scale);
  put_into(content, std::move(drawing), keys, scale);
}

}  // namespace

Field<plate::Problem> drawing_field() {
  return {"drawing", rows_below("drawing", drawing_fields()), read_drawing,
          [](const plate::Problem&, Analysis::Kind) { return std::string(); }};
}

}  // namespace cases
