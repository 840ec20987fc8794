#include "cases/input/problems.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <map>
#include <set>

#include "cases/input/keys.hpp"

namespace cases {
namespace {

using Names = std::map<std::string, std::string, std::less<>>;  // name, key

/// Names that are the last part of one key, and that of no entry of a list.
Names names_of_keys() {
  Names result{{"support_patch", "support.on"}};  // which has a key for its parts only
  std::set<std::string> several;
  for (const auto& key : keys()) {
    const auto name = key.name.substr(key.name.rfind('.') + 1);
    if (!result.emplace(name, key.name).second) several.insert(name);
  }
  std::erase_if(result, [&](const auto& known) {
    return several.contains(known.first) || known.second.find("[]") != std::string::npos;
  });
  return result;
}

/// Names of the lists of tables in a case file.
std::set<std::string, std::less<>> names_of_lists() {
  std::set<std::string, std::less<>> result;
  for (const auto& key : keys())
    if (const auto section = key.name.substr(0, key.name.find('.')); section.ends_with("[]"))
      result.insert(section.substr(0, section.size() - 2));
  return result;
}

std::string report(const std::vector<Problem>& problems) {
  constexpr std::size_t most = 100;
  std::vector<std::string> lines;
  for (const auto& problem : problems) {
    if (lines.size() == most) {
      lines.push_back(fmt::format("... and {} problems more", problems.size() - most));
      break;
    }
    lines.push_back(problem.key.empty() ? fmt::format("{}: {}", problem.place, problem.what)
                                        : fmt::format("{}: {}: {}", problem.place, problem.key, problem.what));
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

/// Gives settings in messages of the folders below their keys.
std::vector<Problem>& with_keys_in(std::vector<Problem>& problems) {
  for (auto& problem : problems) problem.what = with_keys(problem.what);
  return problems;
}

}  // namespace

std::optional<std::string> key_of_setting(std::string_view name) {
  static const auto names = names_of_keys();
  static const auto lists = names_of_lists();
  if (lists.contains(name)) return fmt::format("[[{}]]", name);
  if (const auto found = names.find(name); found != names.end()) return found->second;
  const auto list = name.substr(0, name.find(' ')), number = name.substr(std::min(list.size() + 1, name.size()));
  const bool whole = !number.empty() && number.find_first_not_of("0123456789") == std::string_view::npos;
  return whole && lists.contains(list) ? std::optional(fmt::format("{}[{}]", list, number)) : std::nullopt;
}

std::string with_keys(std::string_view message) {
  std::string result;
  for (;;) {
    const auto begin = message.find('`');
    const auto end = begin == std::string_view::npos ? begin : message.find('`', begin + 1);
    if (end == std::string_view::npos) return result.append(message);
    const auto key = key_of_setting(message.substr(begin + 1, end - begin - 1));
    result.append(message.substr(0, begin)).append(key ? std::string_view(*key) : message.substr(begin, end - begin));
    message.remove_prefix(key ? end + 1 : end);  // what follows may begin with the second backtick
  }
}

CaseError::CaseError(std::vector<Problem> problems)
    : std::runtime_error(report(with_keys_in(problems))), problems_(std::move(problems)) {}

std::string Source::place(const std::string& key) const {
  for (std::string parent = key;;) {
    for (const auto& [given, where] : places)
      if (given == parent) return where;
    if (parent.empty()) return "";
    const auto cut = parent.find_last_of(".[");
    parent.resize(cut == std::string::npos ? 0 : cut);
  }
}

}  // namespace cases
