#include "post/report/html/tables_json.hpp"

#include <algorithm>
#include <set>

#include "post/report/html/page.hpp"

namespace post {
namespace {

const double* number(const Cell& cell) {
  return std::get_if<double>(&cell);
}

/// Has a table several rows of one instant, which stay together: one for each tip, probe or support?
bool is_in_time(const Table& table) {
  return !table.columns.empty() && (table.columns[0] == "time" || table.columns[0] == "advance");
}

std::set<std::size_t> rows_of(const Table& table, std::size_t most) {
  std::set<std::size_t> rows;
  const auto size = table.rows.size(), step = size / most + 1;
  const bool together = is_in_time(table);
  for (std::size_t i = 0, instant = 0; i < size; ++i) {
    const bool same = together && i > 0 && table.rows[i][0] == table.rows[i - 1][0];
    if (i > 0 && !same) ++instant;
    if (instant % step == 0) rows.insert(i);
  }
  if (size == 0) return rows;
  rows.insert(size - 1);
  for (std::size_t column = 0; column < table.columns.size() && step > 1; ++column) {
    std::size_t least = 0, largest = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const auto* x = number(table.rows[i][column]);
      if (!x) continue;
      const auto *low = number(table.rows[least][column]), *high = number(table.rows[largest][column]);
      if (!low || *x < *low) least = i;
      if (!high || *x > *high) largest = i;
    }
    rows.insert({least, largest});
  }
  return rows;
}

std::string text_of(const Cell& cell) {
  constexpr int digits = 8;
  if (const auto* x = number(cell)) return json_number(*x, digits);
  if (const auto* word = std::get_if<std::string>(&cell)) return json_text(*word);
  return "null";
}

}  // namespace

std::string table_json(const Table& table, std::size_t most) {
  const auto rows = rows_of(table, most);
  Members columns;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    std::vector<std::string> cells;
    for (const auto row : rows) cells.push_back(text_of(table.rows[row][column]));
    if (std::ranges::any_of(cells, [](const auto& cell) { return cell != "null"; }))
      columns.emplace_back(table.columns[column], json_list(cells));
  }
  return json_object(columns);
}

Table recommended(const Table& srifs) {
  const auto time = srifs.column("time"), tip = srifs.column("tip");
  Table result{srifs.columns, {}};
  for (const auto& row : srifs.rows)
    if (result.rows.empty() || result.rows.back()[time] != row[time] || result.rows.back()[tip] != row[tip])
      result.rows.push_back(row);
  return result;
}

Table columns_of(const Table& table, const std::vector<std::string>& names) {
  Table result;
  std::vector<std::size_t> from;
  for (const auto& name : names) {
    const auto found = std::ranges::find(table.columns, name);
    if (found == table.columns.end()) continue;
    from.push_back(std::size_t(found - table.columns.begin()));
    result.columns.push_back(name);
  }
  for (const auto& row : table.rows) {
    auto& cells = result.rows.emplace_back();
    for (const auto column : from) cells.push_back(row[column]);
  }
  return result;
}

}  // namespace post
