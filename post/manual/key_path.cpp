#include "post/manual/key_path.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace post {

std::vector<KeyStep> steps(const std::string& key) {
  std::vector<KeyStep> result;
  std::string word;
  const auto finish = [&] {
    if (word.empty()) return;
    const bool index =
        word.size() < 9 && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
    result.push_back(index && !result.empty() ? KeyStep(std::size_t(std::stoul(word))) : KeyStep(word));
    word.clear();
  };
  for (const char c : key)
    if (c == '.' || c == '[' || c == ']')
      finish();
    else if (c != ' ')
      word += c;
  finish();
  return result;
}

std::string dotted(const std::vector<KeyStep>& path) {
  std::string key;
  for (const auto& step : path)
    if (const auto* name = std::get_if<std::string>(&step))
      key += (key.empty() ? "" : ".") + *name;
    else
      key += fmt::format("[{}]", std::get<std::size_t>(step));
  return key;
}

}  // namespace post
