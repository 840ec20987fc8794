#include "cases/input/keys.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/section.hpp"

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
  if (const auto x = box_of(given)) outline.outer = geometry::rectangle((*x)[0], (*x)[1], (*x)[2], (*x)[3]).outer;
}

std::string rectangle_text(const Outline& outline) {
  const auto found = corners(outline);
  if (!found) return "";
  const auto& [low, high] = *found;
  return text_of_numbers(std::array{low.x(), low.y(), high.x(), high.y()});
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
  if (corners(outline))
    return given.report_error("is used with a polygon only: a rectangle has left, right, bottom, top");
  const auto names = given.texts();
  if (!names) return;
  const std::size_t size = outline.outer.vertices.size();
  for (const auto& name : *names)
    if (name.empty() || name.starts_with("hole"))
      return given.report_error(fmt::format("\"{}\" given, must not be empty nor begin with 'hole'", name));
  if (size > 0 && names->size() != size)
    return given.report_error(
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
            return circle ? text_of_numbers(std::array{circle->centre.x(), circle->centre.y(), circle->radius}) : "";
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
  const auto holes = [](auto& content) -> auto& {
    return content.outline.holes;
  };
  return {
      std::move(outline),
      tables<P, Hole>("holes", Layout::inline_, holes,
                      hole_fields("round hole; the holes are the edges hole0, hole1, ...",
                                  "polygonal hole; all its edges are one, hole0, hole1, ..."),
                      check_hole),
      cracks_field(),
      drawing_field(),
  };
}

Fields<plate::CrackFaces> crack_fields() {
  using F = plate::CrackFaces;
  return {boolean<F>("contact", &F::contact,
                     "faces of cracks touch without friction; otherwise they may overlap, and a warning says so")
              .used_in({Analysis::Kind::static_, Analysis::Kind::dynamic})};
}

void check_geometry_keys(const Value& given, plate::Problem& content) {
  auto& reading = given.reading();
  if (const auto key = given.below("outline"); !reading.given(key) && !reading.given(given.below("drawing")))
    reading.report_error(key, "is missing, must be [xmin, ymin, xmax, ymax]");
  name_holes(content);
}

void name_holes(plate::Problem& content) {
  for (std::size_t i = 0; i < content.outline.holes.size(); ++i) {
    const std::string name = fmt::format("hole{}", i);
    if (auto* circle = std::get_if<Circle>(&content.outline.holes[i]))
      circle->name = name;
    else
      for (auto& edge : std::get<Polygon>(content.outline.holes[i]).edge_names) edge = name;
  }
}

namespace {

using plate::Orthotropy;
using plate::Ply;
using plate::Section;
using plate::SectionRegion;

/// Fields for the orthotropy of a whole section or of a ply.
template <typename Material>
Fields<Material> orthotropy_fields() {
  const auto modulus = [](const char* name, double Orthotropy::*member, const char* help) {
    return number<Material>(name, "force/length^2", member, positive, help).required();
  };
  return {
      modulus("E1", &Orthotropy::E1, "Young's modulus along axis 1"),
      modulus("E2", &Orthotropy::E2, "Young's modulus along axis 2"),
      number<Material>("nu12", "-", &Orthotropy::nu12, finite,
                       "Poisson's ratio: contraction along 2 under stress along 1; nu12^2 < E1 / E2")
          .required(),
      modulus("G12", &Orthotropy::G12, "shear modulus in the plane"),
      modulus("G13", &Orthotropy::G13, "transverse shear modulus along axis 1"),
      modulus("G23", &Orthotropy::G23, "transverse shear modulus along axis 2"),
      number<Material>("angle", "degrees", &Orthotropy::angle, finite, "of axis 1 from x, counter-clockwise"),
  };
}

void check_orthotropy(const Value& given, const Orthotropy& m) {
  const auto& reading = given.reading();
  for (const char* name : {"E1", "E2", "nu12"})
    if (!reading.given(given.below(name)) || !reading.sound(given.below(name))) return;
  if (!m.stable())
    given.reading().report_error(
        given.below("nu12"), fmt::format("{:g} given, must be below sqrt(E1 / E2) = {:.6g} in size: strains would cost "
                                         "no energy",
                                         m.nu12, std::sqrt(m.E1 / m.E2)));
}

Fields<Ply> ply_fields() {
  auto fields = orthotropy_fields<Ply>();
  fields.push_back(number<Ply>("thickness", "length", &Ply::thickness, positive, "thickness of the ply").required());
  fields.push_back(
      number<Ply>("density", "mass/length^3", &Ply::density, positive, "of the ply; without it section.density"));
  fields.push_back(number<Ply>("alpha1", "1/temperature", &Ply::alpha1, finite,
                               "thermal strain along axis 1; without it section.thermal_expansion"));
  fields.push_back(number<Ply>("alpha2", "1/temperature", &Ply::alpha2, finite,
                               "thermal strain along axis 2; without it section.thermal_expansion"));
  return fields;
}

Fields<SectionRegion> region_fields() {
  using R = SectionRegion;
  auto shape = table<R, geometry::Hole>(
      "on", Layout::inline_, &R::shape,
      hole_fields("the disc that has these numbers", "the polygon that has these numbers"), check_hole);
  shape.needed = any_kind;
  return {
      std::move(shape),
      number<R>("thickness", "length", &R::thickness, positive, "thickness there"),
      number<R>("young", "force/length^2", &R::young, positive, "Young's modulus there"),
      number<R>("poisson", "-", &R::poisson, {-1, 0.5, true, true}, "Poisson's ratio there"),
      number<R>("density", "mass/length^3", &R::density, positive, "mass density there"),
  };
}

Field<Section> factor(const std::string& name, plate::Formula Section::*member, const std::string& of) {
  return value<Section>(
      {name, "-", "an expression in x, y and pi", "", of + " at a place over section." + of + ", as \"1 + 0.2 * x\""},
      [=](const Value& given, Section& section) {
        if (const auto formula = formula_of(given)) section.*member = *formula;
      },
      [=](const Section& section) {
        return (section.*member).given() ? quoted((section.*member).text()) : std::string();
      });
}

void check_region(const Value& given, SectionRegion& region) {
  if (given.reading().sound(given.key()) && !region.thickness && !region.young && !region.poisson && !region.density)
    given.report_error("changes nothing: give thickness, young, poisson or density");
}

}  // namespace

Fields<Section> section_fields() {
  const Condition<Section> isotropic{"orthotropic", "neither orthotropic nor plies",
                                     [](const Section& s) { return s.isotropic(); }};
  const Condition<Section> of_one{"plies", "one material over the thickness",
                                  [](const Section& s) { return s.plies.empty(); }};
  return {
      table<Section, Orthotropy>("orthotropic", Layout::inline_, &Section::orthotropic, orthotropy_fields<Orthotropy>(),
                                 [](const Value& given, Orthotropy& m) { check_orthotropy(given, m); }),
      tables<Section, Ply>("plies", Layout::inline_, &Section::plies, ply_fields(),
                           [](const Value& given, Ply& ply) { check_orthotropy(given, ply); }),
      number<Section>("young", "force/length^2", &Section::young, positive, "Young's modulus")
          .required()
          .with(isotropic),
      number<Section>("poisson", "-", &Section::poisson, {-1, 0.5, true, true}, "Poisson's ratio")
          .required()
          .with(isotropic),
      number<Section>("thickness", "length", &Section::thickness, positive, "thickness of the plate")
          .required()
          .with(of_one),
      number<Section>("shear_correction", "-", &Section::shear_correction, {0, 1, true},
                      "factor of the transverse shear stiffness"),
      number<Section>("thermal_expansion", "1/temperature", &Section::thermal_expansion, positive,
                      "strain per temperature, of loads of kind = temperature"),
      number<Section>("density", "mass/length^3", &Section::density, positive,
                      "mass density; in statics of own weight alone")
          .standard("required in dynamics and frequencies and harmonic analyses, but where every ply has its own"),
      factor("thickness_factor", &Section::thickness_factor, "thickness").with(of_one),
      factor("young_factor", &Section::young_factor, "young").with(isotropic),
      tables<Section, SectionRegion>("regions", Layout::inline_, &Section::regions, region_fields(), check_region)
          .with(of_one),
  };
}

namespace {

/// Reports a density that is missed where the plate moves.
void check_density(const Value& given, const Section& section) {
  using enum Analysis::Kind;
  auto& reading = given.reading();
  const auto key = given.below("density");
  const bool of_plies =
      !section.plies.empty() && std::ranges::all_of(section.plies, [](const Ply& ply) { return bool(ply.density); });
  if (of_plies || reading.given(key) || !reading.sound(given.below("plies"))) return;
  if (reading.kind && Kinds{dynamic, frequencies, harmonic}.contains(*reading.kind))
    reading.report_error(key, "is missing, must be a number > 0");
}

}  // namespace

void check_section(const Value& given, Section& section) {
  auto& reading = given.reading();
  check_density(given, section);
  if (!section.plies.empty()) section.thickness = 0;
  for (const auto& ply : section.plies) section.thickness += ply.thickness;
  if (section.orthotropic && !section.plies.empty())
    reading.report_error(given.below("orthotropic"),
                         "is given beside plies, which have materials of their own: remove one");
  for (std::size_t i = 0; section.orthotropic && i < section.regions.size(); ++i)
    for (const char* name : {"young", "poisson"})
      if (const auto key = fmt::format("section.regions[{}].{}", i, name); reading.given(key))
        reading.report_error(key, "is of isotropic sections: remove it");
}

}  // namespace cases
