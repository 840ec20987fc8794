#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <set>
#include <span>

#include "cases/input/manual.hpp"
#include "cases/input/toml_reader.hpp"

/// The table of keys is a tree of fields. A field names one key of a table that is read into a T, documents it, reads
/// it and writes it; a table is a field whose reading reads the fields below it.
namespace cases {

using plate::Analysis;
using Key = ManualKey;

using Kinds = std::set<Analysis::Kind>;
inline const Kinds any_kind{Analysis::Kind::static_, Analysis::Kind::dynamic, Analysis::Kind::frequencies,
                            Analysis::Kind::harmonic, Analysis::Kind::buckling};

/// "statics and frequencies"
std::string analyses(const Kinds& kinds);
/// "static, frequencies", as the values of analysis.kind
std::string kind_names(const Kinds& kinds);

/// Condition on its table for a key to be used: another key (`selector`) has one of some values, in words "kind =
/// pinned".
template <class T>
struct Condition {
  std::string selector, words;
  std::function<bool(const T&)> holds;
};

template <class T>
struct Field {
  std::string name;
  std::vector<Key> rows;  // a table has those of its fields
  std::function<void(const Value&, T&)> read;
  std::function<std::string(const T&, Analysis::Kind)> write;  // "name = value"; empty: absent
  Kinds used = any_kind;
  Kinds needed = {};
  bool found = false;         // by the program, where it finds the discretisation
  bool reads_absent = false;  // a table whose keys are missed where it is absent
  std::optional<Condition<T>> condition = std::nullopt;

  Field required(const Kinds& in = any_kind) && {
    needed = in;
    rows.front().standard = in == any_kind ? "required" : "required in " + analyses(in);
    return std::move(*this);
  }
  Field unless_found() && {
    found = true;
    rows.front().standard += ", but with srif.accuracy or [accuracy]";
    return std::move(*this);
  }
  /// Limits the key to kinds of analysis without a word in the help.
  Field used_in(const Kinds& kinds) && {
    used = kinds;
    return std::move(*this);
  }
  Field in(const Kinds& kinds) && {
    used = kinds;
    for (auto& row : rows) row.help = kind_names(kinds) + ": " + row.help;
    return std::move(*this);
  }
  Field in_dynamics() && { return std::move(*this).in({Analysis::Kind::dynamic}); }
  Field with(Condition<T> c) && {
    for (auto& row : rows) row.help = fmt::format("{}: {}", c.words, row.help);
    condition = std::move(c);
    return std::move(*this);
  }
  Field standard(const std::string& text) && {
    rows.front().standard = text;
    return std::move(*this);
  }
};

template <class T>
using Fields = std::vector<Field<T>>;

/// An interval; a bound that is infinite is none.
struct Bounds {
  double low = -INFINITY, high = INFINITY;
  bool low_open = false, high_open = false;

