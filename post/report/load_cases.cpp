#include "post/report/load_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "post/files/table.hpp"
#include "post/report/printed.hpp"

namespace post {
namespace {

constexpr double negligible = 1e-6;  // of the largest factor of a tip

bool recommended(const std::vector<Srif>& all, std::size_t i) {
  return i == 0 || all[i - 1].tip != all[i].tip;
}

void print_factors(std::string& text, const Summary& summary, bool si, double thickness) {
  const auto out = std::back_inserter(text);
  std::size_t width = 4;
  for (const auto& one : summary.load_cases) width = std::max(width, one.name.size());
  fmt::format_to(out, "{:<{}} {:>4} {:>13} {:>13} {:>13} {:>8}  method\n", "case", width, "tip", "K1", "K2", "K3",
                 "error");
  if (si) fmt::format_to(out, "{:{}} {:>18} {:>13} {:>13}\n", "", width, "[N m^1/2]", "[N m^1/2]", "[N m^-1/2]");
  for (const auto& one : summary.load_cases)
    for (std::size_t i = 0; i < one.srif.size(); ++i) {
      if (!recommended(one.srif, i)) continue;
      const auto K = factor_texts(one.srif[i], thickness);
      fmt::format_to(out, "{:<{}} {:>4} {:>13} {:>13} {:>13} {:>8}  {}\n", one.name, width, one.srif[i].tip, K[0], K[1],
                     K[2], error_text(one.srif[i], thickness), one.srif[i].method);
    }
}

void print_envelope(std::string& text, const Summary& summary, double thickness) {
  const auto out = std::back_inserter(text);
  const auto size = [&](const EnvelopeEntry& one) {
    return std::max(std::abs(one.value), one.error.value_or(0)) * (one.quantity == "K3" ? thickness : 1);
  };
  fmt::format_to(out, "largest of all load cases and combinations:\n");
  for (const auto& one : summary.envelope) {
    const bool noise = one.quantity != "G" && std::ranges::any_of(summary.envelope, [&](const EnvelopeEntry& other) {
                         return other.tip == one.tip && other.quantity != "G" && size(one) < negligible * size(other);
                       });
    const bool known = one.error.value_or(0) <= std::abs(one.value);
    if (!noise)
      fmt::format_to(out, "{:>4} {:<3} {:>13} {:<11}  {}\n", one.tip, one.quantity,
                     known ? fmt::format("{:.6g}", one.value) : "-",
                     one.error ? fmt::format("+- {:.2g}", *one.error) : "", known ? one.of : "not resolved in all");
  }
}

void print_reactions(std::string& text, const Summary& summary, bool si) {
  constexpr std::size_t most = 8;
  for (const auto& one : summary.load_cases) {
    if (!one.reactions) continue;
    const auto& balance = one.reactions->balance;
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < std::min(most, balance.supports.size()); ++i) {
      const double force = balance.supports[i].force;
      const bool small = std::abs(force) < negligible * std::abs(balance.loads.force);
      parts.push_back(fmt::format("{} {:.5g}", one.reactions->supports[i].name, small ? 0 : force));
    }
    if (balance.supports.size() > most) parts.push_back(fmt::format("... ({} in all)", balance.supports.size()));
    fmt::format_to(std::back_inserter(text), "reactions along w{}, {}: {}; loads {:.5g}; balanced to {:.1e}\n",
                   si ? " [N]" : "", one.name, fmt::join(parts, ", "), balance.loads.force, balance.residual);
  }
}

}  // namespace

std::vector<EnvelopeEntry> envelope(const std::vector<LoadCaseSummary>& cases) {
  static const std::array names{"K1", "K2", "K3", "G"};
  std::map<std::pair<std::size_t, std::size_t>, EnvelopeEntry> found;
  std::map<std::pair<std::size_t, std::size_t>, double> lost;  // what factors that are not resolved may be
  for (const auto& one : cases)
    for (std::size_t i = 0; i < one.srif.size(); ++i) {
      const auto& srif = one.srif[i];
      if (!recommended(one.srif, i)) continue;
      for (std::size_t k = 0; k < 3; ++k)
        if (auto& most = lost[{srif.tip, k}]; !srif.resolved[k])
          most = std::max(most, std::abs(std::array{srif.K1, srif.K2, srif.K3}[k]) + srif.errors[k].value_or(0));
      const std::array<std::optional<double>, 4> values{srif.K1, srif.K2, srif.K3, srif.G};
      for (std::size_t k = 0; k < 4; ++k) {
        if (!values[k] || (k < 3 && !srif.resolved[k])) continue;
        const auto error = k < 3 ? srif.errors[k] : std::nullopt;
        const EnvelopeEntry entry{srif.tip, srif.position, names[k], *values[k], error, one.name};
        const auto [there, is_new] = found.emplace(std::pair(srif.tip, k), entry);
        if (!is_new && std::abs(entry.value) > std::abs(there->second.value)) there->second = entry;
      }
    }
  std::vector<EnvelopeEntry> result;
  for (auto& [key, entry] : found) {
    if (const double more = lost[key] - std::abs(entry.value); more > entry.error.value_or(0)) entry.error = more;
    result.push_back(std::move(entry));
  }
  return result;
}

Table envelope_table(const std::vector<EnvelopeEntry>& entries) {
  Table table{{"tip", "x", "y", "quantity", "value", "estimated_error", "case"}, {}};
  for (const auto& one : entries)
    table.rows.push_back({double(one.tip), one.position.x(), one.position.y(), one.quantity, one.value,
                          one.error ? Cell(*one.error) : Cell(), one.of});
  return table;
}

void name_cases(Table& table, const std::vector<LoadCaseSummary>& cases) {
  const auto time = table.column("time");
  table.columns.emplace_back("case");
  for (auto& row : table.rows) row.emplace_back(cases.at(std::size_t(std::get<double>(row[time])) - 1).name);
}

std::string printed_load_cases(const Summary& summary, bool si, double thickness) {
  std::string text;
  const bool factors = std::ranges::any_of(summary.load_cases, [](const auto& one) { return !one.srif.empty(); });
  if (factors) print_factors(text, summary, si, thickness);
  if (!summary.envelope.empty()) print_envelope(text, summary, thickness);
  print_reactions(text, summary, si);
  for (const auto& one : summary.load_cases)
    for (const auto& peak : one.extremes)
      if (peak.quantity == "w" && peak.position)
        fmt::format_to(std::back_inserter(text), "largest |w|, {}: {:.6g} at {}\n", one.name, peak.value,
                       place_text(*peak.position, thickness));
  return text;
}

}  // namespace post
