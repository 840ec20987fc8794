#include "cases/input/toml_reader.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "cases/input/manual.hpp"
#include "post/files/atomic_file.hpp"

namespace cases {
namespace {

/// True where the key lies at or below another one.
bool at_or_below(const std::string& key, const std::string& parent) {
  if (!key.starts_with(parent)) return false;
  return parent.empty() || key.size() == parent.size() || key[parent.size()] == '.' || key[parent.size()] == '[';
}

}  // namespace

void Reading::note(const std::string& key, std::size_t line) {
  const std::string& file = found_.places.front().second;
  for (const auto& [parent, place] : overridden_)
    if (at_or_below(key, parent)) {
      found_.places.emplace_back(key, place);
      return;
    }
  if (line > 0) found_.places.emplace_back(key, fmt::format("{}:{}", file, line));
}

std::vector<Problem> Reading::problems() const {
  const std::string file = found_.places.front().second + ":";
  const auto line = [&](const Problem& problem) {
    return problem.place.starts_with(file) ? std::atol(problem.place.c_str() + file.size()) : 0;
  };
  auto sorted = problems_;
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) { return line(a) < line(b); });
  return sorted;
}

bool Reading::given(const std::string& key) const {
  for (const auto& place : found_.places)
    if (place.first == key) return true;
  return false;
}

bool Reading::sound(const std::string& key) const {
  for (const auto& problem : problems_)
    if (at_or_below(problem.key, key)) return false;
  return true;
}

Value::Value(const toml::node& node, std::string key, Reading& reading)
    : node_(&node), key_(std::move(key)), reading_(&reading) {
  if (!key_.empty()) reading.note(key_, node.source().begin.line);
}

std::string Value::toml() const {
  if (const auto* number = node_->as_floating_point()) return number_text(number->get());
  if (const auto* word = node_->as_string()) return quoted(word->get());
  std::ostringstream out;
  node_->visit([&](const auto& node) { out << node; });
  std::string text = out.str();
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

std::string Value::shown() const {
  constexpr std::size_t longest = 60;
  const std::string text = toml();
  return text.size() > longest && !is_text() && !node_->is_number() ? text.substr(0, longest) + "..." : text;
}

const toml::table* Value::table() const {
  if (!is_table()) refuse("a table");
  return node_->as_table();
}

std::optional<double> Value::number() const {
  const auto value = node_->is_number() ? node_->value<double>() : std::nullopt;
  if (value && std::isfinite(*value)) return value;
  refuse("a finite number");
  return std::nullopt;
}

std::optional<std::string> Value::text() const {
  if (is_text()) return node_->value<std::string>();
  refuse("a string");
  return std::nullopt;
}

std::optional<bool> Value::boolean() const {
  if (node_->is_boolean()) return node_->value<bool>();
  refuse("true or false");
  return std::nullopt;
}

std::optional<std::vector<double>> Value::numbers(std::size_t count, const std::string& form) const {
  std::vector<double> values;
  if (const auto* array = node_->as_array())
    for (const auto& element : *array)
      if (element.is_number() && std::isfinite(*element.value<double>())) values.push_back(*element.value<double>());
  if (values.size() == count && node_->as_array()->size() == count) return values;
  refuse(form + " with finite numbers");
  return std::nullopt;
}

std::optional<std::vector<std::string>> Value::texts() const {
  std::vector<std::string> words;
  const auto* array = node_->as_array();
  if (array)
    for (const auto& element : *array)
      if (element.is_string()) words.push_back(*element.value<std::string>());
  if (array && words.size() == array->size()) return words;
  refuse("a list of strings");
  return std::nullopt;
}

std::optional<geometry::Point> Value::point() const {
  const auto values = numbers(2, "[x, y]");
  if (!values) return std::nullopt;
  return geometry::Point((*values)[0], (*values)[1]);
}

std::optional<std::vector<geometry::Point>> Value::points() const {
  std::vector<geometry::Point> points;
  const auto* array = node_->as_array();
  const std::size_t size = array ? array->size() : 0;
  for (std::size_t i = 0; i < size; ++i) {
    const auto* pair = (*array)[i].as_array();
    if (!pair || pair->size() != 2 || !(*pair)[0].is_number() || !(*pair)[1].is_number()) break;
    points.emplace_back(*(*pair)[0].value<double>(), *(*pair)[1].value<double>());
    if (!points.back().allFinite()) break;
  }
  if (array && points.size() == size && (points.empty() || points.back().allFinite())) return points;
  refuse("a list of points [[x, y], ...] with finite numbers");
  return std::nullopt;
}

std::vector<Value> Value::elements(const std::string& form) const {
  const auto* array = node_->as_array();
  if (!array) refuse(form);
  std::vector<Value> values;
  for (std::size_t i = 0; array && i < array->size(); ++i)
    values.emplace_back((*array)[i], fmt::format("{}[{}]", key_, i), *reading_);
  return values;
}

namespace {

std::string contents(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw CaseError({{path.string(), "", "no such file"}});
  try {
    if (std::filesystem::is_directory(path)) throw CaseError({{path.string(), "", "cannot be read"}});
    return post::read_text(path, 16 << 20);
  } catch (const std::length_error& error) {
    throw CaseError({{path.string(), "", error.what()}});
  } catch (const std::filesystem::filesystem_error&) {
    throw CaseError({{path.string(), "", "cannot be read"}});
  }
}

/// The line with a key of more parts than any that there is: the library follows the parts by recursion, and 100,000
/// of them are the end of its stack.
std::optional<long> line_of_deep_key(std::string_view text) {
  constexpr std::size_t deepest = 64;
  std::size_t parts = 0;
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (std::string_view("\n,=[]{}").find(text[i]) != std::string_view::npos) parts = 0;
    parts += text[i] == '.' && text[i - 1] != '.';  // a row of dots is a line in a comment
    if (parts > deepest) return 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(i), '\n');
  }
  return std::nullopt;
}

}  // namespace

