#include "cases/studies/study.hpp"

#include <fmt/format.h>
#include <set>

#include "cases/driver/run.hpp"
#include "cases/input/keys.hpp"
#include "cases/studies/orders.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/process.hpp"
#include "post/files/run_folder.hpp"
#include "post/files/table.hpp"
#include "post/report/quantity.hpp"

namespace cases {
namespace {

/// Reason why the run does not have a quantity of the whole plate; empty where it has.
std::string lacking_whole(const Case& c, const std::string& name) {
  const bool modes = c.analysis.kind == plate::Analysis::Kind::frequencies;
  const bool buckles = c.analysis.kind == plate::Analysis::Kind::buckling;
  if (name == "frequency") return modes ? "" : "the case has no frequencies";
  if (name == "buckling_factor") return buckles ? "" : "the case has no buckling loads";
  if (!c.load_cases.empty()) return "the case has load cases: envelope.csv and srif.csv have their factors";
  if (modes) return "the case has frequencies only";
  if (buckles) return "the case has buckling loads only";
  if (c.analysis.kind == plate::Analysis::Kind::harmonic)
    return "the case has a response over frequencies: response.csv has it";
  if (name.ends_with("_peak") && (!c.moves() || c.growth)) return "peaks in time are of dynamic cases without growth";
  if (name == "crack_length" && !c.growth) return "the case has no [growth]";
  if (name == "largest_load_factor" && !c.grows_at_rest()) return "the case has no quasi-static growth";
  return "";
}

}  // namespace

std::string lacking(const Case& c, const post::Quantity& quantity) {
  if (auto why = lacking_whole(c, quantity.name); !why.empty()) return why;
  const auto& name = quantity.name;
  if ((name == "N1" || name == "N2" || name == "u" || name == "v") && !plate::has_plane(c))
    return "the case has no loads in the plane";
  if (quantity.probe && !c.output.probes.contains(*quantity.probe))
    return fmt::format("the case has no probe \"{}\"", *quantity.probe);
  if (!quantity.tip) return "";
  if (!c.srif) return "the case has no [srif]";
  if (quantity.name.starts_with('F') && !c.srif->normalize) return "the case has no srif.normalize";
  const auto tips = geometry::tips(plate::crack_paths(c)).size();
  return *quantity.tip < tips ? "" : fmt::format("the case has {} crack tips, counted from 0", tips);
}

std::vector<std::string> Study::axis_names() const {
  std::vector<std::string> names;
  for (const auto& axis : axes) names.push_back(axis.name);
  return names;
}

StudyRow bare_row(const StudyRun& run) {
  StudyRow row;
  row.labels = run.labels;
  row.spacing = run.file.content.discretization.spacing;
  row.horizon = run.file.content.discretization.horizon();
  return row;
}

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
  const Condition<T> has_method{"quantity", "quantity = K1 ... F3, N1 or N2", [](const T& object) {
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

/// The keys of a study file; nothing is written from them.
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

const auto element = [](const std::string& list, std::size_t i) { return fmt::format("{}[{}]", list, i); };

/// Names of axes are columns of study.csv, labels tell the points of an axis apart.
void check_axes(const Study& study, Reading& reading) {
  std::set<std::string> columns(study_columns().begin(), study_columns().end());
  columns.insert(order_columns().begin(), order_columns().end());
  for (const char* stood_for : {"spacing", "horizon"}) columns.erase(stood_for);  // an axis may stand for them
  double runs = 1;
  for (std::size_t i = 0; i < study.axes.size(); ++i) {
    const auto& [name, key, points] = study.axes[i];
    const std::string axis = element("axis", i);
    if (!name.empty() && !columns.insert(name).second)
      reading.report_error(axis + ".name", fmt::format("\"{}\" is a column of study.csv or orders.csv already", name));
    if (points.empty() && reading.sound(axis + ".point") && reading.sound(axis + ".key") &&
        reading.sound(axis + ".values"))
      reading.report_error(axis + ".point", "is missing, must be [[axis.point]] with a label; or give key and values");
    std::set<std::string> labels;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const std::string label_key = key.empty() ? element(axis + ".point", j) + ".label" : element(axis + ".values", j);
      if (const auto& label = points[j].label; !label.empty() && !labels.insert(label).second)
        reading.report_error(label_key, fmt::format("\"{}\" is given twice", label));
    }
    runs *= double(points.size());
  }
  constexpr double most = 10000;  // a slip: runs take seconds or more
  if (runs > most) reading.report_error("axis", fmt::format("{:g} combinations, must be at most {:g}", runs, most));
}

/// The axes and labels of a reference exist.
void check_where(const Study& study, const Reference& reference, const std::string& key, Reading& reading) {
  for (const auto& [name, label] : reference.where) {
    const std::string at = key + ".where." + name;
    const auto axis = std::ranges::find(study.axes, name, &Axis::name);
    if (axis == study.axes.end()) {
      reading.report_error(at, fmt::format("no axis \"{}\"{}", name, did_you_mean(name, study.axis_names())));
      continue;
    }
    std::vector<std::string> labels;
    for (const auto& point : axis->points) labels.push_back(point.label);
    if (std::ranges::find(labels, label) == labels.end())
      reading.report_error(at, fmt::format("\"{}\" given, must be one of {}", label, listed(labels)));
  }
}

void check_references(const Study& study, Reading& reading) {
  const auto& references = study.references;
  for (std::size_t j = 0; j < references.size(); ++j) {
    const std::string key = element("reference", j);
    check_where(study, references[j], key, reading);
    const auto end = references.begin() + std::ptrdiff_t(j);
    const auto same = std::find_if(references.begin(), end, [&](const auto& r) { return overlap(r, references[j]); });
    const std::string other = element("reference", std::size_t(same - references.begin()));
    if (same != end && reading.sound(key))
      reading.report_error(key, fmt::format("matches a run with the same quantity as {} ({}): one for each run", other,
                                            reading.found().place(other)));
  }
}

/// Reads the cases of all runs; a problem of several is said once, with the first of them where it is not in all.
/// Tells nothing where the axes are wrong: then it is not known which the cases are.
class Runs {
public:
  Runs(Study& study, Reading& reading) : study_(study), reading_(reading) {}

  void read() {
    std::vector<std::size_t> sizes;
    for (const auto& axis : study_.axes) sizes.push_back(axis.points.size());
    const auto all = combinations(sizes);
    for (const auto& combination : all) read_run(combination);
    for (auto& [problem, runs] : problems_) {
      if (runs.size() < all.size())
        problem.what += fmt::format(" (in {} of {} runs, first: {})", runs.size(), all.size(), runs.front());
      reading_.report_error(problem);
    }
  }

private:
  void report_error(const Problem& problem, const StudyRun& run) {
    auto same = std::ranges::find_if(problems_, [&](const auto& known) {
      return known.first.place == problem.place && known.first.key == problem.key && known.first.what == problem.what;
    });
    if (same == problems_.end()) same = problems_.insert(same, {problem, {}});
    same->second.push_back(fmt::format("{}", fmt::join(run.labels, ", ")));
  }

  void read_run(const std::vector<std::size_t>& combination) {
    StudyRun run;
    auto path = study_.case_file;
    auto set = study_.set;
    for (std::size_t axis = 0; axis < combination.size(); ++axis) {
      const auto& point = study_.axes[axis].points[combination[axis]];
      run.labels.push_back(point.label);
      if (point.case_file) path = point.case_file;
      set.insert(set.end(), point.set.begin(), point.set.end());
    }
    if (!path) return report_error({reading_.found().place("case"), "case", "is missing, must be a case file"}, run);
    std::vector<std::string> overrides;
    for (const auto& setting : set) overrides.push_back(setting.text);
    try {
      run.file = read_case(*path, overrides);
      run.file.content.output.errors = false;  // its runs tell, and their time is that of one
    } catch (const CaseError& error) {
      for (auto problem : error.problems()) {
        const std::string where = problem.place;  // an override's becomes that of the study file
        for (const auto& [text, place] : set)
          if (where == "--set " + text.substr(0, text.find('='))) problem.place = place;
        report_error(problem, run);
      }
      return;
    }
    const Case& c = run.file.content;
    std::vector<post::Quantity> listed;
    for (std::size_t i = 0; i < study_.quantities.size(); ++i) {
      const auto& quantity = study_.quantities[i].quantity;
      const auto key = element("quantities", i), lack = lacking(c, quantity);
      if (lack.empty())
        listed.push_back(quantity);
      else
        report_error({reading_.found().place(key), key, lack}, run);
    }
    run.wanted = wanted(listed, study_.references, study_.axis_names(), run.labels, [&](std::size_t i, bool needed) {
      const auto& reference = study_.references[i];
      const std::string key = element("reference", i), lack = lacking(c, reference.quantity);
      const bool is_static = c.analysis.kind == Analysis::Kind::static_;
      const bool is_curve = std::holds_alternative<KnownCurve>(reference.known);
      if (needed && !lack.empty()) report_error({reading_.found().place(key), key, lack}, run);
      if (needed && is_curve && !post::has_history(reference.quantity.name))
        report_error({reading_.found().place(key), key, "is one number, and has no curve in time"}, run);
      if (needed && is_curve && is_static)
        report_error({reading_.found().place(key), key, "the case is static, so it has no history for a curve"}, run);
      return lack.empty();
    });
    study_.runs.push_back(std::move(run));
  }

  Study& study_;
  Reading& reading_;
  std::vector<std::pair<Problem, std::vector<std::string>>> problems_;
};

/// Reports a reference to the finest run where no axis changes the spacing.
void check_finest(const Study& study, Reading& reading) {
  std::vector<StudyRow> rows;
  for (const auto& run : study.runs) rows.push_back(bare_row(run));
  const auto along = refinement(rows);
  for (std::size_t i = 0; i < study.references.size(); ++i)
    if (std::holds_alternative<Finest>(study.references[i].known) && (!along || along->by_horizon))
      reading.report_error(element("reference", i) + ".finest", "no axis changes the spacing, so no run is the finest");
}

}  // namespace

Study read_study(const std::filesystem::path& path) {
  const toml::table root = parsed(path, "study");
  Reading reading(path.string());
  Study study;
  study.title = path.stem().string();
  read_fields(study_fields(), Value(root, "", reading), study);
  check_axes(study, reading);
  if (reading.sound("axis")) check_references(study, reading);
  if (reading.sound("axis") && reading.sound("case") && reading.sound("set")) Runs(study, reading).read();
  if (reading.problems().empty()) check_finest(study, reading);
  if (!reading.problems().empty()) throw CaseError(reading.problems());
  const auto program = fmt::format("{} of {}", PDPLATE_VERSION, plate::build());  // other builds may find other numbers
  std::set<std::string> taken;
  for (auto& run : study.runs) {
    taken.insert(run.folder = folder_name(run.labels, taken));
    run.record = {run.folder, post::digest(resolved_toml(run.file.content)), program};
  }
  return study;
}

}  // namespace cases
