#include "post/report/html_data.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "plate/model/problem.hpp"
#include "post/report/html_page.hpp"

namespace post {
namespace {

const double* number(const Cell& cell) {
  return std::get_if<double>(&cell);
}

/// True where a table has several rows of one instant, which stay together: one for each tip, probe or support.
bool is_in_time(const Table& table) {
  return !table.columns.empty() && (table.columns[0] == "time" || table.columns[0] == "advance");
}

std::set<std::size_t> rows_of(const Table& table, std::size_t most) {
  std::set<std::size_t> rows;
  const auto size = table.rows.size(), step = size / most + 1;
  const bool together = is_in_time(table);
  for (std::size_t i = 0, instant = 0; i < size; ++i) {
    const bool same = together && i > 0 && table.rows[i][0] == table.rows[i - 1][0];
    if (i > 0 && !same) ++instant;
    if (instant % step == 0) rows.insert(i);
  }
  if (size == 0) return rows;
  rows.insert(size - 1);
  for (std::size_t column = 0; column < table.columns.size() && step > 1; ++column) {
    std::size_t least = 0, largest = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const auto* x = number(table.rows[i][column]);
      if (!x) continue;
      const auto *low = number(table.rows[least][column]), *high = number(table.rows[largest][column]);
      if (!low || *x < *low) least = i;
      if (!high || *x > *high) largest = i;
    }
    rows.insert({least, largest});
  }
  return rows;
}

std::string text_of(const Cell& cell) {
  constexpr int digits = 8;
  if (const auto* x = number(cell)) return json_number(*x, digits);
  if (const auto* word = std::get_if<std::string>(&cell)) return json_text(*word);
  return "null";
}

}  // namespace

std::string table_json(const Table& table, std::size_t most) {
  const auto rows = rows_of(table, most);
  Members columns;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    std::vector<std::string> cells;
    for (const auto row : rows) cells.push_back(text_of(table.rows[row][column]));
    if (std::ranges::any_of(cells, [](const auto& cell) { return cell != "null"; }))
      columns.emplace_back(table.columns[column], json_list(cells));
  }
  return json_object(columns);
}

Table recommended(const Table& srifs) {
  const auto time = srifs.column("time"), tip = srifs.column("tip");
  Table result{srifs.columns, {}};
  for (const auto& row : srifs.rows)
    if (result.rows.empty() || result.rows.back()[time] != row[time] || result.rows.back()[tip] != row[tip])
      result.rows.push_back(row);
  return result;
}

Table columns_of(const Table& table, const std::vector<std::string>& names) {
  Table result;
  std::vector<std::size_t> from;
  for (const auto& name : names) {
    const auto found = std::ranges::find(table.columns, name);
    if (found == table.columns.end()) continue;
    from.push_back(std::size_t(found - table.columns.begin()));
    result.columns.push_back(name);
  }
  for (const auto& row : table.rows) {
    auto& cells = result.rows.emplace_back();
    for (const auto column : from) cells.push_back(row[column]);
  }
  return result;
}

namespace {

std::string text_of(const geometry::Point& x) {
  return json_list({json_number(x.x()), json_number(x.y())});
}

std::string text_of(const std::vector<geometry::Point>& points) {
  std::vector<std::string> texts;
  for (const auto& x : points) texts.push_back(text_of(x));
  return json_list(texts);
}

std::string text_of(const std::vector<std::string>& words) {
  std::vector<std::string> texts;
  for (const auto& word : words) texts.push_back(json_text(word));
  return json_list(texts);
}

std::string text_of(const geometry::Hole& hole) {
  if (const auto* circle = std::get_if<geometry::Circle>(&hole))
    return json_object({{"name", json_text(circle->name)},
                        {"centre", text_of(circle->centre)},
                        {"radius", json_number(circle->radius)}});
  const auto& polygon = std::get<geometry::Polygon>(hole);
  return json_object({{"vertices", text_of(polygon.vertices)}});
}

const char* words(plate::SupportKind kind) {
  using enum plate::SupportKind;
  static const std::map<plate::SupportKind, const char*> all{
      {free, "free"},
      {clamped, "clamped"},
      {simply_supported, "simply supported"},
      {simply_supported_hard, "simply supported, hard"},
      {symmetry, "symmetry"},
      {clamped_layer, "clamped in a layer"},
      {simply_supported_layer, "simply supported in a layer"},
      {simply_supported_hard_layer, "simply supported in a layer, hard"},
      {pinned, "pinned"},
      {in_plane, "held in the plane"},
      {hub, "hub"}};
  return all.at(kind);
}

std::string words(const plate::History& history) {
  using enum plate::History::Kind;
  switch (history.kind) {
    case step:
      return "";
    case ramp:
      return fmt::format("rising over {:g}", history.rise_time);
    case sine:
      return fmt::format("sine of frequency {:g}", history.frequency);
    case constant:
      return "constant, while others grow";
    case table:
      return history.table.size() < 2
                 ? "table in time"
                 : fmt::format("table in time, {:g} to {:g}", history.table.front().first, history.table.back().first);
  }
  return "";
}

/// Adds what the page says of each kind of load.
struct Described {
  Members& members;

