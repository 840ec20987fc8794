#include "post/studies/runs/study_files.hpp"

#include <fmt/format.h>

#include "post/files/table.hpp"
#include "post/files/whole_file.hpp"
#include "post/report/html/study_report.hpp"
#include "post/report/printed.hpp"
#include "post/studies/advice.hpp"
#include "post/studies/orders.hpp"
#include "post/studies/plots.hpp"

namespace post {

void write_study(const StudyTable& study, const StudyTitles& titles, const std::filesystem::path& folder) {
  write_csv(folder / "study.csv", table(study));
  write_whole(folder / "study.json", to_json(titles.title, study));
  if (refinement(study.rows)) write_csv(folder / "orders.csv", orders_table(study));
  for (const auto& [name, plot] : study_plots(study, titles)) write_whole(folder / name, to_svg(plot));
  write_study_report(folder, titles.title);
}

std::string printed_study(const StudyTable& study, const std::string& title, const std::filesystem::path& folder) {
  std::string text = fmt::format("{}\n{}", title, to_text(study));
  if (!orders(study).empty()) text += fmt::format("\nfitted orders\n{}", orders_text(study));
  text += fmt::format("\nseconds by stage\n{}", costs_text(study));
  for (const auto& sentence : advice(study)) text += sentence + "\n";
  return text + results_in(folder);
}

}  // namespace post