  bool contain(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }
  std::string text(bool whole) const;
};
inline const Bounds finite{}, positive{0, INFINITY, true};

void report_unknown_keys(const Value& table, const std::vector<std::string>& names);

/// Reason why a key of a table is not used beside the others; empty where it is.
template <class T>
std::string unused(const Field<T>& field, const Value& table, const T& object) {
  const auto kind = table.reading().kind;
  if (kind && !field.used.contains(*kind)) return "in " + analyses(field.used);
  const auto& condition = field.condition;
  if (!condition || !table.reading().sound(table.below(condition->selector)) || condition->holds(object)) return "";
  return "with " + condition->words;
}

/// True where the key is missed because it is absent. False where the key that decides about it is itself wrong.
template <class T>
bool missed(const Field<T>& field, const Value& table) {
  const auto& reading = table.reading();
  if (field.found && reading.finds_spacing) return false;
  if (field.condition && !reading.sound(table.below(field.condition->selector))) return false;
  if (!reading.kind) return field.used == any_kind && field.needed == any_kind;
  return field.needed.contains(*reading.kind);
}

template <class T>
void read_fields(const Fields<T>& fields, const Value& table, T& object) {
  const toml::table* entries = table.table();
  if (!entries) return;
  std::vector<std::string> names;
  for (const auto& field : fields) names.push_back(field.name);
  report_unknown_keys(table, names);
  static const toml::table nothing;
  for (const auto& field : fields) {
    const toml::node* node = entries->get(field.name);
    const std::string key = table.below(field.name), only = unused(field, table, object);
    if (node && only.empty())
      field.read(Value(*node, key, table.reading()), object);
    else if (node)
      Value(*node, key, table.reading()).report_error(fmt::format("is used {} only: remove it", only));
    else if (field.reads_absent)
      field.read(Value(nothing, key, table.reading()), object);
    else if (only.empty() && missed(field, table))
      table.reading().report_error(key, fmt::format("is missing, must be {}", field.rows.front().allowed));
  }
}

template <class T>
std::string write_fields(const Fields<T>& fields, const T& object, Analysis::Kind kind, const char* separator) {
  std::vector<std::string> texts;
  for (const auto& field : fields) {
    if (!field.used.contains(kind)) continue;
    if (field.condition && !field.condition->holds(object)) continue;
    if (auto text = field.write(object, kind); !text.empty()) texts.push_back(std::move(text));
  }
  return fmt::format("{}", fmt::join(texts, separator));
}

// The forms that a field can have: number, boolean, choice of words, table, list of tables, or a value read in its own
// way.

/// A key with a value of its own way of reading and writing; `text` is the TOML of the value, empty where absent.
template <class T>
Field<T> value(Key key, std::function<void(const Value&, T&)> read, std::function<std::string(const T&)> text) {
  if (key.standard.empty()) key.standard = text(T{});
  if (key.standard.empty()) key.standard = "absent";
  Field<T> field{key.name, {key}, std::move(read), {}};
  field.write = [name = key.name, text](const T& object, Analysis::Kind) {
    const auto written = text(object);
    return written.empty() ? written : name + " = " + written;
  };
  return field;
}

/// A number. What lies outside its bounds, such as a thickness of 0 before it is read, counts as absent.
template <class T, class Project>
Field<T> number(const std::string& name, const std::string& unit, Project project, Bounds bounds,
                const std::string& help) {
  using Member = std::remove_cvref_t<std::invoke_result_t<Project, T&>>;
  const bool whole = std::is_integral_v<Member>;
  const std::string allowed = bounds.text(whole);
  const auto read = [=](const Value& given, T& object) {
    const auto x = given.number();
    if (!x) return;
    if (!bounds.contain(*x) || (whole && *x != std::floor(*x))) return given.refuse(allowed);
    if constexpr (std::is_integral_v<Member>)
      std::invoke(project, object) = static_cast<Member>(*x);
    else
      std::invoke(project, object) = *x;
  };
  const auto text = [=](const T& object) -> std::string {
    const std::optional<double> x = std::invoke(project, object);
    return x && bounds.contain(*x) ? number_text(*x) : "";
  };
  return value<T>({name, unit, allowed, "", help}, read, text);
}

/// True or false.
template <class T, class Project>
Field<T> boolean(const std::string& name, Project project, const std::string& help) {
  const auto read = [=](const Value& given, T& object) {
    if (const auto wanted = given.boolean()) std::invoke(project, object) = *wanted;
  };
  const auto text = [=](const T& object) { return std::string(std::invoke(project, object) ? "true" : "false"); };
  return value<T>({name, "-", "true or false", "", help}, read, text);
}

/// Field whose value is one of some words; `refused` are known words with the reason why they are not available.
template <class V>
struct Words {
  std::vector<std::pair<std::string, V>> allowed;
  std::vector<std::pair<std::string, std::string>> refused = {};

  std::string text() const { return listed(names()); }
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& word : allowed) result.push_back(word.first);
    return result;
  }
  std::string name(const V& v) const {
    for (const auto& word : allowed)
      if (word.second == v) return word.first;
    return "";
  }
  std::optional<V> find(const Value& given, const std::string& text) const {
    for (const auto& word : allowed)
      if (word.first == text) return word.second;
    for (const auto& word : refused)
      if (word.first == text) {
        given.report_error(fmt::format("\"{}\" is not available: {}; allowed: {}", text, word.second, this->text()));
        return std::nullopt;
      }
    given.report_error(
        fmt::format("\"{}\" given, must be one of {}{}", text, this->text(), did_you_mean(text, names())));
    return std::nullopt;
  }
};

/// Letters, digits, _ and - only?
bool bare(const std::string& name);

