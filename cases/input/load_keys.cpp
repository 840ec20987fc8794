#include <functional>
#include <unordered_set>
#include <variant>

#include "cases/input/keys.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/supports.hpp"
#include "post/files/atomic_file.hpp"

namespace cases {
namespace {

/// A member of what acts of a load: `member` finds it where the load has it. For a load without it, it is `nothing`,
/// and what is read goes nowhere: its kind is unknown.
template <class U, class Member>
class OfAction {
public:
  OfAction(U nothing, Member member) : nothing_(std::move(nothing)), member_(member) {}

  U& operator()(plate::Load& load) const { return in<U>(load.action); }
  const U& operator()(const plate::Load& load) const { return in<const U>(load.action); }

private:
  template <class V, class Action>
  V& in(Action& action) const {
    static thread_local std::remove_const_t<V> nowhere;
    nowhere = nothing_;
    V* found = &nowhere;
    std::visit(
        [&](auto& one) {
          if constexpr (std::is_invocable_v<Member, decltype(one)>) found = &member_(one);
        },
        action);
    return *found;
  }

  U nothing_;
  Member member_;
};

/// Names of edges: a list that is not empty and names none twice.
template <class T, class Project>
Field<T> edges(const std::string& help, Project project) {
  return value<T>(
      {"edges", "-", "a list of edge names", "", help},
      [=](const Value& given, T& object) {
        const auto names = given.texts();
        if (!names) return;
        if (names->empty()) given.refuse("a list of at least one edge name");
        std::unordered_set<std::string> before;
        for (const auto& name : *names)
          if (!before.insert(name).second) given.report_error(fmt::format("\"{}\" is named twice", name));
        std::invoke(project, object) = *names;
      },
      [=](const T& object) {
        const auto& names = std::invoke(project, object);
        return names.empty() ? "" : text_of(names);
      });
}
template <class T>
Field<T> edges(const std::string& help) {
  return edges<T>(help, &T::edges);
}

/// A list of at least some points.
template <class T, class Project>
Field<T> points(const std::string& name, Project project, std::size_t least, const std::string& help) {
  const auto read = [=](const Value& given, T& object) {
    const auto points = given.points();
    if (points && points->size() < least) given.refuse(fmt::format("a list of {} points or more", least));
    if (points) std::invoke(project, object) = *points;
  };
  const auto text = [=](const T& object) {
    const auto& points = std::invoke(project, object);
    return points.empty() ? "" : text_of(points);
  };
  return value<T>({name, "length", "[[x, y], ...]", "", help}, read, text);
}

}  // namespace

Fields<plate::Foundation> foundation_fields() {
  using F = plate::Foundation;
  return {
      number<F>("modulus", "force/length^3", &F::modulus, positive, "what w is answered with (Winkler)").required(),
      number<F>("shear", "force/length", &F::shear, {0}, "the shear layer on top of it (Pasternak)"),
      table<F, geometry::Hole>("on", Layout::inline_, &F::patch,
                               hole_fields("the disc that lies on the foundation, without it the plate",
                                           "the polygon that lies on the foundation, without it the plate"),
                               check_hole),
      boolean<F>("lifts_off", &F::unilateral,
                 "the plate may lift off: it is pressed along w where w < 0, and nowhere pulled"),
  };
}

namespace {

/// Numbers of cracks, ascending.
Field<plate::Spring> spring_cracks() {
  return value<plate::Spring>(
      {"cracks", "-", "a list of numbers of cracks, from 0", "", "the cracks whose faces springs tie"},
      [](const Value& given, plate::Spring& spring) {
        const auto elements = given.elements("a list of numbers of cracks, from 0");
        for (const auto& element : elements) {
          const auto number = element.number();
          if (!number) return;
          if (*number < 0 || *number != std::floor(*number)) return element.refuse("a number of a crack, from 0");
          spring.cracks.push_back(std::size_t(*number));
        }
        if (elements.empty() && given.reading().sound(given.key()))
          given.refuse("a list of at least one number of a crack");
      },
      [](const plate::Spring& s) { return s.cracks.empty() ? "" : fmt::format("[{}]", fmt::join(s.cracks, ", ")); });
}

Field<plate::Spring> spring_depth() {
  return value<plate::Spring>(
      {"depth", "length", "a number or an expression in x, y and pi", "",
       "cracks, instead of stiffnesses: they go through this part of the thickness"},
      [](const Value& given, plate::Spring& spring) {
        if (given.is_text()) {
          if (const auto formula = formula_of(given)) spring.depth = *formula;
        } else if (const auto depth = given.number()) {
          if (*depth > 0)
            spring.depth = plate::Formula(number_text(*depth));
          else
            given.refuse("a number > 0 or an expression in x, y and pi");
        }
      },
      [](const plate::Spring& s) { return s.depth.given() ? quoted(s.depth.text()) : ""; });
}

}  // namespace

Fields<plate::Spring> spring_fields() {
  using S = plate::Spring;
  const auto position = value<S>(
      {"position", "length", "[x, y] in the plate", "", "where one spring stands"},
      [](const Value& given, S& spring) { spring.position = given.point(); },
      [](const S& s) { return s.position ? text_of(*s.position) : ""; });
  return {
      edges<S>("the edges that springs hold: these, along, position or cracks"),
      points<S>("along", &S::along, 2, "a line in the plate that springs hold"),
      position,
      spring_cracks(),
      number<S>("deflection", "force/length^2, at a position force/length", &S::deflection, {0},
                "against w, on cracks against what parts the faces along w"),
      number<S>("rotation_normal", "force", &S::rotation_normal, {0},
                "edges, along, cracks: against the rotation along the normal, with which the plate bends"),
      number<S>("rotation_tangential", "force", &S::rotation_tangential, {0},
                "edges, along, cracks: against the rotation along the edge or line, with which the plate twists"),
      number<S>("rotation", "force length", &S::rotation, {0}, "position: against both rotations"),
      number<S>("opening", "force/length^2", &S::opening, {0}, "cracks: in the plane, against opening"),
      number<S>("sliding", "force/length^2", &S::sliding, {0}, "cracks: in the plane, against sliding"),
      spring_depth(),
      choice<S, bool>("from", &S::from_below, {{{"above", false}, {"below", true}}},
                      "depth: the face that the crack begins at, z = h/2 or z = -h/2"),
  };
}

Fields<plate::Stiffener> stiffener_fields() {
  using S = plate::Stiffener;
  return {
      edges<S>("the edges that the beam runs along: these or along"),
      points<S>("along", &S::along, 2, "the line in the plate that the beam runs along"),
      number<S>("bending", "force length^2", &S::bending, {0}, "EI, against the curvature along the beam"),
      number<S>("torsion", "force length^2", &S::torsion, {0}, "GJ, against the twist along the beam"),
      number<S>("shear", "force", &S::shear, positive, "k G A; without it the beam does not shear"),
      number<S>("mass", "mass/length", &S::mass, {0}, "of the beam: in motion, frequencies and own weight"),
      number<S>("axial", "force", &S::axial, {0}, "EA, against the strain along the beam"),
      number<S>("eccentricity", "length", &S::eccentricity, {},
                "z of the axis of the beam, which couples bending and stretching; needs axial"),
  };
}

namespace {

using plate::BodyForce;
using plate::EdgeMoment;
using plate::EdgeShear;
using plate::EdgeTraction;
using plate::History;
using plate::InPlane;
using plate::LineLoad;
using plate::Load;
using plate::PointForce;
using plate::Pressure;
using plate::Push;
using plate::Settlement;
using plate::Support;
using plate::SupportKind;
using plate::Temperature;

const Words<SupportKind> support_kinds{{{"clamped", SupportKind::clamped},
                                        {"simply_supported", SupportKind::simply_supported},
                                        {"simply_supported_hard", SupportKind::simply_supported_hard},
                                        {"symmetry", SupportKind::symmetry},
                                        {"free", SupportKind::free},
                                        {"clamped_layer", SupportKind::clamped_layer},
                                        {"simply_supported_layer", SupportKind::simply_supported_layer},
                                        {"simply_supported_hard_layer", SupportKind::simply_supported_hard_layer},
                                        {"pinned", SupportKind::pinned},
                                        {"in_plane", SupportKind::in_plane},
                                        {"hub", SupportKind::hub}}};

const Words<InPlane> in_plane_words{{{"free", InPlane::free},
                                     {"fixed", InPlane::fixed},
                                     {"normal", InPlane::normal},
                                     {"tangential", InPlane::tangential},
                                     {"x", InPlane::x},
                                     {"y", InPlane::y}}};

const Words<Push> push_words{{{"up", Push::up}, {"down", Push::down}}};

Words<Load::Action> load_kinds() {
  Words<Load::Action> result;
  for (const auto& action : Load::kinds()) result.allowed.emplace_back(Load{action}.name(), action);
  return result;
}

const Words<History::Kind> history_words{
    {{"step", History::Kind::step}, {"ramp", History::Kind::ramp}, {"sine", History::Kind::sine}}};

template <class... Actions>
bool is(const Load& load) {
  return (std::holds_alternative<Actions>(load.action) || ...);
}

/// Keys of loads of certain kinds.
template <class... Actions>
Condition<Load> kind_is() {
  return {"kind", fmt::format("kind = {}", fmt::join({Actions::name...}, " or ")), is<Actions...>};
}

Condition<Load> history_is(History::Kind kind) {
  return {"history", "history = " + history_words.name(kind),
          [kind](const Load& load) { return load.history.kind == kind; }};
}

void read_history(const Value& given, Load& load) {
  if (given.is_text()) {
    const auto kind = history_words.find(given, *given.text());
    if (kind) load.history.kind = *kind;
    return;
  }
  const auto rows = given.points();
  if (!rows) return;
  if (rows->empty())
    return given.refuse(history_words.text() + " or a table [[time, factor], ...] of at least one row");
  for (std::size_t i = 1; i < rows->size(); ++i)
    if (!((*rows)[i - 1].x() < (*rows)[i].x()))
      return given.report_error(
          fmt::format("time {} after {} given, times must ascend", (*rows)[i].x(), (*rows)[i - 1].x()));
  load.history.kind = History::Kind::table;
  for (const auto& row : *rows) load.history.table.emplace_back(row.x(), row.y());
}

std::string history_text(const Load& load) {
  if (load.history.kind != History::Kind::table) return quoted(history_words.name(load.history.kind));
  std::vector<geometry::Point> rows;
  for (const auto& [time, factor] : load.history.table) rows.emplace_back(time, factor);
  return text_of(rows);
}

// members that loads of several kinds have
const auto value_of = OfAction(double{}, [](auto& one) -> decltype((one.value)) { return one.value; });
const auto twist_of = OfAction(double{}, [](auto& one) -> decltype((one.twist)) { return one.twist; });
const auto tensor_of =
    OfAction(std::optional<std::array<double, 3>>{}, [](auto& one) -> decltype((one.tensor)) { return one.tensor; });
const auto gravity_of =
    OfAction(std::optional<double>{}, [](auto& one) -> decltype((one.gravity)) { return one.gravity; });
const auto level_of = OfAction(std::optional<double>{}, [](auto& one) -> decltype((one.level)) { return one.level; });
const auto gradient_of =
    OfAction(geometry::Point(0, 0), [](auto& one) -> decltype((one.gradient)) { return one.gradient; });
const auto from_of = OfAction(geometry::Point(0, 0), [](auto& one) -> decltype((one.from)) { return one.from; });
const auto position_of =
    OfAction(geometry::Point(0, 0), [](auto& one) -> decltype((one.position)) { return one.position; });
const auto slope_of = OfAction(geometry::Point(0, 0), [](auto& one) -> decltype((one.slope)) { return one.slope; });
const auto patch_of =
    OfAction(std::optional<geometry::Hole>{}, [](auto& one) -> decltype((one.patch)) { return one.patch; });
const auto along_of = OfAction(geometry::Polyline{}, [](auto& one) -> decltype((one.along)) { return one.along; });
const auto path_of = OfAction(geometry::Polyline{}, [](auto& one) -> decltype((one.path)) { return one.path; });
const auto speed_of = OfAction(double{}, [](auto& one) -> decltype((one.speed)) { return one.speed; });
const auto edges_of =
    OfAction(std::vector<std::string>{}, [](auto& one) -> decltype((one.edges)) { return one.edges; });
const auto formula_in = OfAction(plate::Formula{}, [](auto& one) -> decltype((one.formula)) { return one.formula; });
const auto support_of = OfAction(std::size_t{}, [](auto& one) -> decltype((one.support)) { return one.support; });
const auto shear_of = OfAction(double{}, [](auto& one) -> decltype((one.shear)) { return one.shear; });
const auto vector_of = OfAction(geometry::Point(0, 0), [](auto& one) -> decltype((one.vector)) { return one.vector; });
const auto rotation_of = OfAction(double{}, [](auto& one) -> decltype((one.rotation)) { return one.rotation; });

const auto table_of = OfAction(plate::PressureTable{}, [](auto& one) -> decltype((one.table)) { return one.table; });

Field<Load> tensor() {
  return value<Load>(
      {"tensor", "force, force/length", "[Mxx, Myy, Mxy]", "",
       "moments, or membrane forces Nxx, Nyy, Nxy, of a uniform field on the edges, instead of value, twist and shear"},
      [](const Value& given, Load& load) {
        const auto moments = given.numbers(3, "[Mxx, Myy, Mxy]");
        if (moments) tensor_of(load) = {(*moments)[0], (*moments)[1], (*moments)[2]};
      },
      [](const Load& load) {
        const auto& tensor = tensor_of(load);
        return tensor ? text_of_numbers(*tensor) : "";
      });
}

template <class Project>
Field<Load> point(const std::string& name, const std::string& unit, Project project, const std::string& allowed,
                  const std::string& help) {
  const auto read = [=](const Value& given, Load& load) {
    if (const auto found = given.point()) project(load) = *found;
  };
  return value<Load>({name, unit, allowed, "", help}, read, [=](const Load& load) { return text_of(project(load)); });
}

}  // namespace

std::optional<plate::Formula> formula_of(const Value& given) {
  const auto text = given.text();
  if (!text) return std::nullopt;
  auto found = plate::Formula::parsed(*text);
  if (auto* formula = std::get_if<plate::Formula>(&found)) return std::move(*formula);
  given.report_error(std::get<std::string>(found));
  return std::nullopt;
}

namespace {

Field<Load> expression() {
  return value<Load>(
      {"expression", "force/length^2, temperature", "an expression in x, y and pi", "",
       "the pressure or temperature, as \"100 * sin(pi * x / 2)\""},
      [](const Value& given, Load& load) {
        if (const auto formula = formula_of(given)) formula_in(load) = *formula;
      },
      [](const Load& load) { return load.formula().given() ? quoted(load.formula().text()) : ""; });
}

/// The mean of a temperature: a number, or an expression in x and y.
Field<Load> mean() {
  return value<Load>(
      {"mean", "temperature", "a number or an expression in x, y and pi", "",
       "temperature of the middle plane above that without stress; it acts in the plane"},
      [](const Value& given, Load& load) {
        auto* heat = load.as<Temperature>();
        if (!heat) return;
        if (given.is_text()) {
          if (const auto formula = formula_of(given)) heat->mean_formula = *formula;
        } else {
          heat->mean = given.number().value_or(0);
        }
      },
      [](const Load& load) {
        const auto* heat = load.as<Temperature>();
        if (!heat || !load.in_plane()) return std::string();
        return heat->mean_formula.given() ? quoted(heat->mean_formula.text()) : number_text(heat->mean);
      });
}

/// Reads a table of pressures, or says why it cannot be read or is none.
std::variant<plate::PressureTable, std::string> read_table(const std::filesystem::path& path) {
  constexpr std::size_t most = 256 << 20;  // bytes
  try {
    if (std::filesystem::is_directory(path)) return "cannot be read";
    return plate::PressureTable::parsed(post::read_text(path, most), path);
  } catch (const std::length_error& error) {
    return error.what();
  } catch (const std::filesystem::filesystem_error&) {
    return "cannot be read";
  }
}

/// A file of pressures beside the case, and what it said when the case was resolved.
Field<Load> table_field() {
  return value<Load>(
      {"table", "-", "a CSV file with the columns x, y, pressure", "",
       "the pressure at places, sought beside the case: bilinear on a grid, else linear on triangles"},
      [](const Value& given, Load& load) {
        const auto text = given.text();
        if (!text) return;
        auto found = read_table(given.reading().folder / *text);
        if (const auto* error = std::get_if<std::string>(&found))
          given.report_error(fmt::format("\"{}\": {}", *text, *error));
        else
          table_of(load) = std::get<plate::PressureTable>(std::move(found));
      },
      [](const Load& load) {
        const auto& table = table_of(load);
        return table.given() ? quoted(table.file().string()) : "";
      });
}

Field<Load> table_digest_field() {
  return value<Load>(
      {"table_digest", "-", "16 digits", "", "of what the table says; where given, another table is refused"},
      [](const Value& given, Load& load) {
        const auto text = given.text();
        const auto& table = table_of(load);
        if (text && table.given() && *text != table.digest())
          given.report_error(fmt::format("{} given, but the table has {}: it is another one", *text, table.digest()));
      },
      [](const Load& load) {
        const auto& table = table_of(load);
        return table.given() ? quoted(table.digest()) : "";
      });
}

Field<Load> load_kind() {
  const auto words = load_kinds();
  return value<Load>(
             {"kind", "-", "one of " + words.text(), "", "what acts; see \"Loads\" and \"Signs\""},
             [words](const Value& given, Load& load) {
               const auto text = given.text();
               if (const auto found = text ? words.find(given, *text) : std::nullopt) load.action = *found;
             },
             [](const Load& load) { return quoted(load.name()); })
      .required();
}

/// A value or twist: absent from what is written where a tensor replaces it.
template <class Project>
Field<Load> amount(const std::string& name, const std::string& unit, Project project, const std::string& help) {
  auto field = number<Load>(name, unit, project, finite, help);
  field.write = [write = field.write](const Load& load, Analysis::Kind kind) {
    return tensor_of(load) ? std::string() : write(load, kind);
  };
  return field;
}

}  // namespace

Fields<Support> support_fields() {
  const Condition<Support> of_edges{"kind", "a kind other than pinned",
                                    [](const Support& s) { return s.kind != SupportKind::pinned; }};
  const Condition<Support> inside{"kind", "kind = pinned, clamped or in_plane", [](const Support& s) {
                                    using enum SupportKind;
                                    return s.kind == pinned || s.kind == clamped || s.kind == in_plane;
                                  }};
  const Condition<Support> hub{"kind", "kind = hub", [](const Support& s) { return s.kind == SupportKind::hub; }};
  const Condition<Support> holds_w_alone{
      "kind", "kind = simply_supported or pinned",
      [](const Support& s) { return s.kind == SupportKind::simply_supported || s.kind == SupportKind::pinned; }};
  const Condition<Support> part{"kind", "kind = pinned, clamped, in_plane or hub",
                                [inside, hub](const Support& s) { return inside.holds(s) || hub.holds(s); }};
  return {
      choice<Support, SupportKind>("kind", &Support::kind, support_kinds, "how the edge is held; see \"Supports\"")
          .required(),
      edges<Support>("the edges that are held, each by one support").with(of_edges),
      points<Support>("points", &Support::points, 1, "points in the plate or on its boundary that are held")
          .with(inside),
      points<Support>("along", &Support::along, 2, "a line in the plate that is held").with(inside),
      table<Support, geometry::Hole>(
          "on", Layout::inline_, &Support::patch,
          hole_fields("the disc of the plate that is held", "the polygon of the plate that is held"), check_hole)
          .with(part),
      number<Support>("k_w", "force/length", &Support::k_w, positive,
                      "stiffness under w of the centre; absent is rigid")
          .with(hub),
      number<Support>("k_phi", "force length/rad", &Support::k_phi, {0},
                      "stiffness against the turn; 0 is free to turn, absent does not turn")
          .with(hub),
      value<Support>(
          {"in_plane", "-", "one of " + in_plane_words.text(), "free, of kind symmetry normal, of kind in_plane fixed",
           "which displacements are held in the plane: both, of edges that along the normal or the edge, of points, "
           "lines and parts u (\"x\") or v (\"y\")"},
          [](const Value& given, Support& support) {
            if (const auto text = given.text()) support.in_plane = in_plane_words.find(given, *text);
          },
          [](const Support& s) { return s.in_plane ? quoted(in_plane_words.name(*s.in_plane)) : ""; }),
      value<Support>(
          {"pushes", "-", "one of " + push_words.text(), "",
           "the plate may lift off: the support stands below and pushes along w (\"up\"), or above (\"down\"); absent "
           "holds both ways"},
          [](const Value& given, Support& support) {
            if (const auto text = given.text()) support.push = push_words.find(given, *text).value_or(support.push);
          },
          [](const Support& s) { return s.push == Push::both_ways ? "" : quoted(push_words.name(s.push)); })
          .with(holds_w_alone),
  };
}

namespace {

/// Fields for the kind and the amount of a load.
Fields<Load> amount_fields() {
  const auto valued = [](const Load& load) {
    const auto* pressure = load.as<Pressure>();
    return !is<BodyForce>(load) && !load.formula().given() &&
           !(pressure && (pressure->table.given() || pressure->gravity));
  };
  const Condition<Load> with_value{"kind", "kind = pressure with a value",
                                   [valued](const Load& load) { return is<Pressure>(load) && valued(load); }};
  const Condition<Load> by_value{"kind", "kind = pressure with a value, without level", [valued](const Load& load) {
                                   return is<Pressure>(load) && valued(load) && !load.as<Pressure>()->level;
                                 }};
  const Condition<Load> from_somewhere{
      "kind", "kind = pressure with a value, without level, or settlement",
      [by_value](const Load& load) { return by_value.holds(load) || is<Settlement>(load); }};
  return {
      load_kind(),
      expression().with(kind_is<Pressure, Temperature>()),
      mean().with(kind_is<Temperature>()),
      table_field().with({"kind", "kind = pressure without expression",
                          [](const Load& load) { return is<Pressure>(load) && !load.formula().given(); }}),
      table_digest_field().with(
          {"table", "table",
           [](const Load& load) { return is<Pressure>(load) && load.as<Pressure>()->table.given(); }}),
      number<Load>("gravity", "length/time^2", gravity_of, finite,
                   "own weight: the pressure is density thickness gravity, along w")
          .with({"kind", "kind = pressure without expression and table",
                 [](const Load& load) { return is<Pressure>(load) && !load.as<Pressure>()->evaluated(); }}),
      amount("value", "force/length^2, force, force/length, force/length, force, force/length, temperature, length",
             value_of,
             "pressure, edge moment per length, edge shear per length, edge traction N_nn, point force along w, force "
             "per length of a line, temperature of the face z > 0 less that of the other, deflection of a support")
          .with({"kind", "neither body_force, expression, table nor gravity", valued})
          .standard("required without tensor, vector, expression, mean, table and gravity"),
      point("vector", "force/length^2, force", vector_of, "[x, y]", "the force in the plane")
          .with({"kind", "kind = body_force or point_force without path",
                 [](const Load& load) { return is<BodyForce>(load) || (is<PointForce>(load) && !load.moves()); }}),
      number<Load>("level", "length", level_of, finite,
                   "the y up to which a fluid stands: the pressure is value, its unit weight, times level - y below")
          .with(with_value),
      point("gradient", "force/length^3", gradient_of, "[x, y]", "what the pressure grows by along x and y")
          .with(by_value),
      point("from", "length", from_of, "[x, y]", "where the pressure or the deflection of the support has its value")
          .with(from_somewhere),
  };
}

/// Keys of the place where a load acts.
Fields<Load> place_fields() {
  return {
      table<Load, geometry::Hole>("on", Layout::inline_, patch_of,
                                  hole_fields("the disc that the pressure acts on, without it the plate",
                                              "the polygon that the pressure acts on, without it the plate"),
                                  check_hole)
          .with(kind_is<Pressure>()),
      points<Load>("along", along_of, 2, "the line that the load acts along").required().with(kind_is<LineLoad>()),
      edges<Load>("the edges that are loaded", edges_of)
          .required()
          .with(kind_is<EdgeMoment, EdgeShear, EdgeTraction>()),
      amount("twist", "force", twist_of, "twisting moment M_ns beside value, s = normal turned by +90 degrees")
          .with(kind_is<EdgeMoment>()),
      amount("shear", "force/length", shear_of, "edge traction N_ns beside value, s = normal turned by +90 degrees")
          .with(kind_is<EdgeTraction>()),
      tensor().with(kind_is<EdgeMoment, EdgeTraction>()),
      points<Load>("path", path_of, 2, "where the force, or with \"on\" the pressure from its place on, moves along")
          .in_dynamics()
          .with(kind_is<PointForce, Pressure>()),
      number<Load>("speed", "length/time", speed_of, positive, "with which it moves; at its end it leaves the plate")
          .required({Analysis::Kind::dynamic})
          .in_dynamics()
          .with({"path", "path", [](const Load& load) { return load.moves(); }}),
      point("position", "length", position_of, "[x, y] inside the plate", "where the force acts")
          .required()
          .with({"kind", "kind = point_force without path",
                 [](const Load& load) { return is<PointForce>(load) && !load.moves(); }}),
  };
}

Fields<Load> settlement_fields() {
  return {
      number<Load>("support", "-", support_of, {0, 1e6}, "the number of the support that moves, the first is 0")
          .required()
          .with(kind_is<Settlement>()),
      point("slope", "-", slope_of, "[x, y]", "what its deflection grows by along x and y, as of a rigid body")
          .with(kind_is<Settlement>()),
      number<Load>("rotation", "-", rotation_of, finite,
                   "psi_n, by which its edges turn about themselves, n the outer normal")
          .with(kind_is<Settlement>()),
  };
}

Field<Load> constant() {
  return value<Load>(
             {"constant", "-", "true or false", "false",
              "with nonlinear = true: it acts in full before other loads grow, and beside them"},
             [](const Value& given, Load& load) {
               if (given.boolean().value_or(false)) load.history.kind = History::Kind::constant;
             },
             [](const Load& load) { return load.history.kind == History::Kind::constant ? "true" : ""; })
      .in({Analysis::Kind::static_});
}

Fields<Load> history_fields() {
  const auto rise_time = [](auto& load) -> auto& {
    return load.history.rise_time;
  };
  const auto frequency = [](auto& load) -> auto& {
    return load.history.frequency;
  };
  return {
      constant(),
      value<Load>({"history", "-", history_words.text() + " or a table [[time, factor], ...]", "",
                   "factor in time; a table is linear between its rows and constant beyond them"},
                  read_history, history_text)
          .in_dynamics(),
      number<Load>("rise_time", "time", rise_time, positive, "time from 0 to the full value")
          .required()
          .with(history_is(History::Kind::ramp))
          .in_dynamics(),
      number<Load>("frequency", "1/time", frequency, positive, "sin(2 pi frequency time)")
          .required()
          .with(history_is(History::Kind::sine))
          .in_dynamics(),
  };
}

}  // namespace

Fields<Load> load_fields() {
  auto result = amount_fields();
  for (const auto& more : {place_fields(), settlement_fields(), history_fields()})
    result.insert(result.end(), more.begin(), more.end());
  return result;
}

void check_load(const Value& given, Load& load) {
  auto& reading = given.reading();
  const auto has = [&](const char* name) { return reading.given(given.below(name)); };
  if (is<BodyForce>(load) && !has("vector")) reading.report_error(given.below("vector"), "is missing, must be [x, y]");
  if (has("vector") && !has("value") && vector_of(load) == geometry::Point(0, 0) &&
      reading.sound(given.below("vector")))
    reading.report_error(given.below("vector"), "is zero: nothing acts");
  if (has("mean") && !has("value") && !has("expression") && !load.in_plane() && reading.sound(given.below("mean")))
    reading.report_error(given.below("mean"), "is zero: nothing acts");
  const auto amounts = {"value", "tensor", "vector", "expression", "mean", "gravity", "table"};
  if (!is<BodyForce>(load) && std::ranges::none_of(amounts, has))
    reading.report_error(given.below("value"), "is missing, must be a finite number");
  for (const char* name : {"value", "twist", "shear"})
    if (tensor_of(load) && reading.given(given.below(name)))
      reading.report_error(given.below(name),
                           fmt::format("'{}' is given beside 'tensor', which replaces it: remove one of them", name));
}

namespace {

template <class T>
Field<T> name_of(const std::string& help) {
  return value<T>(
             {"name", "-", "letters, digits, _ and -", "", help},
             [](const Value& given, T& object) {
               object.name = given.text().value_or("");
               if (given.is_text() && !bare(object.name)) given.refuse("letters, digits, _ and - only");
             },
             [](const T& object) { return object.name.empty() ? "" : quoted(object.name); })
      .required();
}

}  // namespace

Fields<plate::LoadCase> load_case_fields() {
  using C = plate::LoadCase;
  return {
      name_of<C>("of the load case, in results and combinations"),
      tables<C, plate::Load>("load", Layout::inline_, &C::loads, load_fields(), check_load),
  };
}

Fields<plate::Combination> combination_fields() {
  using C = plate::Combination;
  const auto read = [](const Value& given, C& combination) {
    const auto* entries = given.table();
    if (!entries) return;
    for (const auto& [name, node] : *entries) {
      const Value factor(node, given.below(std::string(name.str())), given.reading());
      if (const auto x = factor.number()) combination.of.emplace_back(name.str(), *x);
    }
  };
  const auto write = [](const C& combination) {
    std::vector<std::string> texts;
    for (const auto& [name, factor] : combination.of) texts.push_back(name + " = " + number_text(factor));
    return texts.empty() ? "" : fmt::format("{{ {} }}", fmt::join(texts, ", "));
  };
  return {
      name_of<C>("of the combination, in results"),
      value<C>({"of", "-", "{ name = factor, ... }", "", "what every load case counts for: the states add up"}, read,
               write)
          .required(),
  };
}

namespace {

/// A number, or an expression in x and y.
Field<plate::Initial> anywhere(const std::string& name, const std::string& unit, plate::Formula plate::Initial::*member,
                               const std::string& help) {
  return value<plate::Initial>(
      {name, unit, "a number or an expression in x, y and pi", "", help},
      [member](const Value& given, plate::Initial& initial) {
        const auto text = given.is_text() ? given.text() : std::nullopt;
        const auto number = text ? std::nullopt : given.number();
        if (!text && !number) return;
        auto found = plate::Formula::parsed(text ? *text : number_text(*number));
        if (const auto* error = std::get_if<std::string>(&found))
          given.report_error(*error);
        else
          initial.*member = std::get<plate::Formula>(std::move(found));
      },
      [member](const plate::Initial& initial) {
        return (initial.*member).given() ? quoted((initial.*member).text()) : "";
      });
}

}  // namespace

Fields<plate::Initial> initial_fields() {
  using I = plate::Initial;
  return {anywhere("deflection", "length", &I::deflection, "w at time 0, as \"0.01 * sin(pi * x) * sin(pi * y)\""),
          anywhere("velocity", "length/time", &I::velocity, "velocity along w at time 0")};
}

Fields<plate::Impact> impact_fields() {
  using I = plate::Impact;
  return {value<I>(
              {"position", "length", "[x, y] inside the plate", "", "where the mass meets the plate"},
              [](const Value& given, I& impact) { impact.position = given.point().value_or(impact.position); },
              [](const I& impact) { return text_of(impact.position); })
              .required({Analysis::Kind::dynamic}),
          number<I>("mass", "mass", &I::mass, positive, "of what hits the plate").required({Analysis::Kind::dynamic}),
          number<I>("velocity", "length/time", &I::velocity, finite, "along w, as it meets the plate at time 0")
              .required({Analysis::Kind::dynamic}),
          number<I>("stiffness", "force/length", &I::stiffness, positive,
                    "of the contact: a spring that does not pull, so that the mass may lift off")
              .required({Analysis::Kind::dynamic})};
}

}  // namespace cases
