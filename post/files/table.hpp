#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace post {

/// A cell of a table: empty, a number (written so that reading gives the same double) or a word.
using Cell = std::variant<std::monostate, double, std::string>;

/// The cell of a number or word; empty without one.
template <class Number>
Cell cell(const std::optional<Number>& number) {
  return number ? Cell(static_cast<double>(*number)) : Cell();
}

inline Cell cell(const std::string& word) {
  return word.empty() ? Cell() : Cell(word);
}

/// Rows under named columns; what history.csv, probes.csv and srif.csv are made of.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;

  /// Index of a column; throws std::out_of_range with the columns that exist.
  std::size_t column(const std::string& name) const;
};

/// Adds the rows of a table with the same columns; an empty table takes the columns too.
void append(Table& table, const Table& other);

/// Returns the table as comma-separated text. Throws std::invalid_argument where a row does not fit the columns.
std::string csv_text(const Table& table);

void write_csv(const std::filesystem::path& path, const Table& table);

/// Reads comma-separated text with a header line; lines that begin with # are comments.
/// Throws std::runtime_error with file:line where a row does not fit the header.
Table read_csv(const std::filesystem::path& path);

/// Characters of a UTF-8 text.
std::size_t characters(const std::string& utf8);

/// A column of a text table: its title and its cells.
struct TextColumn {
  std::string title;
  bool number = false;  // to the right
  std::vector<std::string> cells = {};
};

/// Aligned text: a line of titles and one per row, columns two blanks apart. All columns have the same number of cells.
std::string aligned(const std::vector<TextColumn>& columns);

/// A message in one line.
std::string one_line(std::string text);

}  // namespace post