toml::table parsed_text(const std::string& text, const std::string& name) {
  if (const auto line = line_of_deep_key(text))
    throw CaseError({{fmt::format("{}:{}", name, *line), "", "a key of more than 64 parts"}});
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const auto at = error.source().begin;
    throw CaseError({{fmt::format("{}:{}:{}", name, at.line, at.column), "", std::string(error.description())}});
  }
}

toml::table parsed(const std::filesystem::path& path, const std::string& command) {
  toml::table root = parsed_text(contents(path), path.string());
  const std::string right = root.contains("row")       ? "extremes"
                            : root.contains("axis")    ? "study"
                            : root.contains("section") ? "run"
                                                       : command;
  if (right != command) throw CaseError({{path.string(), "", "this file is for pdplate " + right}});
  return root;
}

namespace {

constexpr char removal = '-';  // begins a setting that takes a key out

using Step = KeyStep;

/// Puts a node at `step` of its parent; false where the parent has no such place.
bool put(toml::node& parent, const Step& step, toml::node& value) {
  return value.visit([&](auto& node) {
    if (const auto* name = std::get_if<std::string>(&step)) {
      if (!parent.is_table()) return false;
      parent.as_table()->insert_or_assign(*name, std::move(node));
      return true;
    }
    auto* array = parent.as_array();
    const std::size_t index = std::get<std::size_t>(step);
    if (!array || index > array->size()) return false;
    if (index == array->size())
      array->push_back(std::move(node));
    else
      array->replace(array->cbegin() + std::ptrdiff_t(index), std::move(node));
    return true;
  });
}

toml::node* child(toml::node& parent, const Step& step) {
  if (const auto* name = std::get_if<std::string>(&step))
    return parent.is_table() ? parent.as_table()->get(*name) : nullptr;
  return parent.is_array() ? parent.as_array()->get(std::get<std::size_t>(step)) : nullptr;
}

/// The value as TOML, or as it stands where it is none.
toml::table parsed(const std::string& text) {
  try {
    return toml::parse("value = " + text);
  } catch (const toml::parse_error&) {
    toml::table bare;
    bare.insert_or_assign("value", text);
    return bare;
  }
}

/// Takes a key, or a table with all below it, out of the tree.
void remove_key(toml::table& root, const std::string& typed, Reading& reading) {
  const auto path = steps(typed);
  toml::node* parent = &root;
  for (std::size_t i = 0; i + 1 < path.size() && parent; ++i) parent = child(*parent, path[i]);
  if (path.empty() || !parent || !child(*parent, path.back())) {
    reading.report_error({"--unset " + typed, dotted(path), "is not in the file"});
    return;
  }
  if (const auto* name = std::get_if<std::string>(&path.back()))
    parent->as_table()->erase(*name);
  else
    parent->as_array()->erase(parent->as_array()->cbegin() + std::ptrdiff_t(std::get<std::size_t>(path.back())));
}

}  // namespace

void apply_override(toml::table& root, const std::string& setting, Reading& reading) {
  if (setting.starts_with(removal)) return remove_key(root, setting.substr(1), reading);
  const auto equals = setting.find('=');
  const std::string typed = setting.substr(0, equals);
  const auto path = steps(typed);
  if (equals == std::string::npos || path.empty()) {
    reading.report_error({"--set " + typed, dotted(path), fmt::format("{} given, must be key=value", quoted(setting))});
    return;
  }
  toml::node* parent = &root;
  std::vector<Step> made = path;  // the uppermost key that the override makes
  for (std::size_t i = 0; i + 1 < path.size() && parent; ++i) {
    toml::node* next = child(*parent, path[i]);
    const bool list = std::holds_alternative<std::size_t>(path[i + 1]);
    toml::table table;
    toml::array array;
    if (!next && put(*parent, path[i], list ? static_cast<toml::node&>(array) : table)) {
      next = child(*parent, path[i]);
      if (i + 1 < made.size()) made.resize(i + 1);
    }
    parent = next;
  }
  auto value = parsed(setting.substr(equals + 1));
  if (!parent || !put(*parent, path.back(), *value.get("value")))
    reading.report_error({"--set " + typed, dotted(path), "leads nowhere: the file has no such table or list entry"});
  else
    reading.overridden(dotted(made), "--set " + typed);
}

}  // namespace cases
