#pragma once
#include "cases/input/keys/field.hpp"

/// The forms that a field can have: number, choice of words, table, list of tables, or a value read in its own way.
namespace cases {

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

/// One of some words; `refused` are known words with the reason why they are not available.
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
        given.complain(fmt::format("\"{}\" is not available: {}; allowed: {}", text, word.second, this->text()));
        return std::nullopt;
      }
    given.complain(fmt::format("\"{}\" given, must be one of {}{}", text, this->text(), did_you_mean(text, names())));
    return std::nullopt;
  }
};

/// Letters, digits, _ and - only?
bool bare(const std::string& name);

/// A list of words without repetition.
std::vector<std::string> chosen(const Value& given, const Words<int>& words);

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
    const auto elements = given.elements(layout == Layout::block ? "[[" + name + "]]" : name + " = [ { ... }, ... ]");
    if (!elements) return;
    for (const auto& element : *elements) {
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
