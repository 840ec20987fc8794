#include "cases/studies/study.hpp"

#include <fmt/format.h>

#include "cases/driver/run.hpp"
#include "plate/model/numerical_error.hpp"
#include "post/files/summary.hpp"
#include "post/files/whole_file.hpp"
#include "post/report/html/study_report.hpp"
#include "post/studies/orders.hpp"
#include "post/studies/plots.hpp"

namespace cases {
namespace {

namespace fs = std::filesystem;

/// The unit of a key in SI units; "" without one.
std::string si_unit(const std::string& key) {
  static const std::map<std::string, std::string> units{{"length", "m"},
                                                        {"time", "s"},
                                                        {"1/time", "1/s"},
                                                        {"force", "N"},
                                                        {"force/length", "N/m"},
                                                        {"force/length^2", "Pa"},
                                                        {"mass/length^3", "kg/m\u00b3"}};
  const auto known = std::ranges::find(keys(), key, &Key::name);
  const auto unit = known == keys().end() ? units.end() : units.find(known->unit);
  return unit == units.end() ? "" : unit->second;
}

post::StudyTitles titles(const Study& study) {
  post::StudyTitles result{study.title, study.axis_names(), true};
  for (const auto& run : study.runs) result.si = result.si && run.file.content.units == "SI";
  for (std::size_t i = 0; i < study.axes.size(); ++i)
    if (const auto unit = si_unit(study.axes[i].key); result.si && !unit.empty())
      result.axes[i] += fmt::format(" [{}]", unit);
  return result;
}

void write(const Study& study, const post::StudyTable& table, const fs::path& folder) {
  post::write_csv(folder / "study.csv", post::table(table));
  if (post::refinement(table.rows)) post::write_csv(folder / "orders.csv", post::orders_table(table));
  for (const auto& [name, plot] : post::study_plots(table, titles(study)))
    post::write_whole(folder / name, post::to_svg(plot));
  post::write_study_report(folder, study.title);
}

}  // namespace

std::vector<std::string> Study::axis_names() const {
  std::vector<std::string> names;
  for (const auto& axis : axes) names.push_back(axis.name);
  return names;
}

post::StudyRow bare_row(const StudyRun& run) {
  post::StudyRow row;
  row.labels = run.labels;
  row.spacing = run.file.content.discretization.spacing;
  row.horizon = run.file.content.discretization.horizon();
  return row;
}

StudyOutcome run_study(const Study& study, const RunOptions& options) {
  StudyOutcome outcome{{study.axis_names(), {}}};
  auto& [table, wrong_cases, failed_numbers] = outcome;
  fs::create_directories(options.folder);
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const auto& run = study.runs[i];
    std::vector<post::StudyRow> rows{bare_row(run)};
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
    post::refer_to_finest(table);
    write(study, table, options.folder);
    for (const auto& row : rows) {
      const bool is_first = &row == &rows.front();
      if ((is_first && !options.quiet) || !row.message.empty())
        fmt::print(stderr, "[{}/{}] {}\n", i + 1, study.runs.size(), post::to_text(row));
    }
  }
  return outcome;
}

}  // namespace cases
