#include "geometry/cells/rows/row_runs.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace geometry {

std::vector<Columns> common(const std::vector<Columns>& one, const std::vector<Columns>& other) {
  std::vector<Columns> result;
  for (std::size_t a = 0, b = 0; a < one.size() && b < other.size();) {
    const Columns both{std::max(one[a].first, other[b].first), std::min(one[a].second, other[b].second)};
    if (both.first < both.second) result.push_back(both);
    one[a].second < other[b].second ? ++a : ++b;
  }
  return result;
}

std::vector<Columns> joined(const std::vector<Columns>& one, const std::vector<Columns>& other) {
  std::vector<Columns> all(one.size() + other.size()), result;
  std::ranges::merge(one, other, all.begin());
  for (const auto& next : all)
    if (!result.empty() && next.first <= result.back().second)
      result.back().second = std::max(result.back().second, next.second);
    else
      result.push_back(next);
  return result;
}

std::vector<Columns> without(const std::vector<Columns>& one, const std::vector<Columns>& other) {
  std::vector<Columns> result;
  std::size_t b = 0;
  for (auto [from, to] : one) {
    while (b < other.size() && other[b].second <= from) ++b;
    for (auto next = b; next < other.size() && other[next].first < to; ++next) {
      if (from < other[next].first) result.emplace_back(from, other[next].first);
      from = std::max(from, other[next].second);
    }
    if (from < to) result.emplace_back(from, to);
  }
  return result;
}

void RowRuns::add(const Columns& columns) {
  if (columns.first >= columns.second) return;
  if (columns.second - columns.first > long(std::numeric_limits<std::uint32_t>::max() - size_))
    throw std::length_error("a lattice of more than 4294967295 points: their numbers have 32 bits");
  if (runs_.size() > first_.back() && runs_.back().to == columns.first)
    runs_.back().to = std::int32_t(columns.second);
  else
    runs_.push_back({std::int32_t(columns.first), std::int32_t(columns.second), size_});
  size_ += std::uint32_t(columns.second - columns.first);
}

std::span<const RowRuns::Run> RowRuns::row(long j) const {
  if (j < 0 || j >= rows()) return {};
  const auto begin = first_[std::size_t(j)], end = j + 1 < rows() ? first_[std::size_t(j) + 1] : runs_.size();
  return std::span(runs_).subspan(begin, end - begin);
}

std::vector<Columns> RowRuns::columns(long j) const {
  std::vector<Columns> result;
  for (const auto& run : row(j)) result.emplace_back(run.from, run.to);
  return result;
}

const RowRuns::Run* RowRuns::run_at(long i, long j) const {
  const auto runs = row(j);
  const auto after = std::ranges::upper_bound(runs, i, {}, [](const Run& run) { return long(run.from); });
  if (after == runs.begin() || (after - 1)->to <= i) return nullptr;
  return &*(after - 1);
}

std::optional<std::uint32_t> RowRuns::at(long i, long j) const {
  const auto* run = run_at(i, j);
  return run ? std::optional(std::uint32_t(run->number + (i - run->from))) : std::nullopt;
}

std::pair<long, long> RowRuns::place(std::uint32_t number) const {
  const auto run = std::ranges::upper_bound(runs_, number, {}, &Run::number) - 1;
  const auto row = std::ranges::upper_bound(first_, std::size_t(run - runs_.begin())) - 1;
  return {run->from + long(number - run->number), long(row - first_.begin())};
}

RowRuns RowRuns::except(std::span<const std::uint32_t> numbers) const {
  RowRuns result;
  auto next = numbers.begin();
  for (long j = 0; j < rows(); ++j) {
    result.begin_row();
    for (const auto& run : row(j)) {
      long from = run.from;
      const auto end = run.number + std::uint32_t(run.to - run.from);
      for (; next != numbers.end() && *next < end; ++next) {
        const long gone = run.from + long(*next - run.number);
        result.add({from, gone});
        from = gone + 1;
      }
      result.add({from, run.to});
    }
  }
  return result;
}

}  // namespace geometry
