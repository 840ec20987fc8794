#include "cases/input/keys.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "cases/input/case_file.hpp"
#include "cases/input/compatibility.hpp"
#include "cases/input/formulations.hpp"
#include "cases/input/validation.hpp"
#include "geometry/shape/crack_cleanup.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem_validation.hpp"
#include "plate/solve/validation.hpp"

namespace cases {
namespace {

/// A text; `standard`: words about its default, "absent" where it is not written unless given.
Field<Case> text(const std::string& name, std::string Case::*member, const std::string& standard,
                 const std::string& help) {
  const bool optional = standard == "absent";
  return value<Case>(
      {name, "-", "a string", standard, help},
      [=](const Value& given, Case& content) {
        if (const auto words = given.text()) content.*member = *words;
      },
      [=](const Case& content) { return optional && (content.*member).empty() ? "" : quoted(content.*member); });
}

/// The way of a paper. apply_recipe() has put its keys into the tree before this is read.
Field<Case> recipe() {
  auto field = choice<Case, std::string>("recipe", &Case::recipe, {{{"dai2021", "dai2021"}}},
                                         "sets the keys of the way of a paper that the file does not give: "
                                         "bonds as Dai et al. (2021) have them; see \"Examples of the papers\"")
                   .standard("absent");
  field.write = [write = field.write](const Case& content, Analysis::Kind kind) {
    return content.recipe.empty() ? std::string() : write(content, kind);
  };
  return field;
}

plate::Problem& problem_of(Case& content) {
  return content;
}
const plate::Problem& problem_of(const Case& content) {
  return content;
}

/// Loads of [[load]]: all of them for reading, without those of load cases for writing.
std::vector<plate::Load>& own_loads(Case& content) {
  return content.loads;
}
std::vector<plate::Load> own_loads(const Case& content) {
  return {content.loads.begin(), content.loads.begin() + std::ptrdiff_t(plate::shared_loads(content))};
}

}  // namespace

const Fields<Case>& case_fields() {
  const auto plate_of = [](auto& content) -> auto& {
    return problem_of(content);
  };
  const auto loads_of = [](auto& content) -> decltype(auto) { return own_loads(content); };
  static const Kinds loaded{Analysis::Kind::static_, Analysis::Kind::dynamic, Analysis::Kind::harmonic};
  static const Fields<Case> fields{
      text("title", &Case::title, "the file's name", "title of the case"),
      text("source", &Case::source, "\"\"", "where the case comes from"),
      text("project", &Case::project, "absent", "project, at the head of the report"),
      text("author", &Case::author, "absent", "who made the case, at the head of the report"),
      text("date", &Case::date, "absent", "date of the case, at the head of the report"),
      choice<Case, std::string>("units", &Case::units, {{{"none", "none"}, {"SI", "SI"}}},
                                "unit system named in the results"),
      recipe(),
      table<Case, plate::Section>("section", Layout::block, &Case::section, section_fields(), check_section),
      table<Case, plate::Problem>("geometry", Layout::block, plate_of, geometry_fields(), check_geometry_keys),
      table<Case, plate::CrackFaces>("cracks", Layout::block, &Case::faces, crack_fields()),
      table<Case, plate::Discretization>("discretization", Layout::block, &Case::discretization,
                                         discretization_fields()),
      tables<Case, plate::Support>("support", Layout::block, &Case::supports, support_fields()),
      tables<Case, plate::Foundation>("foundation", Layout::block, &Case::foundations, foundation_fields()),
      tables<Case, plate::Spring>("spring", Layout::block, &Case::springs, spring_fields()),
      tables<Case, plate::Stiffener>("stiffener", Layout::block, &Case::stiffeners, stiffener_fields()),
      tables<Case, plate::Load>("load", Layout::block, loads_of, load_fields(), check_load),
      tables<Case, plate::LoadCase>("case", Layout::block, &Case::load_cases, load_case_fields()),
      tables<Case, plate::Combination>("combination", Layout::block, &Case::combinations, combination_fields()),
      table<Case, plate::Initial>("initial", Layout::block, &Case::initial, initial_fields()).in_dynamics(),
      table<Case, plate::Impact>("impact", Layout::block, &Case::impact, impact_fields()).in_dynamics(),
      table<Case, Analysis>("analysis", Layout::block, &Case::analysis, analysis_fields(), check_analysis),
      table<Case, fracture::Growth>("growth", Layout::block, &Case::growth, growth_fields())
          .used_in({Analysis::Kind::static_, Analysis::Kind::dynamic}),
      table<Case, post::SrifOptions>("srif", Layout::block, &Case::srif, srif_fields(), check_srif).used_in(loaded),
      table<Case, AccuracyTargets>("accuracy", Layout::block, &Case::accuracy, accuracy_fields(), check_accuracy)
          .used_in({Analysis::Kind::static_, Analysis::Kind::frequencies}),
      table<Case, Output>("output", Layout::block, &Case::output, output_fields()),
  };
  return fields;
}

const std::vector<Key>& keys() {
  static const std::vector<Key> rows = [] {
    std::vector<Key> result;
    for (const auto& field : case_fields()) result.insert(result.end(), field.rows.begin(), field.rows.end());
    return result;
  }();
  return rows;
}

namespace {

/// Shape and cracks; true where edges and points can be checked against the shape.
bool check_geometry(const Case& content, Reading& reading) {
  for (const char* key : {"geometry.outline", "geometry.holes"})
    if (!reading.sound(key)) return false;
  if (content.outline.outer.vertices.empty()) return false;
  const auto shape_errors = geometry::errors(content.outline);
  for (const auto& error : shape_errors) reading.report_error("geometry." + error.where, error.what);
  if (!shape_errors.empty()) return false;
  if (!reading.sound("geometry.cracks")) return true;
  for (const auto& error : geometry::errors(content.outline, content.cracks, geometry::tolerance(content.outline)))
    reading.report_error("geometry." + error.where, error.what);
  return true;
}

/// Names of edges, kinds and places of supports and loads.
void check_edges(const Case& content, Reading& reading) {
  std::set<std::string> refused;  // one problem of a key is told: looked for among all problems once
  for (const auto& error : plate::errors_in_edges(content)) {
    const auto key = key_of(error, content);
    if (refused.contains(key)) continue;
    if (error.subject == plate::Subject::support_direction &&
        !reading.sound(fmt::format("support[{}].kind", error.number)))
      continue;
    if (!reading.sound(key) || (error.subject == plate::Subject::load_position && !reading.given(key))) continue;
    reading.report_error(key, error.what);
    refused.insert(key);
  }
}

void check_lengths(const Case& content, Reading& reading) {
  for (const auto& error : plate::errors_in_lengths(content, content.analysis)) {
    const bool known =
        error.subject == plate::Subject::spacing ? !reading.finds_spacing : reading.sound("section.thickness");
    if (known && reading.sound("discretization.spacing")) reading.report_error(key_of(error, content), error.what);
  }
}

void check_probes(const Case& content, Reading& reading) {
  for (const auto& [name, point] : content.output.probes)
    if (!plate::on_plate(content.outline, point))
      reading.report_error("output.probes." + name,
                           text_of(point) + " given, must lie in the plate or on its boundary");
}

void check_tips(const Case& content, Reading& reading) {
  if (content.faces_touch() && content.cracks.empty())
    reading.report_error("cracks.contact",
                         "there is no crack whose faces could touch: remove it, or give geometry.cracks");
  if (content.faces_touch() && !content.section.plies.empty())
    reading.report_error("cracks.contact",
                         "factors of closed cracks are known for one material, not for plies: remove it");
  if (!content.srif || !reading.sound("geometry") || (content.growth && content.growth->by_bonds())) return;
  const auto paths = plate::crack_paths(content);
  if (geometry::tips(paths).empty())
    reading.report_error("srif",
                         "there is no crack tip to find intensity factors at: remove [srif] or give geometry.cracks");
}

void check_beside_analysis(const Case& content, Reading& reading) {
  const auto given = [&](const std::string& key) { return reading.given(key); };
  // what is missing or cannot be read has another value here than the file means
  std::set<std::string> unread;
  for (const auto& problem : reading.problems()) unread.insert(problem.key);
  const auto report_error = [&](const std::vector<KeyError>& errors) {
    for (const auto& [key, what] : errors)
      if (!unread.contains(key)) reading.report_error(key, what);
  };
  const auto& [analysis, growth, srif] = std::tie(content.analysis, content.growth, content.srif);
  if (growth && reading.sound("geometry")) report_error(errors_in_growth(content, analysis, *growth, srif, given));
  report_error(errors_in_accuracy(content, analysis, srif, content.formulation_reason));
  for (const auto& refusal : plate::errors_in_heat(content)) report_error({{key_of(refusal, content), refusal.what}});
  if ((srif || growth) && reading.sound("section") && reading.sound("geometry"))
    report_error(errors_in_section(content));
  report_error(errors_in_motion(content, analysis, growth.has_value(), given));
  if (content.accuracy && !content.output.errors)
    report_error({{"output.errors", "false given beside [accuracy], which goes by these errors: remove one"}});
  report_error(errors_in_response(content, analysis));
  report_error(errors_in_prestress(content, analysis));
  report_error(errors_in_beginning(content, analysis));
  report_error(errors_in_constant_loads(content, analysis));
  report_error(excluded(content, reading.distributed));
}

}  // namespace

void snap_cracks(Case& content, Reading& reading) {
  constexpr double share = 0.05;  // of a spacing: points do not tell the difference
  if (!reading.sound("geometry") || content.outline.outer.vertices.size() < 3) return;
  const double spacing = content.discretization.spacing_at_tips();
  auto found = geometry::snapped(content.outline, std::move(content.cracks), spacing > 0 ? share * spacing : INFINITY);
  content.cracks = std::move(found.cracks);
  for (const auto& snap : found.snaps)
    reading.found().notes.push_back(
        fmt::format("geometry.cracks[{}]: its {} at {} was {:.2g} from {} and is taken to end there", snap.crack,
                    snap.at_back ? "last point" : "first point",
                    text_of(snap.at_back ? content.cracks[snap.crack].back() : content.cracks[snap.crack].front()),
                    snap.distance, snap.onto));
}

/// Gives springs between faces the numbers that their cracks have after some were joined into one.
void renumber_springs(const std::vector<geometry::Polyline>& before, Case& content, Reading& reading) {
  const double near = geometry::tolerance(content.outline);
  std::vector<std::size_t> now;
  for (const auto& crack : before)
    now.push_back(std::size_t(std::ranges::find_if(content.cracks,
                                                   [&](const geometry::Polyline& other) {
                                                     return std::ranges::all_of(crack, [&](const geometry::Point& x) {
                                                       return geometry::distance(other, x) <= near;
                                                     });
                                                   }) -
                              content.cracks.begin()));
  for (std::size_t i = 0; i < content.springs.size(); ++i) {
    auto& cracks = content.springs[i].cracks;
    std::set<std::size_t> tied;
    for (const auto crack : cracks)
      if (crack < now.size()) tied.insert(now[crack]);
    for (std::size_t crack = 0; crack < now.size() && !cracks.empty(); ++crack)
      if (tied.contains(now[crack]) && std::ranges::find(cracks, crack) == cracks.end())
        reading.report_error(fmt::format("spring[{}].cracks", i),
                             fmt::format("geometry.cracks[{}] is one crack with one of these, as both continue each "
                                         "other in one line: name both, or leave a gap between them",
                                         crack));
    if (std::ranges::all_of(cracks, [&](std::size_t crack) { return crack < now.size(); }))
      cracks.assign(tied.begin(), tied.end());
  }
}

void merge_cracks(Case& content, Reading& reading) {
  const auto before = content.cracks;
  auto found = geometry::merged(content.outline, std::move(content.cracks));
  content.cracks = std::move(found.cracks);
  if (!found.continuations.empty()) renumber_springs(before, content, reading);
  for (const auto& [crack, onto] : found.continuations)
    reading.found().notes.push_back(fmt::format(
        "geometry.cracks[{}] continues geometry.cracks[{}] in one line: both are taken as one crack", crack, onto));
}

/// Least distance between two parallel lines that have the points between them: one runs along an edge of their hull.
double least_width(std::vector<geometry::Point> points) {
  const auto beside = [](const geometry::Point& a, const geometry::Point& b, const geometry::Point& x) {
    return (b - a).x() * (x - a).y() - (b - a).y() * (x - a).x();
  };
  std::ranges::sort(points, {}, [](const geometry::Point& x) { return std::pair(x.x(), x.y()); });
  double least = INFINITY;
  for (const bool upper : {false, true}) {
    std::vector<geometry::Point> hull;
    for (const auto& x : points) {
      while (hull.size() > 1 && beside(hull.end()[-2], hull.back(), x) <= 0) hull.pop_back();
      hull.push_back(x);
    }
    for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
      const auto far = [&](const geometry::Point& x) { return beside(hull[i], hull[i + 1], x); };
      least = std::min(least, far(*std::ranges::max_element(points, {}, far)) / (hull[i + 1] - hull[i]).norm());
    }
    if (!upper) std::ranges::reverse(points);
  }
  return least;
}

