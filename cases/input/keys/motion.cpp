#include "cases/input/keys.hpp"
#include "plate/model/loads.hpp"
#include "plate/solve/motion/damping.hpp"

namespace cases {
namespace {

/// A number, or an expression in x and y.
Field<plate::Initial> anywhere(const std::string& name, const std::string& unit, plate::Formula plate::Initial::*member,
                               const std::string& help) {
  return value<plate::Initial>(
      {name, unit, "a number or an expression in x, y and pi", "", help},
      [member](const Value& given, plate::Initial& initial) {
        const auto text = given.is_text() ? given.text() : std::nullopt;
        const auto number = text ? std::nullopt : given.number();
        if (text || number) try {
            initial.*member = plate::Formula(text ? *text : number_text(*number));
          } catch (const std::invalid_argument& error) {
            given.complain(error.what());
          }
      },
      [member](const plate::Initial& initial) {
        return (initial.*member).given() ? quoted((initial.*member).text()) : "";
      });
}

/// Two numbers that become mass and stiffness, and are not written again.
Field<plate::Damping> pair(const std::string& name, const std::string& unit, const std::string& help) {
  return value<plate::Damping>(
      {name, unit, "[a, b], both > 0", "", help},
      [](const Value& given, plate::Damping&) {
        const auto both = given.numbers(2, "[a, b], both > 0");
        if (both && !((*both)[0] > 0 && (*both)[1] > 0)) given.refuse("[a, b], both > 0");
      },
      [](const plate::Damping&) { return ""; });
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

Fields<plate::Sweep> sweep_fields() {
  using S = plate::Sweep;
  return {number<S>("from", "1/time", &S::from, positive, "the lowest frequency of the loads")
              .required({Analysis::Kind::harmonic}),
          number<S>("to", "1/time", &S::to, positive, "the highest").required({Analysis::Kind::harmonic}),
          number<S>("count", "-", &S::count, {2, 100000},
                    "how many, equally far from each other; resonances between them come beside")};
}

void check_sweep(const Value& given, plate::Sweep& sweep) {
  if (given.reading().sound(given.key()) && !(sweep.to > sweep.from)) given.complain("'to' must be above 'from'");
}

Fields<plate::Damping> damping_fields() {
  using D = plate::Damping;
  return {number<D>("mass", "1/time", &D::mass, {0}, "alpha of C = alpha M + beta K"),
          number<D>("stiffness", "time", &D::stiffness, {0}, "beta of C = alpha M + beta K"),
          pair("ratio", "-", "of the critical damping at the two frequencies, instead of mass and stiffness"),
          pair("frequencies", "1/time", "where the plate has these ratios")};
}

void check_damping(const Value& given, plate::Damping& damping) {
  auto& reading = given.reading();
  const auto has = [&](const char* name) { return reading.given(given.below(name)); };
  const auto two = [&](const char* name) -> std::array<double, 2> {
    const auto both = Value(*given.table()->get(name), given.below(name), reading).numbers(2, "[a, b]");
    return {both->at(0), both->at(1)};
  };
  if (has("ratio") != has("frequencies"))
    return given.complain("'ratio' and 'frequencies' belong together: give both, or mass and stiffness");
  if (!has("ratio")) {
    if (damping.none() && reading.sound(given.key()))
      given.complain("damps nothing: give mass and stiffness, or ratio and frequencies");
    return;
  }
  if (has("mass") || has("stiffness"))
    return given.complain("'mass' and 'stiffness' follow from 'ratio' and 'frequencies': give one pair or the other");
  if (!reading.sound(given.key())) return;
  const auto frequencies = two("frequencies");
  if (!(frequencies[0] < frequencies[1])) return given.complain("the second frequency must be above the first");
  damping = plate::damping_of(two("ratio"), frequencies);
  if (damping.mass < 0 || damping.stiffness < 0)
    given.complain(
        fmt::format("no plate has such ratios: mass = {:.4g} and stiffness = {:.4g} would be needed, and none "
                    "may be negative; bring the ratios nearer to each other",
                    damping.mass, damping.stiffness));
}

}  // namespace cases
