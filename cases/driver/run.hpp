#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "plate/model/point_map.hpp"

namespace post {
struct ResultsInMemory;
struct Summary;
struct Table;
}  // namespace post

namespace cases {

struct CaseFile;
struct ParisLaw;

struct RunOptions {
  std::filesystem::path folder;  // results go here; made if it does not exist
  bool quiet = false;
  post::ResultsInMemory* in_memory = nullptr;  // results go here instead, and no file is written
  bool resume = false;                         // goes on from what an earlier run has kept in the folder
  const plate::Communicator* communicator = &plate::single_process();

  /// Options of a run that belongs to this one.
  RunOptions part(const std::string& name) const;
};

/// Runs a case and writes its results folder. Throws CaseError before anything is written; plate::NumericalError and
/// plate::Interrupted after the last good frame, the summary and all tables have been written.
post::Summary run(const CaseFile& file, const RunOptions& options);

/// Extracts the intensity factors again from the frames of a finished run; rows of srif.csv.
/// Throws CaseError or std::runtime_error.
post::Table srif_again(const std::filesystem::path& folder, const std::vector<std::string>& methods);

/// K of every tip from the energy of neighbouring crack lengths. Throws CaseError where the case is not static.
post::Table energy_check(const CaseFile& file);

/// Cycles against length of the cracks of a finished growth. Throws CaseError where it is none of tips that grow
/// quasi-statically.
post::Table fatigue(const std::filesystem::path& folder, const ParisLaw& law, double load, double ratio);

/// Writes report.html into the folder of a finished run again. Throws CaseError where it is no such folder.
void report_again(const std::filesystem::path& folder);

}  // namespace cases
