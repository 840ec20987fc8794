#include "cases/input/load_keys.hpp"

#include "cases/input/keys.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/supports.hpp"

namespace cases {

Fields<plate::Foundation> foundation_fields() {
  using F = plate::Foundation;
  return {
      number<F>("modulus", "force/length^3", &F::modulus, positive, "what w is answered with (Winkler)").required(),
      number<F>("shear", "force/length", &F::shear, {0}, "the shear layer on top of it (Pasternak)"),
      table<F, geometry::Hole>("on", Layout::inline_, &F::patch,
                               hole_fields("the disc that lies on the foundation, without it the plate",
                                           "the polygon that lies on the foundation, without it the plate"),
                               check_hole),
      value<F>(
          {"lifts_off", "-", "true or false", "false",
           "the plate may lift off: it is pressed along w where w < 0, and nowhere pulled"},
          [](const Value& given, F& f) { f.lifts_off = given.boolean().value_or(false); },
          [](const F& f) { return std::string(f.lifts_off ? "true" : "false"); }),
  };
}

Fields<plate::Spring> spring_fields() {
  using S = plate::Spring;
  const auto position = value<S>(
      {"position", "length", "[x, y] in the plate", "", "where one spring stands"},
      [](const Value& given, S& spring) { spring.position = given.point(); },
      [](const S& s) { return s.position ? text_of(*s.position) : ""; });
  return {
      edges<S>("the edges that springs hold: these, along or position"),
      points("along", &S::along, 2, "a line in the plate that springs hold"),
      position,
      number<S>("deflection", "force/length^2, at a position force/length", &S::deflection, {0}, "against w"),
      number<S>("rotation_normal", "force", &S::rotation_normal, {0},
                "edges, along: against the rotation along the normal, with which the plate bends"),
      number<S>("rotation_tangential", "force", &S::rotation_tangential, {0},
                "edges, along: against the rotation along the edge or line, with which the plate twists"),
      number<S>("rotation", "force length", &S::rotation, {0}, "position: against both rotations"),
  };
}

Fields<plate::Stiffener> stiffener_fields() {
  using S = plate::Stiffener;
  return {
      edges<S>("the edges that the beam runs along: these or along"),
      points("along", &S::along, 2, "the line in the plate that the beam runs along"),
      number<S>("bending", "force length^2", &S::bending, {0}, "EI, against the curvature along the beam"),
      number<S>("torsion", "force length^2", &S::torsion, {0}, "GJ, against the twist along the beam"),
      number<S>("shear", "force", &S::shear, positive, "k G A; without it the beam does not shear"),
      number<S>("mass", "mass/length", &S::mass, {0}, "of the beam: in motion, frequencies and own weight"),
  };
}

namespace {

using plate::History;
using plate::Load;
using plate::Support;
using plate::SupportKind;

const Words<SupportKind> support_kinds{{{"clamped", SupportKind::clamped},
                                        {"simply_supported", SupportKind::simply_supported},
                                        {"simply_supported_hard", SupportKind::simply_supported_hard},
                                        {"symmetry", SupportKind::symmetry},
                                        {"free", SupportKind::free},
                                        {"clamped_layer", SupportKind::clamped_layer},
                                        {"simply_supported_layer", SupportKind::simply_supported_layer},
                                        {"simply_supported_hard_layer", SupportKind::simply_supported_hard_layer},
                                        {"pinned", SupportKind::pinned}}};

const Words<Load::Kind> load_kinds{{{"pressure", Load::Kind::pressure},
                                    {"edge_moment", Load::Kind::edge_moment},
                                    {"edge_shear", Load::Kind::edge_shear},
                                    {"point_force", Load::Kind::point_force},
                                    {"line_load", Load::Kind::line_load},
                                    {"temperature", Load::Kind::temperature},
                                    {"settlement", Load::Kind::settlement}}};

const Words<History::Kind> history_words{
    {{"step", History::Kind::step}, {"ramp", History::Kind::ramp}, {"sine", History::Kind::sine}}};

/// Keys of loads of certain kinds.
Condition<Load> kind_is(std::vector<Load::Kind> kinds) {
  std::vector<std::string> names;
  for (const auto kind : kinds) names.push_back(load_kinds.name(kind));
  return {"kind", fmt::format("kind = {}", fmt::join(names, " or ")),
          [kinds](const Load& load) { return std::find(kinds.begin(), kinds.end(), load.kind) != kinds.end(); }};
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
      return given.complain(
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

Field<Load> tensor() {
  return value<Load>(
      {"tensor", "force", "[Mxx, Myy, Mxy]", "", "moments of a uniform field on the edges, instead of value and twist"},
      [](const Value& given, Load& load) {
        const auto moments = given.numbers(3, "[Mxx, Myy, Mxy]");
        if (!moments) return;
        load.tensor = {(*moments)[0], (*moments)[1], (*moments)[2]};
        load.has_tensor = true;
      },
      [](const Load& load) {
        if (!load.has_tensor) return std::string();
        return fmt::format("[{}, {}, {}]", number_text(load.tensor[0]), number_text(load.tensor[1]),
                           number_text(load.tensor[2]));
      });
}

Field<Load> point(const std::string& name, const std::string& unit, geometry::Point Load::*member,
                  const std::string& allowed, const std::string& help) {
  const auto read = [member](const Value& given, Load& load) { load.*member = given.point().value_or(load.*member); };
  return value<Load>({name, unit, allowed, "", help}, read, [=](const Load& load) { return text_of(load.*member); });
}

}  // namespace

std::optional<plate::Formula> formula_of(const Value& given) {
  if (const auto text = given.text()) try {
      return plate::Formula(*text);
    } catch (const std::invalid_argument& error) {
      given.complain(error.what());
    }
  return std::nullopt;
}

namespace {

Field<Load> expression() {
  return value<Load>(
      {"expression", "force/length^2, temperature", "an expression in x, y and pi", "",
       "the pressure or temperature, as \"100 * sin(pi * x / 2)\""},
      [](const Value& given, Load& load) {
        if (const auto formula = formula_of(given)) load.formula = *formula;
      },
      [](const Load& load) { return load.formula.given() ? quoted(load.formula.text()) : ""; });
}

/// A value or twist: absent from what is written where a tensor replaces it.
Field<Load> amount(const std::string& name, const std::string& unit, double Load::*member, const std::string& help) {
  auto field = number<Load>(name, unit, member, finite, help);
  field.write = [write = field.write](const Load& load, Analysis::Kind kind) {
    return load.has_tensor ? std::string() : write(load, kind);
  };
  return field;
}

}  // namespace

Fields<Support> support_fields() {
  const Condition<Support> of_edges{"kind", "a kind other than pinned",
                                    [](const Support& s) { return s.kind != SupportKind::pinned; }};
  const Condition<Support> inside{"kind", "kind = pinned or clamped", [](const Support& s) {
                                    return s.kind == SupportKind::pinned || s.kind == SupportKind::clamped;
                                  }};
  return {
      choice<Support, SupportKind>("kind", &Support::kind, support_kinds, "how the edge is held; see \"Supports\"")
          .required(),
      edges<Support>("the edges that are held, each by one support").with(of_edges),
      points("points", &Support::points, 1, "points in the plate or on its boundary that are held").with(inside),
      points("along", &Support::along, 2, "a line in the plate that is held").with(inside),
      table<Support, geometry::Hole>(
          "on", Layout::inline_, &Support::patch,
          hole_fields("the disc of the plate that is held", "the polygon of the plate that is held"), check_hole)
          .with(inside),
  };
}

namespace {

/// Fields for the kind and the amount of a load.
Fields<Load> amount_fields() {
  using enum Load::Kind;
  const auto valued = [](const Load& load) { return !load.evaluated() && !load.gravity; };
  const Condition<Load> with_value{"kind", "kind = pressure with a value",
                                   [valued](const Load& load) { return load.kind == pressure && valued(load); }};
  const Condition<Load> by_value{"kind", "kind = pressure with a value, without level", [valued](const Load& load) {
                                   return load.kind == pressure && valued(load) && !load.level;
                                 }};
  const Condition<Load> from_somewhere{
      "kind", "kind = pressure with a value, without level, or settlement",
      [by_value](const Load& load) { return by_value.holds(load) || load.kind == settlement; }};
  return {
      choice<Load, Load::Kind>("kind", &Load::kind, load_kinds, "what acts; see \"Loads\" and \"Signs\"").required(),
      expression().with(kind_is({pressure, temperature})),
      table_field().with({"kind", "kind = pressure without expression",
                          [](const Load& load) { return load.kind == pressure && !load.formula.given(); }}),
      table_digest_field().with({"table", "table", [](const Load& load) { return load.table.given(); }}),
      number<Load>("gravity", "length/time^2", &Load::gravity, finite,
                   "own weight: the pressure is density thickness gravity, along w")
          .with({"kind", "kind = pressure without expression and table",
                 [](const Load& load) { return load.kind == pressure && !load.evaluated(); }}),
      amount("value", "force/length^2, force, force/length, force, force/length, temperature, length", &Load::value,
             "pressure, edge moment per length, edge shear per length, point force, force per length of a line, "
             "temperature of the face z > 0 less that of the other, deflection of a support")
          .with({"kind", "neither expression, table nor gravity", valued})
          .standard("required without tensor, expression, table and gravity"),
      number<Load>("level", "length", &Load::level, finite,
                   "the y up to which a fluid stands: the pressure is value, its unit weight, times level - y below")
          .with(with_value),
      point("gradient", "force/length^3", &Load::gradient, "[x, y]", "what the pressure grows by along x and y")
          .with(by_value),
      point("from", "length", &Load::from, "[x, y]",
            "where the pressure or the deflection of the support has its value")
          .with(from_somewhere),
  };
}

/// Where it acts.
Fields<Load> place_fields() {
  using enum Load::Kind;
  return {
      table<Load, geometry::Hole>("on", Layout::inline_, &Load::patch,
                                  hole_fields("the disc that the pressure acts on, without it the plate",
                                              "the polygon that the pressure acts on, without it the plate"),
                                  check_hole)
          .with(kind_is({pressure})),
      points("along", &Load::along, 2, "the line that the load acts along").required().with(kind_is({line_load})),
      edges<Load>("the edges that are loaded").required().with(kind_is({edge_moment, edge_shear})),
      amount("twist", "force", &Load::twist, "twisting moment M_ns beside value, s = normal turned by +90 degrees")
          .with(kind_is({edge_moment})),
      tensor().with(kind_is({edge_moment})),
      points("path", &Load::path, 2, "where the force, or with \"on\" the pressure from its place on, moves along")
          .in_dynamics()
          .with(kind_is({point_force, pressure})),
      number<Load>("speed", "length/time", &Load::speed, positive,
                   "with which it moves; at its end it leaves the plate")
          .required({Analysis::Kind::dynamic})
          .in_dynamics()
          .with({"path", "path", [](const Load& load) { return load.moves(); }}),
      point("position", "length", &Load::position, "[x, y] inside the plate", "where the force acts")
          .required()
          .with({"kind", "kind = point_force without path",
                 [](const Load& load) { return load.kind == point_force && !load.moves(); }}),
  };
}

Fields<Load> settlement_fields() {
  using enum Load::Kind;
  return {
      number<Load>("support", "-", &Load::support, {0, 1e6}, "the number of the support that moves, the first is 0")
          .required()
          .with(kind_is({settlement})),
      point("slope", "-", &Load::slope, "[x, y]", "what its deflection grows by along x and y, as of a rigid body")
          .with(kind_is({settlement})),
      number<Load>("rotation", "-", &Load::rotation, finite,
                   "psi_n, by which its edges turn about themselves, n the outer normal")
          .with(kind_is({settlement})),
  };
}

Fields<Load> history_fields() {
  const auto rise_time = [](auto& load) -> auto& {
    return load.history.rise_time;
  };
  const auto frequency = [](auto& load) -> auto& {
    return load.history.frequency;
  };
  return {
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
  if (!has("value") && !has("tensor") && !has("expression") && !has("gravity") && !has("table"))
    reading.complain(given.below("value"), "is missing, must be a finite number");
  for (const char* name : {"value", "twist"})
    if (load.has_tensor && reading.given(given.below(name)))
      reading.complain(given.below(name),
                       fmt::format("'{}' is given beside 'tensor', which replaces it: remove one of them", name));
}

}  // namespace cases
