#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cases/runs/run_plan.hpp"

namespace post {
struct Summary;
struct Table;
}  // namespace post

namespace cases {

struct CaseFile;
struct ParisLaw;

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
