#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace post {

/// Characters of a UTF-8 text.
std::size_t characters(const std::string& utf8);

/// A column of a text table: its title and its cells.
struct TextColumn {
  std::string title;
  bool number = false;  // to the right
  std::vector<std::string> cells = {};
};

/// One line of titles and one per row, columns two blanks apart. All columns have the same number of cells.
std::string aligned(const std::vector<TextColumn>& columns);

/// A message in one line.
std::string one_line(std::string text);

}  // namespace post
