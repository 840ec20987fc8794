#include "cases/input/keys.hpp"
#include "cases/input/load_keys.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/problem.hpp"
#include "post/files/atomic_file.hpp"

namespace cases {
namespace {

template <class T>
Field<T> name_of(const std::string& help) {
  return value<T>(
             {"name", "-", "letters, digits, _ and -", "", help},
             [](const Value& given, T& object) {
               object.name = given.text().value_or("");
               if (given.is_text() && !bare(object.name)) given.refuse("letters, digits, _ and - only");
             },
             [](const T& object) { return object.name.empty() ? "" : quoted(object.name); })
      .required();
}

}  // namespace

Fields<plate::LoadCase> load_case_fields() {
  using C = plate::LoadCase;
  return {
      name_of<C>("of the load case, in results and combinations"),
      tables<C, plate::Load>("load", Layout::inline_, &C::loads, load_fields(), check_load),
  };
}

Fields<plate::Combination> combination_fields() {
  using C = plate::Combination;
  const auto read = [](const Value& given, C& combination) {
    const auto* entries = given.table();
    if (!entries) return;
    for (const auto& [name, node] : *entries) {
      const Value factor(node, given.below(std::string(name.str())), given.reading());
      if (const auto x = factor.number()) combination.of.emplace_back(name.str(), *x);
    }
  };
  const auto write = [](const C& combination) {
    std::vector<std::string> texts;
    for (const auto& [name, factor] : combination.of) texts.push_back(name + " = " + number_text(factor));
    return texts.empty() ? "" : fmt::format("{{ {} }}", fmt::join(texts, ", "));
  };
  return {
      name_of<C>("of the combination, in results"),
      value<C>({"of", "-", "{ name = factor, ... }", "", "what every load case counts for: the states add up"}, read,
               write)
          .required(),
  };
}

using plate::Load;

namespace {

/// Reads a table of pressures, or says why it cannot be read or is none.
std::variant<plate::PressureTable, std::string> read_table(const std::filesystem::path& path) {
  constexpr std::size_t most = 256 << 20;  // bytes
  try {
    if (std::filesystem::is_directory(path)) return "cannot be read";
    return plate::PressureTable::parsed(post::read_text(path, most), path);
  } catch (const std::length_error& error) {
    return error.what();
  } catch (const std::filesystem::filesystem_error&) {
    return "cannot be read";
  }
}

const auto table_of = OfAction(plate::PressureTable{}, [](auto& one) -> decltype((one.table)) { return one.table; });

}  // namespace

/// A file of pressures beside the case, and what it said when the case was resolved.
Field<Load> table_field() {
  return value<Load>(
      {"table", "-", "a CSV file with the columns x, y, pressure", "",
       "the pressure at places, sought beside the case: bilinear on a grid, else linear on triangles"},
      [](const Value& given, Load& load) {
        const auto text = given.text();
        if (!text) return;
        auto found = read_table(given.reading().folder / *text);
        if (const auto* error = std::get_if<std::string>(&found))
          given.report_error(fmt::format("\"{}\": {}", *text, *error));
        else
          table_of(load) = std::get<plate::PressureTable>(std::move(found));
      },
      [](const Load& load) {
        const auto& table = table_of(load);
        return table.given() ? quoted(table.file().string()) : "";
      });
}

Field<Load> table_digest_field() {
  return value<Load>(
      {"table_digest", "-", "16 digits", "", "of what the table says; where given, another table is refused"},
      [](const Value& given, Load& load) {
        const auto text = given.text();
        const auto& table = table_of(load);
        if (text && table.given() && *text != table.digest())
          given.report_error(fmt::format("{} given, but the table has {}: it is another one", *text, table.digest()));
      },
      [](const Load& load) {
        const auto& table = table_of(load);
        return table.given() ? quoted(table.digest()) : "";
      });
}

}  // namespace cases
