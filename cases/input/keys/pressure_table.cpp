#include "cases/input/keys.hpp"
#include "plate/model/loads.hpp"

namespace cases {

using plate::Load;

/// A file of pressures beside the case, and what it said when the case was resolved.
Field<Load> table_field() {
  return value<Load>(
      {"table", "-", "a CSV file with the columns x, y, pressure", "",
       "the pressure at places, sought beside the case: bilinear on a grid, else linear on triangles"},
      [](const Value& given, Load& load) {
        const auto text = given.text();
        if (text) try {
            load.table = plate::PressureTable(given.reading().folder / *text);
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
