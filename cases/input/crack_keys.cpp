#include <numbers>

#include "cases/input/keys.hpp"
#include "geometry/shape/smooth_curve.hpp"
#include "plate/model/problem.hpp"
#include "post/files/table.hpp"

namespace cases {
namespace {

using geometry::Point;
using geometry::Polyline;

/// A crack that is given by a curve.
struct CrackCurve {
  std::optional<Polyline> line;  // fine
  Polyline traced;
  double scale = 1;
  Point origin{0, 0};
  double tolerance = 0;
};

void read_arc(const Value& given, CrackCurve& curve) {
  constexpr double degree = std::numbers::pi / 180;
  const std::string form =
      "[x, y, radius, from, to] with a radius > 0 and angles of less than 360 degrees between them";
  const auto x = given.numbers(5, form);
  if (!x) return;
  const double turned = std::abs((*x)[4] - (*x)[3]);
  if (!((*x)[2] > 0) || !(turned > 0) || !(turned < 360)) return given.refuse(form);
  curve.line = geometry::arc({(*x)[0], (*x)[1]}, (*x)[2], degree * (*x)[3], degree * (*x)[4]);
}

bool distinct(const Polyline& points) {
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i] == points[i - 1]) return false;
  return true;
}

void read_spline(const Value& given, CrackCurve& curve) {
  const auto points = given.points();
  if (!points) return;
  if (points->size() < 3 || !distinct(*points)) return given.refuse("a list of at least three points, each another");
  curve.line = geometry::curve_through(*points);
}

/// The points of a file with the columns x and y, or what is wrong with it.
std::variant<Polyline, std::string> traced(const std::filesystem::path& path) {
  try {
    const auto table = post::read_csv(path);
    const auto x = table.column("x"), y = table.column("y");
    Polyline result;
    for (const auto& row : table.rows) {
      const auto *a = std::get_if<double>(&row[x]), *b = std::get_if<double>(&row[y]);
      if (!a || !b) return fmt::format("row {}: x and y must be numbers", result.size() + 1);
      if (Point(*a, *b).allFinite() && (result.empty() || result.back() != Point(*a, *b))) result.emplace_back(*a, *b);
    }
    constexpr std::size_t least = 6, most = 10000;
    if (result.size() < least || result.size() > most)
      return fmt::format("{} points, must be {} to {}", result.size(), least, most);
    return result;
  } catch (const std::exception& error) {
    return error.what();
  }
}

Fields<CrackCurve> curve_fields() {
  using C = CrackCurve;
  const auto none = [](const C&) { return std::string(); };
  return {
      value<C>({"arc", "length, degrees", "[x, y, radius, from, to]", "",
                "an arc about (x, y), by the angles of its ends from x, counter-clockwise"},
               read_arc, none),
      value<C>({"spline", "length", "[[x, y], ...]", "", "the smooth curve through these points, three at least"},
               read_spline, none),
      value<C>(
          {"file", "-", "a CSV file with the columns x, y", "",
           "points of a picture in their order, sought beside the case: the curve of the fewest spans "
           "near them"},
          [](const Value& given, C& curve) {
            const auto text = given.text();
            if (!text) return;
            auto found = traced(given.reading().folder / *text);
            if (const auto* error = std::get_if<std::string>(&found))
              given.report_error(fmt::format("\"{}\": {}", *text, *error));
            else
              curve.traced = std::get<Polyline>(std::move(found));
          },
          none),
      number<C>("scale", "length", &C::scale, positive, "file: length of the unit of its coordinates, as of a pixel"),
      value<C>(
          {"origin", "length", "[x, y]", "", "file: where its coordinates are zero"},
          [](const Value& given, C& curve) { curve.origin = given.point().value_or(Point(0, 0)); }, none),
      number<C>("within", "length", &C::tolerance, positive,
                "file: by which the curve may pass the points, as two pixels"),
  };
}

/// The crack of a table of keys; nothing where it is wrong.
std::optional<Polyline> crack_of(const Value& given) {
  auto& reading = given.reading();
  CrackCurve curve;
  read_fields(curve_fields(), given, curve);
  const auto is_given = [&](const char* name) { return reading.given(given.below(name)); };
  if (reading.sound(given.key()) && is_given("arc") + is_given("spline") + is_given("file") != 1)
    given.refuse("a polyline [[x, y], ...], { arc = [...] }, { spline = [...] } or { file = \"...\", within = ... }");
  for (const char* name : {"scale", "origin", "within"})
    if (is_given(name) && !is_given("file")) reading.report_error(given.below(name), "is of file: remove it");
  if (is_given("file") && !is_given("within"))
    reading.report_error(given.below("within"), "is missing, must be a number > 0");
  if (!reading.sound(given.key())) return std::nullopt;
  if (curve.line) return curve.line;
  for (auto& x : curve.traced) x = curve.origin + curve.scale * x;
  const auto fitted = geometry::fitted_curve(curve.traced, curve.tolerance);
  if (fitted.spans == curve.traced.size())
    given.report_error(
        fmt::format("no smooth curve passes its {} points within {:g}: give a larger one, or one "
                    "crack for every part between corners",
                    curve.traced.size(), curve.tolerance));
  else
    reading.found().notes.push_back(
        fmt::format("{}: {} points are taken as a curve of {} spans, which passes all within {:.2g}", given.key(),
                    curve.traced.size(), fitted.spans, fitted.off));
  return geometry::curve_through(fitted.points);
}

void read_cracks(const Value& given, plate::Problem& content) {
  for (const auto& crack : given.elements("a list of polylines [ [[x, y], [x, y]], ... ]"))
    if (const auto points = crack.is_table() ? crack_of(crack) : crack.points()) content.cracks.push_back(*points);
}

std::string cracks_text(const plate::Problem& content) {
  std::vector<std::string> texts;
  for (const auto& crack : content.cracks) texts.push_back(text_of(crack));
  return texts.empty() ? "" : fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

Field<plate::Problem> cracks_field() {
  auto result = value<plate::Problem>({"cracks", "length", "[ [[x, y], [x, y], ...], ... ]", "",
                                       "polylines or curves; an end inside the plate is a tip, one on an edge or hole "
                                       "a mouth, one on a crack a junction"},
                                      read_cracks, cracks_text);
  for (auto& row : rows_below("cracks[]", curve_fields())) result.rows.push_back(std::move(row));
  return result;
}

void smooth_cracks(plate::Problem& content, Reading& reading) {
  const auto given = content.cracks;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto smooth = geometry::smooth_crack(given, i, geometry::tolerance(content.outline));
    if (!smooth) continue;
    content.cracks[i] = smooth->vertices;
    reading.found().notes.push_back(fmt::format(
        "geometry.cracks[{}]: {} pieces with bends up to {:.2g} degrees are taken as a smooth curve through their ends",
        i, smooth->pieces, smooth->largest_bend * 180 / std::numbers::pi));
  }
}

}  // namespace cases
