#pragma once
#include <filesystem>
#include <map>

#include "geometry/shape/outline.hpp"
#include "post/report/html/pictures.hpp"

namespace plate {
struct Problem;
}

namespace post {

/// What a report says of a case beside its results.
struct ReportedCase {
  const plate::Problem& problem;
  std::string title, source, units;
  std::map<std::string, geometry::Point> probes;
};

/// Writes report.html into the folder of a run, from the files there and pictures of its fields: what it shows are the
/// numbers of summary.json. Throws std::filesystem::filesystem_error where the folder holds no summary.
void write_report(const std::filesystem::path& folder, const ReportedCase& about, const Pictures& pictures);

/// The same from the files of a run that has ended: those of the last frame and of a few before it.
void write_report(const std::filesystem::path& folder, const ReportedCase& about);

}  // namespace post
