#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace post {

struct Curve;
struct Summary;
struct Table;

/// Reads from summary.json of a finished run: formulation, outcome, points, bonds, iterations, seconds, factors
/// (without rings and fits), peaks, frequencies, buckling factors, growth, warnings, version and digest. Returns
/// nothing where there is no such file, or it is incomplete.
std::optional<Summary> read_summary(const std::filesystem::path& path);

/// A number that runs are compared by: K1, K2, K3, F1, F2, F3, N1, N2 of a tip, K1_peak, K2_peak, K3_peak of a motion,
/// w, theta_x, theta_y, u, v at a probe, the frequency or the buckling load factor of a mode, or of the whole plate.
/// Has a tip, a probe, a mode or none, as its name asks for.
struct Quantity {
  std::string name;
  std::optional<std::size_t> tip = std::nullopt;
  std::optional<std::string> probe = std::nullopt;
  std::string method = {};                         // of K, F and N; empty: the first of the tip
  std::optional<std::size_t> mode = std::nullopt;  // from 1

  /// "tip 0", the probe's name, or "".
  std::string place() const;
  bool operator==(const Quantity&) const = default;
};

/// The names that a quantity can have.
const std::vector<std::string>& quantity_names();

/// Kind of place of a quantity of this name: "tip", "probe", "mode", or "" for the whole plate.
std::string kind_of_place(const std::string& quantity);

/// Axis label of a quantity: "deflection w".
std::string described(const std::string& quantity);

/// Unit of a quantity in SI; "" without dimension.
std::string si_unit(const std::string& quantity);

/// The unit in SI of "force/length" and so on; "" of any other word.
std::string si_unit_of(const std::string& dimension);

/// True where the quantity changes with the time of a run, so that it has a history.
bool has_history(const std::string& quantity);

/// The quantity at the last time of a finished run, from its summary and the probes.csv and history.csv of its folder.
/// Nothing where the run has no such number, or it is not finite.
std::optional<double> value(const Quantity& quantity, const Summary& summary, const std::filesystem::path& folder);

/// The estimated error of that number, in its units; of K1, K2, K3, N1 and N2 only.
std::optional<double> estimated_error(const Quantity& quantity, const Summary& summary);

/// The quantity at all times that the probes.csv, srif.csv or history.csv of a finished run has; no samples where none
/// has it.
Curve history(const Quantity& quantity, const std::filesystem::path& folder);

/// Reason why a finished run has no such number, as far as its summary tells.
std::string lack(const Quantity& quantity, const Summary& summary);

/// The samples of a curve in two columns of a table, those with a missing value left out.
Curve curve(const Table& table, const std::string& time, const std::string& name);

}  // namespace post
