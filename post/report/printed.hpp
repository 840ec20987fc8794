#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plate {
struct Section;
}

namespace post {

struct EnvelopeEntry;
struct LoadCaseSummary;
struct Summary;
struct Table;

/// Text for the user at the end of a run: one row of factors per tip by the recommended method, the other methods below
/// as a comparison, peaks of a motion, growth, warnings. `si`: with the units of SI. A factor is printed as 0 below
/// 1e-8 of the largest of its tip, below 1e-6 of it and its estimated error, or below a twentieth of an error under 3
/// %. The error of a row is that of the factors that it has: one that is not resolved is "-" and does not count.
std::string printed(const Summary& summary, bool si, double thickness, const std::filesystem::path& folder);

/// The line that names the folder of the results, and report.html where it was written.
std::string results_in(const std::filesystem::path& folder);

/// Largest |K1|, |K2|, |K3| and G of every tip, by recommended methods, of loads in the plane |N1| and |N2|, and with a
/// toughness the utilisation; and the load case or combination that gives each. Where one has a factor that is not
/// resolved, the error is at least the amount by which that factor may be larger. The largest utilisation comes first.
std::vector<EnvelopeEntry> envelope(const std::vector<LoadCaseSummary>& cases, const plate::Section& section,
                                    std::optional<double> toughness);
/// tip, x, y, quantity, value, estimated_error, case.
Table envelope_table(const std::vector<EnvelopeEntry>& entries);

/// Adds the column `case`: the name of the load case or combination whose number, from 1, is in the column `time`.
void name_cases(Table& table, const std::vector<LoadCaseSummary>& cases);

/// A row of factors for every load case and tip, those of loads in the plane and utilisations where there are any, the
/// envelope, and a line of reactions for every load case. `si`: with the units of SI.
std::string printed_load_cases(const Summary& summary, bool si, double thickness);

}  // namespace post
