#pragma once
#include <filesystem>
#include <string>

namespace post {

/// Writes report.html into the folder of a study, from study.csv, orders.csv and the reports of its runs.
void write_study_report(const std::filesystem::path& folder, const std::string& title);

/// The same for a table of extremes, from extremes.csv.
void write_extremes_report(const std::filesystem::path& folder, const std::string& title);

/// The reports again of a study or a table of extremes that has ended, under the title that they had; false where the
/// folder is of neither.
bool write_report_of_many(const std::filesystem::path& folder);

}  // namespace post
