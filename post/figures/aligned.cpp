#include "post/figures/aligned.hpp"

#include <algorithm>

namespace post {
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
