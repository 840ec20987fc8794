#pragma once
#include <string>
#include <vector>

#include "post/files/table.hpp"

namespace plate {
struct Problem;
}

namespace post {

/// A table as JSON, a list per column; a column without any cell is left out. Of more than `most` rows every n-th is
/// kept, of tables in time all rows of every n-th instant, and those where a column is largest or least.
std::string table_json(const Table& table, std::size_t most = 1500);

/// The rows of srif.csv by the recommended method: the first of each time and tip.
Table recommended(const Table& srifs);

/// Returns these columns only, as far as they are there.
Table columns_of(const Table& table, const std::vector<std::string>& names);

/// Drawing of a plate for a report, as JSON: `edges`, each with `name`, `from`, `to` and the plate on its left,
/// `outline` as vertices, `holes` as vertices or `centre` and `radius`, `cracks`, `supports`, `loads`, `section`.
std::string plate_json(const plate::Problem& problem);

}  // namespace post
