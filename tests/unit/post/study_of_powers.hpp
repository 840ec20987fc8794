#pragma once
#include <cmath>

#include "cases/studies/study_table.hpp"

/// Studies whose errors are known powers of the spacing.
namespace study_of_powers {

inline cases::StudyRow row(const std::vector<std::string>& labels, const std::string& quantity, double spacing,
                           double computed, std::optional<double> reference) {
  cases::StudyRow result;
  result.labels = labels;
  result.quantity = quantity;
  result.place = quantity == "w" ? "centre" : "tip 0";
  result.spacing = spacing;
  result.horizon = 3 * spacing;
  result.points = static_cast<std::size_t>(std::lround(4 / (spacing * spacing)));
  result.seconds = 1e-3 / std::pow(spacing, 3);
  result.computed = computed;
  result.reference = reference;
  return result;
}

/// Two thicknesses and three spacings: errors of w are -spacing^2 or spacing, those of K1 are 0.3 spacing^1.5.
inline cases::StudyTable study() {
  cases::StudyTable result{{"h", "spacing"}, {}};
  for (const std::string h : {"0.1", "0.2"})
    for (const std::string label : {"0.1", "0.05", "0.025"}) {
      const double spacing = std::stod(label), reference = h == "0.1" ? 4 : -2;
      const double error = h == "0.1" ? -spacing * spacing : spacing;
      result.rows.push_back(row({h, label}, "w", spacing, reference * (1 + error), reference));
      result.rows.push_back(row({h, label}, "K1", spacing, 2 + 0.6 * std::pow(spacing, 1.5), 2.0));
    }
  return result;
}

}  // namespace study_of_powers
