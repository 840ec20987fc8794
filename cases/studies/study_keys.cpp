#include "cases/studies/study.hpp"

#include "post/files/table.hpp"

namespace cases {
namespace {

void read_where(const Value& given, Reference& reference) {
  const toml::table* table = given.table();
  if (!table) return;
  for (const auto& [name, node] : *table) {
    const std::string axis(name.str());
    const Value label(node, given.below(axis), given.reading());
    reference.where[axis] = label.is_text() ? *label.text() : label.toml();  // 0.1 is the label "0.1"
  }
}

/// Reads the samples of a curve.
void load(const Value& reference, KnownCurve& known) {
  Reading& reading = reference.reading();
  const std::string file = reference.below("curve"), column = reference.below("column");
  try {
    const auto table = post::read_csv(known.file);
    const auto has = [&](const std::string& name) {
      return std::ranges::find(table.columns, name) != table.columns.end();
    };
    if (!has("t")) return reading.report_error(file, "the file has no column t, so it holds no curves");
    if (!has(known.column))
      return reading.report_error(column,
                                  fmt::format("\"{}\" given, must be one of {}{}", known.column, listed(table.columns),
                                              did_you_mean(known.column, table.columns)));
    known.curve = post::curve(table, "t", known.column);
  } catch (const std::exception& error) {
    return reading.report_error(file, error.what());
  }
  const auto& [t, y] = known.curve;
  if (t.size() < 2 || !std::ranges::is_sorted(t) || std::ranges::all_of(y, [](double value) { return value == 0; }))
    reading.report_error(column,
                         "the curve must have two samples or more, other than 0, with times that do not go back");
}

/// Checks that exactly one of value, finest and curve is given.
void check_reference(const Value& given, Reference& reference) {
  Reading& reading = given.reading();
  std::vector<std::string> found;
  for (const std::string name : {"value", "finest", "curve"})
    if (reading.given(given.below(name))) found.push_back(name);
  if (found.empty())
    reading.report_error(given.below("value"),
                         "is missing, must be a number; or give finest = true, or curve = \"FILE.csv\" and column");
  if (found.size() > 1) given.report_error(fmt::format("{} given, must be one of them", fmt::join(found, " and ")));
  if (found == std::vector<std::string>{"value"} && !reference.scale && reading.sound(given.below("value")) &&
      std::get<double>(reference.known) == 0)
    reading.report_error(given.below("value"),
                         "0 given, must be a number other than 0, because errors are relative to it; or give scale");
  auto* curve = std::get_if<KnownCurve>(&reference.known);
  if (curve && found.size() == 1 && reading.sound(given.key())) load(given, *curve);
}

/// The short form of the points of an axis: the values of its key.
void read_values(const Value& given, Axis& axis) {
  const auto elements = given.elements("a list of values of the key");
  if (elements.empty() && given.reading().sound(given.key())) given.refuse("a list of values of the key");
  for (const auto& value : elements) {
    auto& point = axis.points.emplace_back();
    point.label = value.is_text() ? *value.text() : value.toml();
    point.set.push_back({axis.key + "=" + value.toml(), given.reading().found().place(value.key())});
  }
}

Fields<Axis> axis_fields() {
  const Condition<Axis> has_key{"key", "key", [](const Axis& axis) { return !axis.key.empty(); }};
  const Condition<Axis> has_no_key{"key", "no key", [](const Axis& axis) { return axis.key.empty(); }};
  const Fields<AxisPoint> point{word<AxisPoint>("label", &AxisPoint::label).required(), case_file<AxisPoint>(),
                                settings<AxisPoint>()};
  return {word<Axis>("name", &Axis::name).required(), word<Axis>("key", &Axis::key),
          entry<Axis>("values", "a list of values of the key", read_values).required().with(has_key),
          tables<Axis, AxisPoint>("point", Layout::block, &Axis::points, point).with(has_no_key)};
}

/// The keys of a quantity, with the method of factors.
template <class T>
Fields<T> asked_fields() {
  const Condition<T> has_method{"quantity", "quantity = K1 ... F3", [](const T& object) {
                                  const auto& name = object.quantity.name;
                                  return post::kind_of_place(name) == "tip" && post::has_history(name);
                                }};
  auto fields = quantity_fields<T>();
  fields.push_back(word<T>(
                       "method", [](auto& object) -> auto& { return object.quantity.method; })
                       .with(has_method));
  return fields;
}

Fields<Reference> reference_fields() {
  using R = Reference;
  const Condition<R> has_value{"value", "value", [](const R& r) { return std::holds_alternative<double>(r.known); }};
  const Condition<R> has_curve{"curve", "curve",
                               [](const R& r) { return std::holds_alternative<KnownCurve>(r.known); }};
  const auto read_value = [](const Value& given, R& r) { r.known = given.number().value_or(0); };
  const auto read_scale = [](const Value& given, R& r) {
    r.scale = given.number();
    if (r.scale && !(*r.scale > 0)) given.refuse("a number above 0");
  };
  const auto read_finest = [](const Value& given, R& r) {
    if (!given.boolean().value_or(true)) given.refuse("true");
    r.known = Finest{};
  };
  const auto read_curve = [](const Value& given, R& r) {
    const auto name = given.text();
    r.known = KnownCurve{name ? file_beside(given, *name) : "", ""};
  };
  const auto read_column = [](const Value& given, R& r) {
    std::get<KnownCurve>(r.known).column = given.text().value_or("");
  };
  return joined<R>(asked_fields<R>(),
                   {entry<R>("where", "", read_where), entry<R>("value", "a number", read_value),
                    entry<R>("scale", "a number above 0", read_scale).with(has_value),
                    entry<R>("finest", "true", read_finest), entry<R>("curve", "a file", read_curve),
                    entry<R>("column", "the name of a column of the file", read_column).required().with(has_curve),
                    word<R>("source", &R::source)});
}

}  // namespace

Fields<Study> study_fields() {
  return {
      word<Study>("title", &Study::title),
      word<Study>("source", &Study::source),
      case_file<Study>(),
      settings<Study>(),
      tables<Study, Axis>("axis", Layout::block, &Study::axes, axis_fields()),
      number<Study>("repeats", "-", &Study::repeats, {1, 1000}, ""),
      tables<Study, Study::Listed>("quantities", Layout::block, &Study::quantities, asked_fields<Study::Listed>()),
      tables<Study, Reference>("reference", Layout::block, &Study::references, reference_fields(), check_reference)};
}

}  // namespace cases
