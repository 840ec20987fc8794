#include "post/studies/runs/comparison.hpp"

#include <stdexcept>

#include "post/files/whole_file.hpp"
#include "post/report/html/comparison_page.hpp"
#include "post/studies/runs/read_summary.hpp"

namespace post {

ComparedRun compared(const std::filesystem::path& folder, const std::filesystem::path& reference,
                     const Tolerances& tolerances) {
  if (!std::filesystem::exists(reference)) throw std::invalid_argument("no such file");
  auto rows = compare(folder, reference);
  auto above = exceeded(rows, tolerances);
  return {folder, std::move(rows), std::move(above)};
}

std::string to_text(const ComparedRun& run) {
  return to_text(run.rows) + to_text(run.above);
}

void write(const ComparedRun& run, const std::filesystem::path& drawing, const std::filesystem::path& json) {
  if (!drawing.empty()) {
    const auto summary = read_summary(run.folder / "summary.json");
    const auto curves = plot(run.rows, title_of(run.folder), summary && summary->units == "SI");
    const bool page = drawing.extension() == ".html";
    write_whole(drawing, page ? comparison_page(curves, to_text(run.rows)) : to_svg(curves));
  }
  if (!json.empty()) write_whole(json, to_json(run.rows, run.above));
}

}  // namespace post
