#include "post/report/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>

#include "plate/solve/analysis.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "post/report/curve_plot.hpp"

namespace post {
namespace {

using Json = nlohmann::json;

template <class Value>
std::optional<Value> optional(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found == json.end() || found->is_null() ? std::nullopt : std::optional(found->get<Value>());
}

/// Reads the factors of a tip; none by a method of another version.
std::optional<Srif> srif_of(const Json& json) {
  const auto method = srif_method(json.at("method"));
  if (!method) return std::nullopt;
  Srif srif;
  srif.tip = json.at("tip");
  srif.position = {json.at("x").get<double>(), json.at("y").get<double>()};
  srif.method = *method;
  const std::array factors{&srif.K1, &srif.K2, &srif.K3};
  const std::array normalized{&srif.F1, &srif.F2, &srif.F3};
  const std::array<const char*, 3> K{"K1", "K2", "K3"}, F{"F1", "F2", "F3"},
      error{"estimated_error_K1", "estimated_error_K2", "estimated_error_K3"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto factor = optional<double>(json, K[i]);
    srif.resolved[i] = factor.has_value();
    *factors[i] = factor.value_or(0);
    *normalized[i] = optional<double>(json, F[i]);
    srif.errors[i] = optional<double>(json, error[i]);
  }
  srif.estimated_error = optional<double>(json, "estimated_error");
  if (!json.contains("N1")) return srif;
  auto& membrane = srif.membrane.emplace(MembraneFactors{{}, {}, {}, optional<double>(json, "G_in_plane")});
  for (std::size_t i = 0; i < 2; ++i) {
    const auto N = optional<double>(json, i == 0 ? "N1" : "N2");
    membrane.resolved[i] = N.has_value(), membrane.N[i] = N.value_or(0);
    membrane.errors[i] = optional<double>(json, i == 0 ? "estimated_error_N1" : "estimated_error_N2");
  }
  return srif;
}

GrowthSummary growth_of(const Json& json) {
  GrowthSummary growth;
  growth.outcome = json.at("outcome"), growth.resolved = json.value("resolved", true);
  growth.advances = json.at("advances");
  growth.first_load_factor = optional<double>(json, "first_load_factor");
  growth.first_load_factor_error = optional<double>(json, "first_load_factor_error");
  growth.largest_load_factor = optional<double>(json, "largest_load_factor");
  growth.lengths = json.at("lengths").get<std::vector<double>>();
  return growth;
}

/// Reads a summary; none where an analysis or a method is of another version.
std::optional<Summary> summary_of(const Json& json) {
  Summary summary;
  summary.units = json.value("units", ""), summary.title = json.at("title"), summary.outcome = json.at("outcome");
  summary.version = json.at("version"), summary.digest = json.at("digest");
  summary.formulation = json.at("formulation"), summary.formulation_reason = json.value("formulation_reason", "");
  summary.points = json.at("points"), summary.bonds = json.at("bonds");
  const auto kind = plate::analysis_kind(json.at("analysis").at("kind").get<std::string>());
  if (!kind) return std::nullopt;
  summary.analysis.kind = *kind;
  summary.analysis.stop_reason = json.at("analysis").value("stop_reason", "");
  summary.analysis.iterations = optional<std::size_t>(json.at("analysis"), "iterations");
  summary.analysis.steps = optional<std::size_t>(json.at("analysis"), "steps");
  for (const auto& [stage, spent] : json.at("seconds").items()) summary.seconds.emplace_back(stage, spent);
  for (const auto& one : json.at("srif")) {
    auto srif = srif_of(one);
    if (!srif) return std::nullopt;
    summary.srif.push_back(std::move(*srif));
  }
  for (const auto& one : json.value("peaks", Json::array()))
    summary.peaks.push_back(
        {one.at("quantity"), optional<std::size_t>(one, "tip"), one.at("value"), one.at("time"), {}, {}});
  for (const auto& one : json.value("frequencies", Json::array()))
    summary.frequencies.push_back({one.at("mode"), one.at("frequency"), one.at("omega"), one.at("residual")});
  for (const auto& one : json.value("buckling", Json::array()))
    summary.buckling.push_back(
        {one.at("mode"), one.at("factor"), one.at("residual"), optional<double>(one, "estimated_error")});
  if (json.contains("growth")) summary.growth = growth_of(json.at("growth"));
  summary.warnings = json.at("warnings").get<std::vector<std::string>>();
  return summary;
}

using Row = std::vector<Cell>;

/// Description of the quantities of a name.
struct Kind {
  const char *name, *place;
  const char* column;  // of its history, at the last time its value; nullptr: the summary has it
  const char *words, *si;
};

const std::vector<Kind>& kinds() {
  constexpr auto moment = "N\u00b7\u221am", shear = "N/\u221am";  // moment or force per length times root of length
  static const std::vector<Kind> all{{"K1", "tip", "K1", "intensity factor K1", moment},
                                     {"K2", "tip", "K2", "intensity factor K2", moment},
                                     {"K3", "tip", "K3", "intensity factor K3", shear},
                                     {"F1", "tip", "F1", "normalized factor F1", ""},
                                     {"F2", "tip", "F2", "normalized factor F2", ""},
                                     {"F3", "tip", "F3", "normalized factor F3", ""},
                                     {"N1", "tip", "N1", "intensity factor N1 in the plane", shear},
                                     {"N2", "tip", "N2", "intensity factor N2 in the plane", shear},
                                     {"w", "probe", "w", "deflection w", "m"},
                                     {"theta_x", "probe", "theta_x", "rotation \u03b8x", ""},
                                     {"theta_y", "probe", "theta_y", "rotation \u03b8y", ""},
                                     {"u", "probe", "u", "displacement u", "m"},
                                     {"v", "probe", "v", "displacement v", "m"},
                                     {"strain_energy", "", "strain_energy", "strain energy", "J"},
                                     {"kinetic_energy", "", "kinetic_energy", "kinetic energy", "J"},
                                     {"external_work", "", "external_work", "external work", "J"},
                                     {"max_w", "", "max_abs_w", "largest |w|", "m"},
                                     {"K1_peak", "tip", nullptr, "peak of K1 in time", moment},
                                     {"K2_peak", "tip", nullptr, "peak of K2 in time", moment},
                                     {"K3_peak", "tip", nullptr, "peak of K3 in time", shear},
                                     {"w_peak", "", nullptr, "peak of w in time", "m"},
                                     {"frequency", "mode", nullptr, "frequency", "Hz"},
                                     {"buckling_factor", "mode", nullptr, "buckling load factor", ""},
                                     {"largest_load_factor", "", nullptr, "largest load factor", ""},
                                     {"crack_length", "", nullptr, "length of all cracks", "m"}};
  return all;
}

const Kind& kind(const std::string& name) {
  static const Kind none{"", "", nullptr, "", ""};
  const auto found = std::ranges::find_if(kinds(), [&](const Kind& known) { return name == known.name; });
  return found == kinds().end() ? none : *found;
}

std::optional<double> finite(const Cell& cell) {
  const auto* number = std::get_if<double>(&cell);
  return number && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
}

/// The rows of a quantity in one of the tables of a run; no rows where there is none, or the table does not have it.
Table rows_of(const Quantity& quantity, const std::filesystem::path& folder) {
  const char* name = quantity.tip ? "srif.csv" : quantity.probe ? "probes.csv" : "history.csv";
  if (!std::filesystem::exists(folder / name)) return {};
  const Table all = read_csv(folder / name);
  Table result{all.columns, {}};
  if (std::ranges::find(all.columns, kind(quantity.name).column) == all.columns.end()) return result;
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

/// Factors at the tip of the quantity; null where there are none.
const Srif* srif_of(const Quantity& quantity, const Summary& summary) {
  const auto found = std::ranges::find_if(summary.srif, [&](const Srif& s) {
    return s.tip == quantity.tip && (quantity.method.empty() || quantity.method == name_of(s.method));
  });
  return found == summary.srif.end() ? nullptr : &*found;
}

/// Returns a factor by its name; nothing where it is not resolved.
std::optional<double> factor(const std::string& name, const Srif& srif) {
  const std::optional<double> values[] = {srif.K1, srif.K2, srif.K3, srif.F1, srif.F2, srif.F3};
  const std::string names[] = {"K1", "K2", "K3", "F1", "F2", "F3"};
  for (std::size_t i = 0; i < 6; ++i)
    if (name == names[i] && srif.resolved[i % 3]) return values[i];
  const std::size_t in_plane = name == "N2" ? 1 : 0;
  if (name.starts_with('N') && srif.membrane && srif.membrane->resolved[in_plane]) return srif.membrane->N[in_plane];
  return std::nullopt;
}

/// Value of a quantity without history in the summary; nothing where it has none.
std::optional<double> of_summary(const Quantity& quantity, const Summary& summary) {
  if (quantity.name == "frequency") {
    const auto found = std::ranges::find(summary.frequencies, quantity.mode.value_or(0), &Frequency::mode);
    return found == summary.frequencies.end() ? std::nullopt : std::optional(found->frequency);
  }
  if (quantity.name == "buckling_factor") {
    const auto found = std::ranges::find(summary.buckling, quantity.mode.value_or(0), &BucklingFactor::mode);
    return found == summary.buckling.end() ? std::nullopt : std::optional(found->factor);
  }
  const auto& growth = summary.growth;
  if (quantity.name == "largest_load_factor") return growth ? growth->largest_load_factor : std::nullopt;
  if (quantity.name == "crack_length") {
    if (!growth) return std::nullopt;
    return std::accumulate(growth->lengths.begin(), growth->lengths.end(), 0.0);
  }
  const auto end = quantity.name.find("_peak");
  for (const auto& peak : summary.peaks)
    if (end != std::string::npos && peak.quantity == quantity.name.substr(0, end) && peak.tip == quantity.tip)
      return peak.value;
  return std::nullopt;
}

}  // namespace

std::optional<Summary> read_summary(const std::filesystem::path& path) {
  std::ifstream file(path);
  const auto json = Json::parse(file, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    return summary_of(json);
  } catch (const Json::exception&) {
    return std::nullopt;  // of another version
  }
}

std::string Quantity::place() const {
  if (mode) return fmt::format("mode {}", *mode);
  return tip ? fmt::format("tip {}", *tip) : probe.value_or("");
}

const std::vector<std::string>& quantity_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& known : kinds()) result.emplace_back(known.name);
    return result;
  }();
  return names;
}