/// "[1, 2, 3]"
std::string text_of_numbers(std::span<const double> numbers);

/// [xmin, ymin, xmax, ymax], where xmin < xmax and ymin < ymax.
std::optional<std::array<double, 4>> box_of(const Value& given);

/// The values of a list of words without repetition.
template <class V>
std::vector<V> chosen(const Value& given, const Words<V>& words) {
  std::vector<V> result;
  for (const auto& name : given.texts().value_or(std::vector<std::string>())) {
    const auto found = words.find(given, name);
    if (found && std::ranges::find(result, *found) != result.end())
      given.report_error(fmt::format("\"{}\" is named twice", name));
    else if (found)
      result.push_back(*found);
  }
  return result;
}

template <class T, class V, class Project>
Field<T> choice(const std::string& name, Project project, Words<V> words, const std::string& help) {
  const auto read = [=](const Value& given, T& object) {
    const auto text = given.text();
    const auto found = text ? words.find(given, *text) : std::nullopt;
    if (found) std::invoke(project, object) = *found;
  };
  const auto text = [=](const T& object) { return quoted(words.name(std::invoke(project, object))); };
  return value<T>({name, "-", "one of " + words.text(), "", help}, read, text);
}

template <class U>
U& made(U& object) {
  return object;
}
template <class U>
U& made(std::optional<U>& object) {
  return object.emplace();
}
template <class U>
const U* present(const U& object) {
  return &object;
}
template <class U>
const U* present(const std::optional<U>& object) {
  return object ? &*object : nullptr;
}

template <class U>
std::vector<Key> rows_below(const std::string& prefix, const Fields<U>& fields) {
  std::vector<Key> rows;
  for (const auto& field : fields)
    for (Key row : field.rows) {
      row.name = prefix + "." + row.name;
      rows.push_back(std::move(row));
    }
  return rows;
}

enum class Layout { block, inline_ };

/// A table read into what `project` names: an object, or one that exists only where the table is given.
/// `check` sees the table after its fields.
template <class T, class U, class Project>
Field<T> table(const std::string& name, Layout layout, Project project, Fields<U> fields,
               std::function<void(const Value&, U&)> check = {}) {
  Field<T> field{name, rows_below(name, fields), {}, {}};
  field.reads_absent =
      layout == Layout::block && std::is_same_v<U, std::remove_cvref_t<std::invoke_result_t<Project, T&>>>;
  field.read = [=](const Value& given, T& object) {
    U& part = made<U>(std::invoke(project, object));
    read_fields(fields, given, part);
    if (check && given.is_table()) check(given, part);
  };
  field.write = [=](const T& object, Analysis::Kind kind) -> std::string {
    const U* part = present<U>(std::invoke(project, object));
    if (!part) return "";
    if (layout == Layout::block) return fmt::format("\n[{}]\n{}", name, write_fields(fields, *part, kind, "\n"));
    return fmt::format("{} = {{ {} }}", name, write_fields(fields, *part, kind, ", "));
  };
  return field;
}

/// A list of tables: [[name]], or name = [ { ... }, ... ].
template <class T, class U, class Project>
Field<T> tables(const std::string& name, Layout layout, Project project, Fields<U> fields,
                std::function<void(const Value&, U&)> check = {}) {
  Field<T> field{name, rows_below(name + "[]", fields), {}, {}};
  field.read = [=](const Value& given, T& object) {
    const auto form = layout == Layout::block ? "[[" + name + "]]" : name + " = [ { ... }, ... ]";
    for (const auto& element : given.elements(form)) {
      U& part = std::invoke(project, object).emplace_back();
      read_fields(fields, element, part);
      if (check && element.is_table()) check(element, part);
    }
  };
  field.write = [=](const T& object, Analysis::Kind kind) -> std::string {
    std::vector<std::string> texts;
    for (const U& part : std::invoke(project, object))
      texts.push_back(layout == Layout::block
                          ? fmt::format("\n[[{}]]\n{}", name, write_fields(fields, part, kind, "\n"))
                          : fmt::format("{{ {} }}", write_fields(fields, part, kind, ", ")));
    if (layout == Layout::block || texts.empty()) return fmt::format("{}", fmt::join(texts, "\n"));
    return fmt::format("{} = [{}]", name, fmt::join(texts, ", "));
  };
  return field;
}

}  // namespace cases
