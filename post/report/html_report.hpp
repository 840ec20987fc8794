#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "geometry/shape/outline.hpp"

namespace plate {
struct Problem;
}

namespace post {

class Pictures;
struct CurvePlot;
struct Table;

/// Data of a case that a report shows beside its results.
struct ReportedCase {
  const plate::Problem& problem;
  std::string title, source, units;
  std::string project, author, date;  // empty: not given
  std::map<std::string, geometry::Point> probes;
};

/// Writes report.html into the folder of a run, from the files there and pictures of its fields: what it shows are the
/// numbers of summary.json. Throws std::filesystem::filesystem_error where the folder holds no summary.
void write_report(const std::filesystem::path& folder, const ReportedCase& about, const Pictures& pictures);

/// Writes the report of a run that has ended from its files: those of the last frame and of a few before it.
void write_report(const std::filesystem::path& folder, const ReportedCase& about);

/// Writes report.html into the folder of a study, from study.csv, orders.csv and the reports of its runs.
void write_study_report(const std::filesystem::path& folder, const std::string& title);

/// Writes report.html of a table of extremes, from extremes.csv.
void write_extremes_report(const std::filesystem::path& folder, const std::string& title);

/// Writes report.html of examples of papers: a table of their numbers (cases/papers), and curves under the title of the
/// plot. `links`: folders below this one that have reports of their own.
void write_papers_report(const std::filesystem::path& folder, const CurvePlot& plot, const Table& table,
                         const std::vector<std::string>& links);

/// The reports again of a study or a table of extremes that has ended, under the title that they had; false where the
/// folder is of neither.
bool write_report_of_many(const std::filesystem::path& folder);

}  // namespace post