std::string kind_of_place(const std::string& quantity) {
  return kind(quantity).place;
}

bool has_history(const std::string& quantity) {
  return kind(quantity).column != nullptr;
}

std::string described(const std::string& quantity) {
  return kind(quantity).words;
}

std::string si_unit(const std::string& quantity) {
  return kind(quantity).si;
}

std::string si_unit_of(const std::string& dimension) {
  static const std::map<std::string, std::string> units{{"length", "m"},
                                                        {"time", "s"},
                                                        {"1/time", "1/s"},
                                                        {"force", "N"},
                                                        {"force/length", "N/m"},
                                                        {"force/length^2", "Pa"},
                                                        {"mass/length^3", "kg/m\u00b3"}};
  const auto unit = units.find(dimension);
  return unit == units.end() ? "" : unit->second;
}

std::optional<double> value(const Quantity& quantity, const Summary& summary, const std::filesystem::path& folder) {
  if (!has_history(quantity.name)) return of_summary(quantity, summary);
  if (!quantity.tip) {
    const Table rows = rows_of(quantity, folder);
    return rows.rows.empty() ? std::nullopt : finite(rows.rows.back()[rows.column(kind(quantity.name).column)]);
  }
  const auto* srif = srif_of(quantity, summary);
  const auto found = srif ? factor(quantity.name, *srif) : std::nullopt;
  return found && std::isfinite(*found) ? found : std::nullopt;
}

