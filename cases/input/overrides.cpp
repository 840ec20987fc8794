#include <fmt/format.h>
#include "cases/input/toml_reader.hpp"
#include "post/manual/key_path.hpp"

namespace cases {
namespace {

constexpr char removal = '-';  // begins a setting that takes a key out

using post::dotted;
using Step = post::KeyStep;

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
  const auto path = post::steps(typed);
  toml::node* parent = &root;
  for (std::size_t i = 0; i + 1 < path.size() && parent; ++i) parent = child(*parent, path[i]);
  if (path.empty() || !parent || !child(*parent, path.back())) {
    reading.complain({"--unset " + typed, dotted(path), "is not in the file"});
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
  const auto path = post::steps(typed);
  if (equals == std::string::npos || path.empty()) {
    reading.complain({"--set " + typed, dotted(path), fmt::format("{} given, must be key=value", quoted(setting))});
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
    reading.complain({"--set " + typed, dotted(path), "leads nowhere: the file has no such table or list entry"});
  else
    reading.overridden(dotted(made), typed);
}

}  // namespace cases