void look_at_proportions(const Case& content, Reading& reading) {
  constexpr double most = 0.5;  // of the width: theories of plates end far below
  const double width = least_width(content.outline.outer.vertices), share = content.section.thickness / width;
  if (share > most)
    reading.found().notes.push_back(
        fmt::format("section.thickness is {:.2g} times the plate's least width: this is no plate; look at the units, "
                    "and set section.thickness below {:.2g}",
                    share, most * width));
}

void check_case(const Case& content, Reading& reading) {
  const bool begins = content.initial || content.impact;
  if (content.loads.empty() && content.load_cases.empty() && reading.kind != Analysis::Kind::frequencies && !begins &&
      reading.sound("load"))
    reading.report_error("load", std::string("nothing loads the plate: give at least one [[load]]") +
                                     (reading.kind == Analysis::Kind::dynamic ? ", [initial] or [impact]" : ""));
  check_formulation(content, reading);
  for (const auto& [key, what] : errors_in_load_cases(content))
    if (key == "combination" || reading.sound(key)) reading.report_error(key, what);
  if (!check_geometry(content, reading)) return;
  check_lengths(content, reading);
  check_edges(content, reading);
  check_probes(content, reading);
  check_tips(content, reading);
  check_beside_analysis(content, reading);
}

}  // namespace cases
