#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <set>
#include "cases/input/toml_reader.hpp"
#include "post/manual/program.hpp"

/// The table of keys is a tree of fields. A field names one key of a table that is read into a T, documents it, reads
/// it and writes it; a table is a field whose reading reads the fields below it.
namespace cases {

using plate::Analysis;
using Key = post::ManualKey;

using Kinds = std::set<Analysis::Kind>;
inline const Kinds any_kind{Analysis::Kind::static_, Analysis::Kind::dynamic, Analysis::Kind::frequencies,
                            Analysis::Kind::harmonic};

/// "statics and frequencies"
std::string analyses(const Kinds& kinds);
/// "static, frequencies", as the values of analysis.kind
std::string kind_names(const Kinds& kinds);

/// What must hold of its table for a key to be used: another key (`selector`) has one of some values, in words
/// "kind = pinned".
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
  bool found = false;         // by the program, where srif.accuracy is given
  bool reads_absent = false;  // a table whose keys are missed where it is absent
  std::optional<Condition<T>> condition = std::nullopt;

  Field required(const Kinds& in = any_kind) && {
    needed = in;
    rows.front().standard = in == any_kind ? "required" : "required in " + analyses(in);
    return std::move(*this);
  }
  Field unless_found() && {
    found = true;
    rows.front().standard += ", but with srif.accuracy";
    return std::move(*this);
  }
  /// Without a word in the help.
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

void complain_about_unknown(const Value& table, const std::vector<std::string>& names);

/// Why a key of a table is not used beside the others; empty where it is.
template <class T>
std::string unused(const Field<T>& field, const Value& table, const T& object) {
  const auto kind = table.reading().kind;
  if (kind && !field.used.contains(*kind)) return "in " + analyses(field.used);
  const auto& condition = field.condition;
  if (!condition || !table.reading().sound(table.below(condition->selector)) || condition->holds(object)) return "";
  return "with " + condition->words;
}

/// Is the key missed where it is absent? Not where the key that decides about it is itself wrong.
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
  complain_about_unknown(table, names);
  static const toml::table nothing;
  for (const auto& field : fields) {
    const toml::node* node = entries->get(field.name);
    const std::string key = table.below(field.name), only = unused(field, table, object);
    if (node && only.empty())
      field.read(Value(*node, key, table.reading()), object);
    else if (node)
      Value(*node, key, table.reading()).complain(fmt::format("is used {} only: remove it", only));
    else if (field.reads_absent)
      field.read(Value(nothing, key, table.reading()), object);
    else if (only.empty() && missed(field, table))
      table.reading().complain(key, fmt::format("is missing, must be {}", field.rows.front().allowed));
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

}  // namespace cases
