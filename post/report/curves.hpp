#pragma once
#include <string>
#include <vector>

namespace post {

struct CurvePlot;
struct Srif;
struct Table;

/// A motion: K1, K2 and K3 of every tip against time by its recommended method, with gaps where a factor is not
/// resolved, a panel for each that any tip has; the largest deflection; energies. `rows` of factors at `times`;
/// `history`: the columns of history.csv. `si`: with the units of SI.
CurvePlot curves_of_motion(const std::string& title, const std::vector<double>& times,
                           const std::vector<std::vector<Srif>>& rows, const Table& history, bool si);

/// A quasi-static growth: load factor and energies against the length of all cracks; `growth`: the columns of
/// growth.csv.
CurvePlot curves_of_growth(const std::string& title, const Table& growth, bool si);

/// A path of equilibria by arc length: load factor against the deflection of a point, and energy; `steps`: the columns
/// of load_steps.csv.
CurvePlot curves_of_path(const std::string& title, const Table& steps, bool si);

/// Returns curves_of_growth() as SVG.
std::string picture_of_growth(const std::string& title, const Table& growth, bool si);

}  // namespace post
