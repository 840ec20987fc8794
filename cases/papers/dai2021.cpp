// Dai, Tanaka, S. Oterkus, E. Oterkus 2021: cracked plates at rest (4.1) and in motion (4.2 to 4.4, appendix A),
// through their case files.

#include "cases/papers/dai2021.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/studies/study.hpp"
#include "plate/model/errors.hpp"
#include "post/files/atomic_file.hpp"

namespace cases {
namespace {

namespace fs = std::filesystem;

/// Writes the files that the program brings along where a study finds them.
void unpack(const fs::path& folder) {
  for (const auto& [name, text] : paper_files()) {
    fs::create_directories((folder / name).parent_path());
    post::write_atomically(folder / name, std::string(text));
  }
}

/// Runs a study. Throws NumericalError where a run came to nothing: its numbers would be missing.
StudyTable table_of(const fs::path& study, const fs::path& folder) {
  const auto outcome = run_study(read_study(study), {.folder = folder, .quiet = true});
  if (outcome.wrong_cases + outcome.failed_numbers + outcome.killed + outcome.missing > 0)
    throw plate::NumericalError(
        fmt::format("{}: runs failed, see {}", study.string(), (folder / "study.csv").string()));
  return outcome.table;
}

std::string named_labels(const StudyTable& table, const StudyRow& row) {
  std::vector<std::string> parts;
  for (std::size_t axis = 0; axis < table.axes.size(); ++axis)
    parts.push_back(fmt::format("{} {}", table.axes[axis], row.labels[axis]));
  return fmt::format("{}", fmt::join(parts, ", "));
}

PaperRow paper_row(const std::string& item, const StudyRow& row) {
  return {.item = item,
          .quantity = row.quantity + (row.quantity == "w" ? " at the tip [m]" : " [-]"),
          .ours = row.computed.value_or(NAN),
          .reference = row.reference,
          .processor_seconds = row.seconds_of("processor")};
}

/// 4.1: thirty cracks by three approaches, against the paper's fit on the exact opening; K1 by virtual crack extension,
/// the domain integral and the extrapolation with position-aware weights.
void add_static(const fs::path& folder, PaperResults& results) {
  const auto approaches = table_of(folder / "static/study_thirty_cracks_approaches.toml", folder / "approaches");
  std::map<std::string, post::Panel> panels;
  for (const auto& row : approaches.rows) {
    auto out = paper_row("4.1 by three approaches, " + named_labels(approaches, row), row);
    out.reference_is = "the paper's fit on the opening by finite elements";
    results.rows.push_back(out);
    const std::string name = fmt::format("{}, W/2h {}", row.labels[1], row.labels[2]);
    auto& panel = panels[row.labels[0]];
    panel.t_title = "2a/W", panel.y_title = "F1 under " + row.labels[0];
    auto series = std::ranges::find(panel.series, name, &post::Series::label);
    if (series == panel.series.end())
      series = panel.series.insert(
          series, {.label = name, .line = post::Line::numbered, .curve = {}, .number = panel.series.size()});
    series->curve.t.push_back(std::stod(row.labels[3])), series->curve.y.push_back(out.ours);
  }
  for (const auto& [load, panel] : panels) results.panels.push_back(panel);
  const auto aware = table_of(folder / "static/study_thirty_cracks.toml", folder / "position_aware");
  for (const auto& row : aware.rows) {
    auto out =
        paper_row(fmt::format("4.1 by position-aware weights, {}, {}", named_labels(aware, row), row.method), row);
    out.quantity = "K1 [force length^0.5]";
    out.reference_is = "finite elements, 1e-4";
    results.rows.push_back(out);
  }
}

/// 4.1: the paper's way at five spacings, with the tip at four places of its cell.
void add_places(const fs::path& folder, PaperResults& results) {
  const auto table = table_of(folder / "static/study_dai2021_spacing.toml", folder / "places");
  for (const auto& row : table.rows) {
    auto out = paper_row("4.1 by place of the tip in its cell, " + named_labels(table, row), row);
    out.reference_is = "finite elements, 1e-4";
    results.rows.push_back(out);
  }
}

/// A study of motions: peaks, and the error over all times; `way`: of runs whose labels do not name it.
void add_motion(const fs::path& study, const fs::path& folder, const std::string& way, PaperResults& results) {
  const auto table = table_of(study, folder);
  for (const auto& row : table.rows) {
    auto peak = paper_row(fmt::format("{}{}", fmt::join(row.labels, ", "), way), row);
    peak.quantity = "peak of " + peak.quantity;
    peak.reference_is = "finite elements, 1e-3";
    results.rows.push_back(peak);
    peak.quantity = "rms error of " + row.quantity + "(t) over the peak of the reference [-]";
    peak.ours = row.error().value_or(NAN);
    peak.reference = 0;
    results.rows.push_back(peak);
  }
}

}  // namespace

PaperResults dai2021(const fs::path& folder) {
  PaperResults results;
  unpack(folder);
  add_static(folder, results);
  add_places(folder, results);
  add_motion(folder / "dynamic/study_dai2021_motion.toml", folder / "motion", ", Galerkin plate, spacing 0.02",
             results);
  add_motion(folder / "dynamic/study_dai2021_approaches.toml", folder / "motion_approaches", "", results);
  return results;
}

}  // namespace cases
