#pragma once
#include <string>
#include <vector>

#include "post/files/summary.hpp"

namespace post {

struct Table;

/// Of every tip and of |K1|, |K2|, |K3| and G the largest, by recommended methods, and the load case or combination
/// that gives it. Where one has a factor that is not resolved, the error is at least what that may be beyond.
std::vector<EnvelopeEntry> envelope(const std::vector<LoadCaseSummary>& cases);
/// tip, x, y, quantity, value, estimated_error, case.
Table envelope_table(const std::vector<EnvelopeEntry>& entries);

/// Adds the column `case`: the name of the load case or combination whose number, from 1, is in the column `time`.
void name_cases(Table& table, const std::vector<LoadCaseSummary>& cases);

/// A row of factors for every load case and tip, the envelope, and a line of reactions for every load case. `si`: with
/// the units of SI.
std::string printed_load_cases(const Summary& summary, bool si, double thickness);

}  // namespace post
