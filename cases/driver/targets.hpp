#pragma once
#include <memory>

namespace post {
struct Summary;
struct TargetsSummary;
}  // namespace post

namespace cases {

struct AccuracyTargets;
struct CaseFile;
struct Prepared;
struct RunOptions;

/// Sets what results with their estimated errors have reached of the targets: of each the error of the worst over the
/// result; of reactions over the largest force. With load cases of the worst of them. Absent without errors.
void set_reached(const post::Summary& results, post::TargetsSummary& found);

/// The targets that a case asks for.
post::TargetsSummary targets_of(const AccuracyTargets& asked);

/// Refines until every result of a case at rest, or every frequency, is known to the share that [accuracy] asks, or
/// time, memory or sizes end it. Returns the finest plate, with results of the one before by which its errors are
/// estimated. Throws CaseError and plate::NumericalError.
std::unique_ptr<Prepared> to_targets(const CaseFile& file, const RunOptions& options);

}  // namespace cases
