#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace post {
struct Kept;
struct Summary;
struct Table;
}  // namespace post

namespace cases {

struct CaseFile;

struct RunOptions {
  std::filesystem::path folder;  // results go here; made if it does not exist
  bool quiet = false;
  post::Kept* kept = nullptr;  // results go here instead, and no file is written

  /// Of a run that belongs to another one.
  RunOptions part(const std::string& name) const;
};

/// The steps of a dynamic run.
struct TimeGrid {
  double time_step;
  std::size_t steps, steps_per_row;  // rows of history, probes and intensity factors
};

/// Steps that end exactly on the rows of history, none above `limit`. Throws CaseError where the file asks for more.
TimeGrid time_grid(const CaseFile& file, double limit);

/// One step per row, for motions that need no steps. Throws CaseError where there are too many.
TimeGrid row_grid(const CaseFile& file);

/// Runs a case and writes its results folder. Throws CaseError before anything is written; plate::NumericalError after
/// the last good frame, the summary and all tables have been written.
post::Summary run(const CaseFile& file, const RunOptions& options);

/// What a run would cost, as text: points, bonds, memory, time step, steps. Writes nothing. Throws CaseError.
std::string cost(const CaseFile& file);

/// Extracts the intensity factors again from the frames of a finished run; rows of srif.csv.
/// Throws CaseError or std::runtime_error.
post::Table srif_again(const std::filesystem::path& folder, const std::vector<std::string>& methods);

/// Writes report.html into the folder of a finished run again. Throws CaseError where it is no such folder.
void report_again(const std::filesystem::path& folder);

}  // namespace cases
