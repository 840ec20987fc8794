#include "plate/model/loading/load_cases.hpp"
#include "cases/input/keys.hpp"

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

}  // namespace cases
