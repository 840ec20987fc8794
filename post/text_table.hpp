#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace post {

/// Characters of a UTF-8 text.
std::size_t characters(const std::string& utf8);

/// A column of a table that is printed: its title and its cells.
struct TextColumn {
  std::string title;
  bool number;  // to the right
  std::vector<std::string> cells;
};

/// Columns side by side under their titles, aligned; of the same number of cells each.
std::string aligned(const std::vector<TextColumn>& columns);

}  // namespace post