std::optional<double> estimated_error(const Quantity& quantity, const Summary& summary) {
  const bool in_plane = quantity.name.starts_with('N');
  const auto* srif =
      (in_plane || quantity.name.starts_with('K')) && has_history(quantity.name) ? srif_of(quantity, summary) : nullptr;
  if (!srif || (in_plane && !srif->membrane)) return std::nullopt;
  const auto i = std::size_t(quantity.name.at(1) - '1');
  return in_plane ? srif->membrane->errors.at(i) : srif->errors.at(i);
}

Curve history(const Quantity& quantity, const std::filesystem::path& folder) {
  if (!has_history(quantity.name)) return {};
  const Table rows = rows_of(quantity, folder);
  return rows.rows.empty() ? Curve{} : curve(rows, "time", kind(quantity.name).column);
}

std::string lack(const Quantity& quantity, const Summary& summary) {
  std::vector<std::string> methods;
  for (const Srif& srif : summary.srif)
    if (srif.tip == quantity.tip) methods.push_back(name_of(srif.method));
  if (quantity.method.empty() || methods.empty() || std::ranges::find(methods, quantity.method) != methods.end()) {
    const auto words = [](const char* before, const std::string& text) { return text.empty() ? "" : before + text; };
    return fmt::format("the results have no {}{}{}", quantity.name, words(" of ", quantity.place()),
                       words(" by ", quantity.method));
  }
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
