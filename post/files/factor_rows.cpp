#include "post/files/factor_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "post/factors/errors.hpp"
#include "post/files/gate.hpp"

namespace post {

void FactorRows::add(std::vector<Srif> found, const std::string& when) {
  auto row = known_.empty() ? std::move(found) : known_.at(rows_.size());
  if (known_.empty()) {
    for (auto& srif : row)
      for (const auto& other : coarser_)
        if (other.tip == srif.tip && other.method == srif.method) widen(srif, other, thickness_);
    const auto& [formulation, others] = second_;
    if (rows_.size() < others.size())
      for (auto& srif : row)
        if (const auto other = std::ranges::find(others[rows_.size()], srif.tip, &Srif::tip);
            other != others[rows_.size()].end())
          compare_with(srif, *other, formulation, thickness_);
  }
  require_finite(row, when);
  mark_lost(row, thickness_, largest_);
  rows_.push_back(std::move(row));
}

Table FactorRows::table(const std::vector<double>& times) {
  Table result{srif_columns(), {}};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (auto& srif : rows_[i])
      if (srif.tip < truncated_.size()) widen(srif, truncated_[srif.tip] * largest_[srif.tip], thickness_);
    if (rows_.size() > 1) mark_lost(rows_[i], thickness_, largest_);
    append(result, times[i], rows_[i]);
  }
  return result;
}

std::vector<std::string> FactorRows::distrust() const {
  std::vector<std::string> result;
  for (std::size_t tip = 0; tip < truncated_.size(); ++tip)
    if (truncated_[tip] > 0.03)
      result.push_back(fmt::format(
          "tip {}: Lanczos vectors leave out some {:.2g} % of the largest factor: take a smaller analysis.tolerance",
          tip, 100 * truncated_[tip]));
  return result;
}

std::vector<std::string> srif_columns() {
  return {"time",
          "tip",
          "x",
          "y",
          "method",
          "K1",
          "K2",
          "K3",
          "F1",
          "F2",
          "F3",
          "estimated_error",
          "fit_residual",
          "samples",
          "estimated_error_K1",
          "estimated_error_K2",
          "estimated_error_K3",
          "overlaps_at"};
}

void append(Table& table, double time, const std::vector<Srif>& srifs) {
  if (table.columns.empty()) table.columns = srif_columns();
  for (const Srif& srif : srifs) {
    const auto factor = [&](std::size_t i, const std::optional<double>& value) {
      return srif.resolved[i] ? cell(value) : Cell();
    };
    const auto where = overlap(srif);
    table.rows.push_back({time, static_cast<double>(srif.tip), srif.position.x(), srif.position.y(), srif.method,
                          factor(0, srif.K1), factor(1, srif.K2), factor(2, srif.K3), factor(0, srif.F1),
                          factor(1, srif.F2), factor(2, srif.F3), cell(srif.estimated_error), srif.fit_residual,
                          static_cast<double>(srif.samples), cell(srif.errors[0]), cell(srif.errors[1]),
                          cell(srif.errors[2]), where == Overlap::unknown ? Cell() : Cell(name_of(where))});
  }
}

}  // namespace post
