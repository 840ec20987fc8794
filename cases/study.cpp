#include "cases/study.hpp"

#include <set>

#include "plate/numerical_error.hpp"

namespace cases {
namespace {

namespace fs = std::filesystem;
using post::Reference;

void read_where(const Value& given, Reference& reference) {
  const toml::table* table = given.table();
  if (!table) return;
  for (const auto& [name, node] : *table) {
    const std::string axis(name.str());
    const auto label = Value(node, given.below(axis), given.reading()).text();
    if (label) reference.where[axis] = *label;
  }
}

void read_value(const Value& given, Reference& reference) {
  const auto number = given.number();
  if (number && *number == 0) given.refuse("a number other than 0: errors are relative to it");
  reference.value = number.value_or(0);
}

Fields<Study> study_fields() {
  const Fields<AxisPoint> point{word<AxisPoint>("label", &AxisPoint::label).required(), case_file<AxisPoint>(),
                                settings<AxisPoint>()};
  const Fields<Axis> axis{word<Axis>("name", &Axis::name).required(),
                          tables<Axis, AxisPoint>("point", Layout::block, &Axis::points, point)};
  Fields<Reference> reference = quantity_fields<Reference>();
  for (auto& field :
       {entry<Reference>("where", "", read_where), entry<Reference>("value", "a number", read_value).required(),
        word<Reference>("source", &Reference::source)})
    reference.push_back(field);
  return {word<Study>("title", &Study::title),
          word<Study>("source", &Study::source),
          case_file<Study>(),
          settings<Study>(),
          tables<Study, Axis>("axis", Layout::block, &Study::axes, axis),
          tables<Study, Reference>("reference", Layout::block, &Study::references, reference)};
}

const auto element = [](const std::string& list, std::size_t i) { return fmt::format("{}[{}]", list, i); };

/// Names of axes are columns of study.csv, labels tell the points of an axis apart.
void check_axes(const Study& study, Reading& reading) {
  std::set<std::string> columns(post::study_columns().begin(), post::study_columns().end());
  double runs = 1;
  for (std::size_t i = 0; i < study.axes.size(); ++i) {
    const auto& [name, points] = study.axes[i];
    const std::string axis = element("axis", i);
    if (!name.empty() && !columns.insert(name).second)
      reading.complain(axis + ".name", fmt::format("\"{}\" is a column of study.csv already", name));
    if (points.empty() && reading.sound(axis + ".point"))
      reading.complain(axis + ".point", "is missing, must be [[axis.point]] with a label");
    std::set<std::string> labels;
    for (std::size_t j = 0; j < points.size(); ++j)
      if (const auto& label = points[j].label; !label.empty() && !labels.insert(label).second)
        reading.complain(element(axis + ".point", j) + ".label", fmt::format("\"{}\" is given twice", label));
    runs *= double(points.size());
  }
  constexpr double most = 10000;  // a slip: runs take seconds or more
  if (runs > most) reading.complain("axis", fmt::format("{:g} combinations, must be at most {:g}", runs, most));
}

/// The axes and labels of a reference exist.
void check_where(const Study& study, const Reference& reference, const std::string& key, Reading& reading) {
  for (const auto& [name, label] : reference.where) {
    const std::string at = key + ".where." + name;
    const auto axis = std::ranges::find(study.axes, name, &Axis::name);
    if (axis == study.axes.end()) {
      reading.complain(at, fmt::format("no axis \"{}\"{}", name, did_you_mean(name, study.axis_names())));
      continue;
    }
    std::vector<std::string> labels;
    for (const auto& point : axis->points) labels.push_back(point.label);
    if (std::ranges::find(labels, label) == labels.end())
      reading.complain(at, fmt::format("\"{}\" given, must be one of {}", label, listed(labels)));
  }
}

void check_references(const Study& study, Reading& reading) {
  const auto& references = study.references;
  for (std::size_t j = 0; j < references.size(); ++j) {
    const std::string key = element("reference", j);
    check_where(study, references[j], key, reading);
    const auto end = references.begin() + std::ptrdiff_t(j);
    const auto same =
        std::find_if(references.begin(), end, [&](const auto& r) { return post::overlap(r, references[j]); });
    const std::string other = element("reference", std::size_t(same - references.begin()));
    if (same != end && reading.sound(key))
      reading.complain(key, fmt::format("matches a run with the same quantity as {} ({}): one for each run", other,
                                        reading.found().place(other)));
  }
}

/// Why a run of the case has no such quantity; empty where it has.
std::string lacking(const Case& c, const post::Quantity& quantity) {
  if (quantity.probe && !c.output.probes.contains(*quantity.probe))
    return fmt::format("the case has no probe \"{}\"", *quantity.probe);
  if (!quantity.tip) return "";
  if (!c.srif) return "the case has no [srif]";
  if (quantity.name.starts_with('F') && !c.srif->normalize) return "the case has no srif.normalize";
  const auto [low, high] = geometry::bounding_box(c.outline);
  const auto tips = geometry::tips(geometry::crack_paths(c.outline, c.cracks, 1e-9 * (high - low).norm())).size();
  return *quantity.tip < tips ? "" : fmt::format("the case has {} crack tips, counted from 0", tips);
}

/// Reads the cases of all runs; a problem of several is said once, with the first of them where it is not in all.
/// Tells nothing where the axes are wrong: then it is not known which the cases are.
class Runs {
public:
  Runs(Study& study, Reading& reading) : study_(study), reading_(reading) {}

