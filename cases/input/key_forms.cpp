#include "cases/input/key_forms.hpp"

#include "cases/input/keys.hpp"

namespace cases {

std::string analyses(const Kinds& kinds) {
  std::vector<std::string> names;
  for (const auto kind : kinds)
    names.push_back(kind == Analysis::Kind::static_       ? "statics"
                    : kind == Analysis::Kind::dynamic     ? "dynamics"
                    : kind == Analysis::Kind::frequencies ? "frequencies"
                    : kind == Analysis::Kind::buckling    ? "buckling"
                                                          : "harmonic analyses");
  return fmt::format("{}", fmt::join(names, " and "));
}

std::string kind_names(const Kinds& kinds) {
  std::vector<std::string> names;
  for (const auto kind : kinds) names.push_back(analysis_kinds().name(kind));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string Bounds::text(bool whole) const {
  const char* number = whole ? "an integer" : "a number";
  if (std::isinf(low) && std::isinf(high)) return "a finite number";
  if (std::isinf(high)) return fmt::format("{} {} {}", number, low_open ? ">" : ">=", low);
  return fmt::format("{} in {}{}, {}{}", number, low_open ? '(' : '[', low, high, high_open ? ')' : ']');
}

void report_unknown_keys(const Value& table, const std::vector<std::string>& names) {
  constexpr std::size_t most = 100;  // of a table: each is looked for among all keys
  std::size_t found = 0;
  for (const auto& [name, node] : *table.table()) {
    const std::string word(name.str());
    if (std::find(names.begin(), names.end(), word) != names.end()) continue;
    if (++found > most) return table.report_error("has further unknown keys");
    std::string hint = did_you_mean(word, names);
    for (const auto& key : keys())
      if (hint.empty() && key.name.ends_with("." + word)) hint = fmt::format(" (did you mean '{}'?)", key.name);
    if (hint.empty()) hint = fmt::format("; known here: {}", fmt::join(names, ", "));
    const Value unknown(node, table.below(word), table.reading());
    unknown.report_error(fmt::format("unknown key '{}'{}", word, hint));
  }
}

std::string text_of_numbers(std::span<const double> numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(number_text(number));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::optional<std::array<double, 4>> box_of(const Value& given) {
  const auto x = given.numbers(4, "[xmin, ymin, xmax, ymax]");
  if (!x) return std::nullopt;
  const std::array box{(*x)[0], (*x)[1], (*x)[2], (*x)[3]};
  if (box[0] < box[2] && box[1] < box[3]) return box;
  given.refuse("[xmin, ymin, xmax, ymax] with xmin < xmax and ymin < ymax");
  return std::nullopt;
}

bool bare(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

}  // namespace cases
