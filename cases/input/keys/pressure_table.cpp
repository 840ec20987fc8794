#include "cases/input/keys.hpp"
#include "plate/model/loads.hpp"
#include "post/files/whole_file.hpp"

namespace cases {

using plate::Load;

namespace {

/// Throws std::invalid_argument where it is none.
plate::PressureTable read_table(const std::filesystem::path& path) {
  constexpr std::size_t most = 256 << 20;  // bytes
  try {
    if (std::filesystem::is_directory(path)) throw std::invalid_argument("cannot be read");
    return {post::read_text(path, most), path};
  } catch (const std::length_error& error) {
    throw std::invalid_argument(error.what());
  } catch (const std::filesystem::filesystem_error&) {
    throw std::invalid_argument("cannot be read");
  }
}

}  // namespace

/// A file of pressures beside the case, and what it said when the case was resolved.
Field<Load> table_field() {
  return value<Load>(
      {"table", "-", "a CSV file with the columns x, y, pressure", "",
       "the pressure at places, sought beside the case: bilinear on a grid, else linear on triangles"},
      [](const Value& given, Load& load) {
        const auto text = given.text();
        if (text) try {
            load.table = read_table(given.reading().folder / *text);
          } catch (const std::invalid_argument& error) {
            given.complain(fmt::format("\"{}\": {}", *text, error.what()));
          }
      },
      [](const Load& load) { return load.table.given() ? quoted(load.table.file().string()) : ""; });
}

Field<Load> table_digest_field() {
  return value<Load>(
      {"table_digest", "-", "16 digits", "", "of what the table says; where given, another table is refused"},
      [](const Value& given, Load& load) {
        const auto text = given.text();
        if (text && load.table.given() && *text != load.table.digest())
          given.complain(fmt::format("{} given, but the table has {}: it is another one", *text, load.table.digest()));
      },
      [](const Load& load) { return load.table.given() ? quoted(load.table.digest()) : ""; });
}

}  // namespace cases