  void read() {
    std::vector<std::size_t> sizes;
    for (const auto& axis : study_.axes) sizes.push_back(axis.points.size());
    const auto all = post::combinations(sizes);
    for (const auto& combination : all) read_run(combination);
    for (auto& [problem, runs] : problems_) {
      if (runs.size() < all.size())
        problem.what += fmt::format(" (in {} of {} runs, first: {})", runs.size(), all.size(), runs.front());
      reading_.complain(problem);
    }
  }

private:
  void complain(const Problem& problem, const StudyRun& run) {
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
    if (!path) return complain({reading_.found().place("case"), "case", "is missing, must be a case file"}, run);
    std::vector<std::string> overrides;
    for (const auto& setting : set) overrides.push_back(setting.text);
    try {
      run.file = read_case(*path, overrides);
    } catch (const CaseError& error) {
      for (auto problem : error.problems()) {
        const std::string where = problem.place;  // an override's becomes that of the study file
        for (const auto& [text, place] : set)
          if (where == "--set " + text.substr(0, text.find('='))) problem.place = place;
        complain(problem, run);
      }
      return;
    }
    run.wanted = post::wanted(study_.references, study_.axis_names(), run.labels, [&](std::size_t i, bool needed) {
      const std::string key = element("reference", i), lack = lacking(run.file.content, study_.references[i].quantity);
      if (needed && !lack.empty()) complain({reading_.found().place(key), key, lack}, run);
      return lack.empty();
    });
    study_.runs.push_back(std::move(run));
  }

  Study& study_;
  Reading& reading_;
  std::vector<std::pair<Problem, std::vector<std::string>>> problems_;
};

}  // namespace

toml::table parsed(const fs::path& path) {
  const std::string name = path.string();
  if (!fs::exists(path)) throw CaseError({{name, "", "no such file"}});
  try {
    return toml::parse_file(name);
  } catch (const toml::parse_error& error) {
    const auto at = error.source().begin;
    throw CaseError({{fmt::format("{}:{}:{}", name, at.line, at.column), "", std::string(error.description())}});
  }
}

std::vector<std::string> Study::axis_names() const {
  std::vector<std::string> names;
  for (const auto& axis : axes) names.push_back(axis.name);
  return names;
}

Study read_study(const fs::path& path) {
  const toml::table root = parsed(path);
  Reading reading(path.string());
  Study study;
  study.title = path.stem().string();
  read_fields(study_fields(), Value(root, "", reading), study);
  check_axes(study, reading);
  if (reading.sound("axis")) check_references(study, reading);
  if (reading.sound("axis") && reading.sound("case") && reading.sound("set")) Runs(study, reading).read();
  if (!reading.problems().empty()) throw CaseError(reading.problems());
  std::set<std::string> taken;
  for (auto& run : study.runs) taken.insert(run.folder = post::folder_name(run.labels, taken));
  return study;
}

StudyOutcome run_study(const Study& study, const RunOptions& options) {
  StudyOutcome outcome{{study.axis_names(), {}}};
  auto& [table, wrong_cases, failed_numbers] = outcome;
  fs::create_directories(options.folder);
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const auto& run = study.runs[i];
    std::vector<post::StudyRow> rows(1);
    rows.front().labels = run.labels;
    rows.front().spacing = run.file.content.discretization.spacing;
    try {
      const fs::path folder = options.folder / run.folder;
      rows = post::study_rows(rows.front(), run.wanted, cases::run(run.file, {folder, true}), folder);
    } catch (const CaseError& error) {
      ++wrong_cases;
      rows.front().message = error.what();
    } catch (const plate::NumericalError& error) {
      ++failed_numbers;
      rows.front().message = error.what();
    }
    table.rows.insert(table.rows.end(), rows.begin(), rows.end());
    post::write_csv(options.folder / "study.csv", post::table(table));
    if (!options.quiet || !rows.front().message.empty())
      fmt::print(stderr, "[{}/{}] {}\n", i + 1, study.runs.size(), post::to_text(rows.front()));
  }
  return outcome;
}

}  // namespace cases