  void add(const char* name, std::string text) const { members.emplace_back(name, std::move(text)); }

  void operator()(const plate::Pressure& load) const {
    if (load.formula.given()) add("expression", json_text(load.formula.text()));
    if (load.table.given()) add("expression", json_text("of the table " + load.table.file().filename().string()));
    if (load.level) {
      add("level", json_number(*load.level));
      add("expression",
          json_text(fmt::format("of a fluid of the unit weight {:g} up to y = {:g}", load.value, *load.level)));
    }
    moves(load);
    if (load.patch) add("patch", text_of(*load.patch));
    if (!load.gradient.isZero(0)) add("gradient", text_of(load.gradient)), add("from", text_of(load.from));
  }
  void operator()(const plate::EdgeMoment& load) const { add("twist", json_number(load.twist)), tensor(load.tensor); }
  void operator()(const plate::EdgeShear&) const {}
  void operator()(const plate::EdgeTraction& load) const { add("shear", json_number(load.shear)), tensor(load.tensor); }
  void operator()(const plate::BodyForce& load) const { add("vector", text_of(load.vector)); }
  void operator()(const plate::PointForce& load) const {
    moves(load);
    add("position", text_of(load.path.empty() ? load.position : load.path.front()));
    if (load.vector != geometry::Point(0, 0)) add("vector", text_of(load.vector));
  }
  void operator()(const plate::LineLoad& load) const { add("along", text_of(load.along)); }
  void operator()(const plate::Temperature& load) const {
    if (load.formula.given()) add("expression", json_text(load.formula.text()));
    if (load.mean_formula.given())
      add("mean", json_text(load.mean_formula.text()));
    else if (load.mean != 0)
      add("mean", json_number(load.mean));
  }
  void operator()(const plate::Settlement& load) const {
    add("support", json_number(double(load.support)));
    add("rotation", json_number(load.rotation));
    if (!load.slope.isZero(0)) add("gradient", text_of(load.slope)), add("from", text_of(load.from));
  }

private:
  void tensor(const std::optional<std::array<double, 3>>& components) const {
    if (!components) return;
    const auto [xx, yy, xy] = *components;
    add("tensor", json_list({json_number(xx), json_number(yy), json_number(xy)}));
  }
  template <class Moving>
  void moves(const Moving& load) const {
    if (load.path.empty()) return;
    add("path", text_of(load.path));
    add("speed", json_number(load.speed));
  }
};

std::string text_of(const plate::Load& load) {
  const double value = std::visit(
      [](const auto& one) {
        if constexpr (requires { one.value; })
          return one.value;
        else
          return 0.0;
      },
      load.action);
  Members members{{"kind", json_text(load.name())},
                  {"value", json_number(value)},
                  {"edges", text_of(load.edges())},
                  {"history", json_text(words(load.history))}};
  std::visit(Described{members}, load.action);
  return json_object(members);
}

std::string text_of(const plate::Foundation& foundation) {
  Members members{{"modulus", json_number(foundation.modulus)}, {"shear", json_number(foundation.shear)}};
  if (foundation.unilateral) members.emplace_back("lifts_off", "true");
  if (foundation.patch) members.emplace_back("patch", text_of(*foundation.patch));
  return json_object(members);
}

std::string text_of(const plate::Spring& spring) {
  Members members{{"deflection", json_number(spring.deflection)},
                  {"rotation_normal", json_number(spring.rotation_normal)},
                  {"rotation_tangential", json_number(spring.rotation_tangential)},
                  {"rotation", json_number(spring.rotation)},
                  {"edges", text_of(spring.edges)}};
  if (!spring.along.empty()) members.emplace_back("along", text_of(spring.along));
  if (!spring.cracks.empty()) {
    members.emplace_back("cracks", fmt::format("[{}]", fmt::join(spring.cracks, ",")));
    members.emplace_back("opening", json_number(spring.opening));
    members.emplace_back("sliding", json_number(spring.sliding));
    if (spring.depth.given()) members.emplace_back("depth", json_text(spring.depth.text()));
  }
  if (spring.position) members.emplace_back("position", text_of(*spring.position));
  return json_object(members);
}

std::string text_of(const plate::Stiffener& beam) {
  Members members{{"bending", json_number(beam.bending)}, {"torsion", json_number(beam.torsion)},
                  {"axial", json_number(beam.axial)},     {"eccentricity", json_number(beam.eccentricity)},
                  {"mass", json_number(beam.mass)},       {"edges", text_of(beam.edges)}};
  if (!beam.along.empty()) members.emplace_back("along", text_of(beam.along));
  return json_object(members);
}

std::string material_of(const plate::Section& s) {
  if (!s.plies.empty()) return fmt::format("{} plies", s.plies.size());
  if (const auto& m = s.orthotropic)
    return fmt::format("E1 {:g}, E2 {:g}, ν12 {:g}, G12 {:g}, G13 {:g}, G23 {:g}, axis 1 at {:g}°", m->E1, m->E2,
                       m->nu12, m->G12, m->G13, m->G23, m->angle);
  return fmt::format("E {:g}, ν {:g}", s.young, s.poisson);
}

/// `material`, in words, of sections that vary or have directions alone.
std::string text_of(const plate::Section& s) {
  Members members{{"young", json_number(s.young)},
                  {"poisson", json_number(s.poisson)},
                  {"thickness", json_number(s.thickness)},
                  {"density", json_number(s.density)}};
  if (s.simple()) return json_object(members);
  auto words = material_of(s);
  if (s.thickness_factor.given()) words += fmt::format(", thickness times {}", s.thickness_factor.text());
  if (s.young_factor.given()) words += fmt::format(", E times {}", s.young_factor.text());
  if (!s.regions.empty())
    words += fmt::format(", {} region{} of its own", s.regions.size(), s.regions.size() > 1 ? "s" : "");
  members.emplace_back("material", json_text(words));
  std::vector<std::string> regions;
  for (const auto& region : s.regions) regions.push_back(text_of(region.shape));
  if (!regions.empty()) members.emplace_back("regions", json_list(regions));
  return json_object(members);
}

/// Describes in words what starts a motion beside loads.
std::string beginning_of(const plate::Problem& problem) {
  std::vector<std::string> words;
  if (const auto& initial = problem.initial) {
    if (initial->deflection.given()) words.push_back("deflection " + initial->deflection.text());
    if (initial->velocity.given()) words.push_back("velocity " + initial->velocity.text());
  }
  if (const auto& impact = problem.impact)
    words.push_back(fmt::format("a mass of {:g} hits ({:g}, {:g}) with the velocity {:g}, contact stiffness {:g}",
                                impact->mass, impact->position.x(), impact->position.y(), impact->velocity,
                                impact->stiffness));
  return fmt::format("{}", fmt::join(words, "; "));
}

std::string text_of(const geometry::Edge& e) {
  return json_object({{"name", json_text(e.name)}, {"from", text_of(e.from)}, {"to", text_of(e.to)}});
}

std::string text_of(const plate::Support& s) {
  Members members{{"kind", json_text(words(s.kind))}, {"edges", text_of(s.edges)}, {"points", text_of(s.points)}};
  if (!s.along.empty()) members.emplace_back("along", text_of(s.along));
  if (s.patch) members.emplace_back("patch", text_of(*s.patch));
  if (s.k_w) members.emplace_back("k_w", json_number(*s.k_w));
  if (s.k_phi) members.emplace_back("k_phi", json_number(*s.k_phi));
  if (s.push != plate::Push::both_ways)
    members.emplace_back("pushes", json_text(s.push == plate::Push::up ? "up" : "down"));
  constexpr std::array in_plane{"free", "fixed", "normal", "tangential", "x", "y"};
  if (const auto held = s.held_in_plane(); held != plate::InPlane::free)
    members.emplace_back("in_plane", json_text(in_plane[std::size_t(held)]));
  return json_object(members);
}

template <typename Element>
std::string list_of(const std::vector<Element>& elements) {
  std::vector<std::string> texts;
  for (const auto& element : elements) texts.push_back(text_of(element));
  return json_list(texts);
}

}  // namespace

std::string plate_json(const plate::Problem& problem) {
  std::vector<std::string> cases(problem.loads.size(), json_text(""));  // of every load; loads of all cases have none
  for (std::size_t which = 0; which < problem.load_cases.size(); ++which)
    for (const std::size_t i : plate::loads_of(problem, which))
      if (i >= plate::shared_loads(problem)) cases[i] = json_text(problem.load_cases[which].name);
  return json_object({{"outline", text_of(problem.outline.outer.vertices)},
                      {"edges", list_of(geometry::straight_edges(problem.outline))},
                      {"holes", list_of(problem.outline.holes)},
                      {"cracks", list_of(problem.cracks)},
                      {"supports", list_of(problem.supports)},
                      {"foundations", list_of(problem.foundations)},
                      {"springs", list_of(problem.springs)},
                      {"stiffeners", list_of(problem.stiffeners)},
                      {"loads", list_of(problem.loads)},
                      {"cases", json_list(cases)},
                      {"beginning", json_text(beginning_of(problem))},
                      {"section", text_of(problem.section)}});
}

}  // namespace post
