#include "post/studies/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "post/files/summary.hpp"
#include "post/files/table.hpp"

namespace post {
namespace {

using Row = std::vector<Cell>;

std::optional<double> finite(const Cell& cell) {
  const auto* number = std::get_if<double>(&cell);
  return number && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
}

/// The rows of a quantity in one of the tables of a run; no rows where there is none.
Table rows_of(const Quantity& quantity, const std::filesystem::path& folder) {
  const char* name = quantity.tip ? "srif.csv" : quantity.probe ? "probes.csv" : "history.csv";
  if (!std::filesystem::exists(folder / name)) return {};
  const Table all = read_csv(folder / name);
  Table result{all.columns, {}};
  const auto keep = [&](const std::function<bool(const Row&)>& wanted) {
    std::ranges::copy_if(all.rows, std::back_inserter(result.rows), wanted);
  };
  if (quantity.probe) {
    keep([&, probe = all.column("probe")](const Row& row) { return row[probe] == Cell(*quantity.probe); });
  } else if (quantity.tip) {
    const std::size_t tip = all.column("tip"), method = all.column("method");
    Cell chosen = quantity.method;
    const auto of_tip = [&](const Row& row) { return row[tip] == Cell(static_cast<double>(*quantity.tip)); };
    const auto first = std::ranges::find_if(all.rows, of_tip);
    if (quantity.method.empty() && first != all.rows.end()) chosen = (*first)[method];
    keep([&](const Row& row) { return of_tip(row) && row[method] == chosen; });
  } else {
    result.rows = all.rows;
  }
  return result;
}

/// Of the tip of the quantity; null where there are none.
const Srif* srif_of(const Quantity& quantity, const Summary& summary) {
  const auto found = std::ranges::find_if(summary.srif, [&](const Srif& s) {
    return s.tip == quantity.tip && (quantity.method.empty() || s.method == quantity.method);
  });
  return found == summary.srif.end() ? nullptr : &*found;
}

/// Nothing where the factor is not resolved.
std::optional<double> factor(const std::string& name, const Srif& srif) {
  const std::optional<double> values[] = {srif.K1, srif.K2, srif.K3, srif.F1, srif.F2, srif.F3};
  const std::string names[] = {"K1", "K2", "K3", "F1", "F2", "F3"};
  for (std::size_t i = 0; i < 6; ++i)
    if (name == names[i] && srif.resolved[i % 3]) return values[i];
  return std::nullopt;
}

}  // namespace

std::string Quantity::place() const {
  return tip ? fmt::format("tip {}", *tip) : probe.value_or("");
}

const std::vector<std::string>& quantity_names() {
  static const std::vector<std::string> names{"K1", "K2", "K3",      "F1",      "F2",
                                              "F3", "w",  "theta_x", "theta_y", "strain_energy"};
  return names;
}

std::string kind_of_place(const std::string& quantity) {
  if (quantity == "strain_energy") return "";
  return quantity.starts_with('K') || quantity.starts_with('F') ? "tip" : "probe";
}

std::string described(const std::string& quantity) {
  if (quantity == "w") return "deflection w";
  if (quantity == "theta_x") return "rotation \u03b8x";
  if (quantity == "theta_y") return "rotation \u03b8y";
  if (quantity == "strain_energy") return "strain energy";
  return (quantity.starts_with('F') ? "normalized factor " : "intensity factor ") + quantity;
}

std::string si_unit(const std::string& quantity) {
  if (quantity == "w") return "m";
  if (quantity == "strain_energy") return "J";
  if (quantity == "K1" || quantity == "K2") return "N\u00b7\u221am";  // moment per length times root of length
  if (quantity == "K3") return "N/\u221am";
  return "";
}

std::optional<double> value(const Quantity& quantity, const Summary& summary, const std::filesystem::path& folder) {
  if (!quantity.tip) {
    const Table rows = rows_of(quantity, folder);
    return rows.rows.empty() ? std::nullopt : finite(rows.rows.back()[rows.column(quantity.name)]);
  }
  const auto* srif = srif_of(quantity, summary);
  const auto found = srif ? factor(quantity.name, *srif) : std::nullopt;
  return found && std::isfinite(*found) ? found : std::nullopt;
}

std::optional<double> estimated_error(const Quantity& quantity, const Summary& summary) {
  const auto* srif = quantity.name.starts_with('K') ? srif_of(quantity, summary) : nullptr;
  return srif ? srif->errors.at(std::size_t(quantity.name.at(1) - '1')) : std::nullopt;
}

Curve history(const Quantity& quantity, const std::filesystem::path& folder) {
  const Table rows = rows_of(quantity, folder);
  return rows.rows.empty() ? Curve{} : curve(rows, "time", quantity.name);
}

std::string lack(const Quantity& quantity, const Summary& summary) {
  std::vector<std::string> methods;
  for (const Srif& srif : summary.srif)
    if (srif.tip == quantity.tip) methods.push_back(srif.method);
  if (quantity.method.empty() || methods.empty() || std::ranges::find(methods, quantity.method) != methods.end())
    return "the results have no such number";
  return fmt::format("{} has no method {}, but {}", quantity.place(), quantity.method, fmt::join(methods, ", "));
}

Curve curve(const Table& table, const std::string& time, const std::string& name) {
  const std::size_t t = table.column(time), y = table.column(name);
  Curve result;
  for (const Row& row : table.rows) {
    const auto instant = finite(row[t]), found = finite(row[y]);
    if (!instant || !found) continue;
    result.t.push_back(*instant);
    result.y.push_back(*found);
  }
  return result;
}

}  // namespace post
