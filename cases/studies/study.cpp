#include "cases/studies/study.hpp"

#include <fmt/format.h>
#include <set>

#include "cases/driver/case_plan.hpp"
#include "cases/runs/run_plan.hpp"
#include "cases/studies/orders.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/process.hpp"
#include "post/files/run_folder.hpp"
#include "post/report/quantity.hpp"

namespace cases {
namespace {

/// Reason why the run does not have a quantity of the whole plate; empty where it has.
std::string lacking_whole(const RunPlan& plan, const std::string& name) {
  const bool modes = plan.analysis.kind == plate::Analysis::Kind::frequencies;
  if (name == "frequency") return modes ? "" : "the case has no frequencies";
  if (!plan.problem.load_cases.empty()) return "the case has load cases: envelope.csv and srif.csv have their factors";
  if (modes) return "the case has frequencies only";
  if (plan.analysis.kind == plate::Analysis::Kind::harmonic)
    return "the case has a response over frequencies: response.csv has it";
  if (name.ends_with("_peak") && (!plan.moves() || plan.growth))
    return "peaks in time are of dynamic cases without growth";
  if (name == "crack_length" && !plan.growth) return "the case has no [growth]";
  if (name == "largest_load_factor" && !plan.grows_at_rest()) return "the case has no quasi-static growth";
  return "";
}

}  // namespace

std::string lacking(const RunPlan& plan, const post::Quantity& quantity) {
  if (auto why = lacking_whole(plan, quantity.name); !why.empty()) return why;
  if (quantity.probe && !plan.probes.contains(*quantity.probe))
    return fmt::format("the case has no probe \"{}\"", *quantity.probe);
  if (!quantity.tip) return "";
  if (!plan.srif) return "the case has no [srif]";
  if (quantity.name.starts_with('F') && !plan.srif->normalize) return "the case has no srif.normalize";
  const auto tips = geometry::tips(plate::crack_paths(plan.problem)).size();
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
    } catch (const CaseError& error) {
      for (auto problem : error.problems()) {
        const std::string where = problem.place;  // an override's becomes that of the study file
        for (const auto& [text, place] : set)
          if (where == "--set " + text.substr(0, text.find('='))) problem.place = place;
        report_error(problem, run);
      }
      return;
    }
    const auto plan = plan_of(run.file.content, {});
    std::vector<post::Quantity> listed;
    for (std::size_t i = 0; i < study_.quantities.size(); ++i) {
      const auto& quantity = study_.quantities[i].quantity;
      const auto key = element("quantities", i), lack = lacking(plan, quantity);
      if (lack.empty())
        listed.push_back(quantity);
      else
        report_error({reading_.found().place(key), key, lack}, run);
    }
    run.wanted = wanted(listed, study_.references, study_.axis_names(), run.labels, [&](std::size_t i, bool needed) {
      const auto& reference = study_.references[i];
      const std::string key = element("reference", i), lack = lacking(plan, reference.quantity);
      const bool is_static = run.file.content.analysis.kind == Analysis::Kind::static_;
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
