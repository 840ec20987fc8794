#include "post/files/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>

#include "post/files/atomic_file.hpp"

namespace post {
namespace {

std::optional<double> number(const std::string& text) {
  double value = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (rest != end || error != std::errc{}) return std::nullopt;
  return value;
}

std::string trimmed(const std::string& text) {
  constexpr auto blanks = " \t\r";
  const auto begin = text.find_first_not_of(blanks);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Quoted where it would be read as something else: as two cells, a comment, a number or an empty cell.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && word == trimmed(word) && word.find_first_of(",\"\r\n#") == std::string::npos;
  if (plain && !number(word)) return word;
  std::string result = "\"";
  for (const char c : word) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

std::string text_of(const Cell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return fmt::format("{}", *value + 0.0);  // no -0
  if (const auto* word = std::get_if<std::string>(&cell)) return quoted(*word);
  return {};
}

/// Goes through the text row by row and knows the line for messages.
class CsvReader {
public:
  CsvReader(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {
    if (text_.starts_with("\xEF\xBB\xBF")) position_ = 3;
  }

  std::size_t row_line() const { return row_line_; }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", name_, row_line_, what));
  }

  /// The cells of the next row that is not a comment; nothing at the end of the text.
  std::optional<std::vector<Cell>> next() {
    while (position_ < text_.size() && text_[position_] == '#') {
      position_ = std::min(text_.find('\n', position_), text_.size() - 1) + 1;
      ++line_;
    }
    if (position_ >= text_.size()) return std::nullopt;
    row_line_ = line_;
    std::vector<Cell> cells;
    do cells.push_back(cell());
    while (!at_row_end());
    return cells;
  }

private:
  /// Steps over the separator behind a cell: true where the row ends.
  bool at_row_end() {
    if (position_ >= text_.size()) return true;
    const char separator = text_[position_++];
    line_ += separator == '\n';
    return separator == '\n';
  }

  Cell cell() {
    const auto begin = text_.find_first_not_of(" \t", position_);
    if (begin != std::string::npos && text_[begin] == '"') return quoted_cell(begin + 1);
    const auto end = std::min(text_.find_first_of(",\n", position_), text_.size());
    const std::string word = trimmed(text_.substr(position_, end - position_));
    position_ = end;
    if (word.empty()) return {};
    if (const auto value = number(word)) return *value;
    return word;
  }

  Cell quoted_cell(std::size_t begin) {
    std::string word;
    for (position_ = begin; position_ < text_.size(); ++position_) {
      const bool quote = text_[position_] == '"';
      if (quote && !text_.substr(position_ + 1, 1).starts_with('"')) break;
      word += text_[position_];
      position_ += quote;
      line_ += text_[position_] == '\n';
    }
    if (position_ >= text_.size()) fail("a quotation mark is not closed");
    const auto end = std::min(text_.find_first_of(",\n", ++position_), text_.size());
    if (!trimmed(text_.substr(position_, end - position_)).empty()) fail("text behind a closing quotation mark");
    position_ = end;
    return word;
  }

  std::string name_, text_;
  std::size_t position_ = 0, line_ = 1, row_line_ = 1;
};

std::vector<std::string> header(const CsvReader& reader, const std::vector<Cell>& cells) {
  std::vector<std::string> names;
  for (const Cell& cell : cells) {
    const std::string name = std::holds_alternative<std::string>(cell) ? std::get<std::string>(cell) : text_of(cell);
    if (name.empty()) reader.fail(fmt::format("column {} has no name", names.size() + 1));
    if (std::ranges::find(names, name) != names.end()) reader.fail(fmt::format("column {} appears twice", name));
    names.push_back(name);
  }
  return names;
}

}  // namespace

std::size_t Table::column(const std::string& name) const {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end()) {
    throw std::out_of_range(fmt::format("no column {}; there are {}", name, fmt::join(columns, ", ")));
  }
  return static_cast<std::size_t>(found - columns.begin());
}

void append(Table& table, const Table& other) {
  if (table.columns.empty()) table.columns = other.columns;
  table.rows.insert(table.rows.end(), other.rows.begin(), other.rows.end());
}

std::string csv_text(const Table& table) {
  std::string text;
  const auto add_line = [&text](const auto& cells, const auto& to_text) {
    const char* separator = "";
    for (const auto& cell : cells) {
      text += separator;
      text += to_text(cell);
      separator = ",";
    }
    text += '\n';
  };
  add_line(table.columns, quoted);
  for (const auto& row : table.rows) {
    if (row.size() != table.columns.size()) {
      throw std::invalid_argument(fmt::format("a row has {} cells for {} columns", row.size(), table.columns.size()));
    }
    add_line(row, text_of);
  }
  return text;
}

void write_csv(const std::filesystem::path& path, const Table& table) {
  write_atomically(path, csv_text(table));
}

Table read_csv(const std::filesystem::path& path) {
  CsvReader reader(path.string(), read_text(path));
  Table table;
  while (auto row = reader.next()) {
    const bool blank = row->size() == 1 && std::holds_alternative<std::monostate>(row->front());
    if (blank && table.columns.size() != 1) continue;
    if (table.columns.empty()) {
      table.columns = header(reader, *row);
    } else if (row->size() != table.columns.size()) {
      reader.fail(fmt::format("{} cells for {} columns", row->size(), table.columns.size()));
    } else {
      table.rows.push_back(std::move(*row));
    }
  }
  if (table.columns.empty()) throw std::runtime_error(path.string() + ": no header line");
  return table;
}

std::size_t characters(const std::string& utf8) {
  return static_cast<std::size_t>(
      std::ranges::count_if(utf8, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

namespace {

std::string padded(const std::string& text, std::size_t wide, bool right) {
  const std::string blanks(wide - characters(text), ' ');
  return right ? blanks + text : text + blanks;
}

}  // namespace

std::string aligned(const std::vector<TextColumn>& columns) {
  if (columns.empty()) return "";
  std::vector<std::string> lines(columns.front().cells.size() + 1);
  for (const auto& column : columns) {
    std::size_t wide = characters(column.title);
    for (const auto& text : column.cells) wide = std::max(wide, characters(text));
    lines.front() += padded(column.title, wide, column.number) + "  ";
    for (std::size_t row = 0; row + 1 < lines.size(); ++row)
      lines[row + 1] += padded(column.cells[row], wide, column.number) + "  ";
  }
  std::string text;
  for (auto& line : lines) text += line.erase(line.find_last_not_of(' ') + 1) + "\n";
  return text;
}

std::string one_line(std::string text) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) text.replace(at, 1, "; ");
  return text;
}

}  // namespace post
